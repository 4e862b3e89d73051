# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""A prior on the pose, and points moved by the answer."""

import numpy as np
import problems
import pytest

import quatro

FEW = problems.pose(0.3, (2, 1, 0.2))
MANY = problems.pose(2.5, (-20, 15, -0.3))


def two_poses(seed):
    """60 matches follow FEW, 90 MANY."""
    few = problems.matches(seed, FEW, 60, 0)
    many = problems.matches(seed + 100, MANY, 90, 0)
    return np.vstack((few[0], many[0])), np.vstack((few[1], many[1]))


@pytest.mark.parametrize('method', problems.MATCH_METHODS)
def test_bounds_decide_between_two_poses(method):
    source, target = two_poses(1)
    fixed = {'method': method, 'noise_bound': 0.1, **problems.needed(method)}
    free = quatro.solve(source, target, **fixed)
    # FGR descends from no motion, and finds the pose that is nearer.
    assert np.allclose(free.target_from_source, FEW if method == 'fgr' else MANY, atol=0.1)
    answer = quatro.solve(source, target, **fixed, guess=np.eye(4), max_translation=4.0,
                          max_yaw_deg=30.0)
    assert np.allclose(answer.target_from_source, FEW, atol=0.1)
    assert set(answer.inliers) == set(range(60))
    answer = quatro.solve(source, target, **fixed, guess=MANY, max_translation=4.0,
                          max_yaw_deg=30.0)
    assert np.allclose(answer.target_from_source, MANY, atol=0.1)


def test_bounds_without_a_pose_say_so():
    source, target = two_poses(1)
    answer = quatro.solve(source, target, max_translation=1.0, max_yaw_deg=1.0)
    assert answer.target_from_source is None and answer.status == 'insufficient'
    assert 'the bounds leave' in answer.reason or 'outside of the bounds' in answer.reason
    with pytest.raises(ValueError, match='there is no pose to transform by'):
        answer.transform(source)


@pytest.mark.parametrize('method', problems.MATCH_METHODS)
def test_bounds_have_an_effect(method):
    source, target = two_poses(1)
    for options in ({'guess': FEW}, {'max_tilt_deg': 1.0}, {'guess': FEW, 'max_yaw_deg': 180.0}):
        with pytest.raises(ValueError, match='has no effect without other bounds: give '
                                             'max_translation or max_yaw_deg'):
            quatro.solve(source, target, method=method, **problems.needed(method), **options)


def test_bounds_that_do_not_fit_are_refused():
    source, target = two_poses(1)
    for options, text in (({'guess': np.eye(4)}, 'guess has no effect'),
                          ({'max_translation': -1.0}, 'max_translation'),
                          ({'max_yaw_deg': 200.0}, 'max_yaw'),
                          ({'guess': np.ones((4, 4)), 'max_yaw_deg': 5.0},
                           'guess is not a rigid motion: .* a rotation to 1e-3'),
                          ({'guess': np.eye(3), 'max_yaw_deg': 5.0},
                           r'guess has shape \(3, 3\), must be \(4, 4\) or \(3, 4\)$'),
                          ({'method': 'teaser', 'estimate_scale': True, 'max_yaw_deg': 5.0},
                           'estimate_scale')):
        with pytest.raises(ValueError, match=text):
            quatro.solve(source, target, **options)
    # The scale without bounds, and bounds without the scale.
    assert quatro.solve(source, target, method='teaser', estimate_scale=True).scale != 1.0
    assert quatro.solve(source, target, method='teaser', estimate_scale=False, noise_bound=0.1,
                        max_translation=4.0, max_yaw_deg=30.0).num_inliers == 60


def test_a_pose_may_be_its_first_three_rows():
    source, target = two_poses(1)
    poses = [quatro.solve(source, target, noise_bound=0.1, guess=guess, max_translation=4.0,
                          max_yaw_deg=30.0).target_from_source for guess in (MANY, MANY[:3])]
    assert poses[0] is not None and np.array_equal(*poses)
    aligned = [quatro.align(source, target, 'icp', initial).target_from_source
               for initial in (MANY, MANY[:3])]
    assert aligned[0] is not None and np.array_equal(*aligned)


def test_points_are_moved():
    source, target = two_poses(1)
    answer = quatro.solve(source, target, noise_bound=0.1)
    pose = answer.target_from_source
    assert np.allclose(answer.transform(source), source @ pose[:3, :3].T + pose[:3, 3])
    assert np.allclose(answer.transform(source)[60:], target[60:], atol=0.2)
    for points in ([[1, 2, 3]], np.zeros((0, 3)), source.astype(np.float32)):
        moved = answer.transform(points)
        assert moved.dtype == np.float64 and moved.shape == np.shape(points)
        assert np.allclose(moved, problems.moved(pose, np.asarray(points, dtype=float)))
    with pytest.raises(ValueError, match=r'^points has shape \(3,\), must be \(N, 3\)$'):
        answer.transform(np.zeros(3))
    aligned = quatro.align(source, source, 'icp')
    assert np.allclose(aligned.transform(source), source, atol=1e-6)
