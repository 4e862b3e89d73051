# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Seeded problems with known answers."""

import numpy as np

# Methods by what they work on. `solve` has the first, `register` has all.
MATCH_METHODS = ['auto', 'quatro', 'quatro_single', 'quatro_exact', 'quatro_ins', 'arc_consensus',
                 'consensus', 'teaser', 'fgr', 'ransac', 'ransac1k', 'ransac10k']
REFINING_METHODS = ['quatro_c2f']
LOCAL_METHODS = ['icp', 'gicp', 'vgicp']


def needed(method):
    """The options without which the method raises ValueError: an INS, here of level clouds."""
    if method != 'quatro_ins':
        return {}
    return {'ins_mode': 'leveled', 'source_rpy': (0, 0, 0), 'target_rpy': (0, 0, 0)}


def pose(yaw, translation, roll=0.0, pitch=0.0):
    """R_z R_y R_x and a translation, as (4, 4)."""
    c, s = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    about_x = np.array([[1, 0, 0], [0, c[0], -s[0]], [0, s[0], c[0]]])
    about_y = np.array([[c[1], 0, s[1]], [0, 1, 0], [-s[1], 0, c[1]]])
    about_z = np.array([[c[2], -s[2], 0], [s[2], c[2], 0], [0, 0, 1]])
    matrix = np.eye(4)
    matrix[:3, :3] = about_z @ about_y @ about_x
    matrix[:3, 3] = translation
    return matrix


def moved(matrix, points):
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def errors(estimate, truth):
    """Of a pose: [m], [rad]."""
    difference = np.linalg.inv(truth) @ estimate
    skew = difference[:3, :3] - difference[:3, :3].T
    sine = np.linalg.norm([skew[2, 1], skew[0, 2], skew[1, 0]])
    return (np.linalg.norm(difference[:3, 3]),
            np.arctan2(sine, np.trace(difference[:3, :3]) - 1.0))


def num_inliers(matrix, source, target, noise_bound):
    """Matches whose residual is within the bound on each axis."""
    return (np.abs(target - moved(matrix, source)).max(axis=1) <= noise_bound).sum()


def matches(seed, truth, num_true=60, num_wrong=60, noise=0.02):
    random = np.random.default_rng(seed)
    source = random.uniform((-40, -40, -2), (40, 40, 8), (num_true + num_wrong, 3))
    target = moved(truth, source) + random.normal(0, noise, source.shape)
    target[num_true:] = random.uniform((-40, -40, -2), (40, 40, 8), (num_wrong, 3))
    return source, target


def scan(seed_of_place, seed_of_scan):
    """Upright boxes on the ground, as tests/install/register_main.cc has them."""
    place = np.random.default_rng(seed_of_place)
    random = np.random.default_rng(1000 + seed_of_scan)
    parts = []
    for _ in range(40):
        turn = place.uniform(0, np.pi)
        length, width, height = place.uniform((1, 1, 1), (5, 3, 4))
        center = place.uniform(-30, 30, 2)
        along = random.random(500) < length / (length + width)
        side = np.where(random.random(500) < 0.5, -0.5, 0.5)
        within = random.uniform(-0.5, 0.5, 500)
        u = length * np.where(along, within, side)
        v = width * np.where(along, side, within)
        parts.append(np.column_stack([
            center[0] + u * np.cos(turn) - v * np.sin(turn),
            center[1] + u * np.sin(turn) + v * np.cos(turn),
            random.uniform(0, height, 500) - 1.5]))
    ground = random.uniform(-30, 30, (6000, 3))
    ground[:, 2] = -1.5
    return np.vstack([*parts, ground])
