#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Registers two clouds and draws them from above, before and after.

  examples/python/draw_registration.py SOURCE TARGET [--preset kitti]
      [--method quatro] [--output drawing.png]

Without --output a window opens. The script can also be run cell by cell in a
notebook.
"""

# %% Arguments
import argparse
import os
import sys

import numpy as np

import quatro

parser = argparse.ArgumentParser(description='Registers two clouds and draws them.')
parser.add_argument('source', help='.bin (KITTI), .ply, .pcd, .npy, .xyz, .txt or .csv')
parser.add_argument('target')
parser.add_argument('--preset', default='kitti', choices=quatro.presets())
parser.add_argument('--method', default='quatro', choices=quatro.methods())
parser.add_argument('--output', help='picture to write; without it a window opens')
args = parser.parse_args()


def refuse(problem):
    print(problem, file=sys.stderr)
    sys.exit(2)


if args.output:
    if not os.path.isdir(os.path.dirname(args.output) or '.'):
        refuse('%s: there is no folder for it' % args.output)
    if os.path.realpath(args.output) in map(os.path.realpath, (args.source, args.target)):
        refuse('%s: is a cloud; name another file to draw to' % args.output)

# %% Register
try:
    source = quatro.read_cloud(args.source)
    target = quatro.read_cloud(args.target)
    answer = quatro.register(source, target, args.preset, method=args.method)
except ValueError as error:
    refuse(error)
print(answer)
print('%d and %d voxels, %d matches, %d inliers' %
      (answer.num_source_voxels, answer.num_target_voxels,
       len(answer.matched_source), answer.num_inliers))
for stage, seconds in answer.stage_seconds.items():
    print('%-12s %8.1f ms' % (stage, 1e3 * seconds))

# %% Draw
import matplotlib  # noqa: E402

if args.output:
    matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402


def draw(axes, points, color, label):
    axes.scatter(points[:, 0], points[:, 1], s=0.2, c=color, label=label, linewidths=0)


figure, (before, after) = plt.subplots(1, 2, figsize=(14, 7), sharex=True, sharey=True)
for axes in (before, after):
    axes.set_aspect('equal')
    axes.set_xlabel('x [m]')
draw(before, target, 'tab:blue', 'target')
draw(before, source, 'tab:orange', 'source')
p, q = answer.matched_source, answer.matched_target
is_inlier = np.zeros(len(p), dtype=bool)
is_inlier[answer.inliers] = True
for k in range(len(p)):
    before.plot([p[k, 0], q[k, 0]], [p[k, 1], q[k, 1]], linewidth=0.3,
                color='tab:green' if is_inlier[k] else '0.8', zorder=is_inlier[k])
before.set_title('%d matches, %d inliers (green)' % (len(p), is_inlier.sum()))
before.set_ylabel('y [m]')
draw(after, target, 'tab:blue', 'target')
if answer.target_from_source is not None:
    draw(after, answer.transform(source), 'tab:orange', 'source')
after.set_title('%s, probability %.2f' % (answer.status, answer.probability))
after.legend(loc='upper right', markerscale=20)
figure.tight_layout()
if args.output:
    try:
        figure.savefig(args.output, dpi=120)
    except (OSError, ValueError) as error:
        refuse('%s: %s' % (args.output, error))
else:
    plt.show()
sys.exit(0 if answer.is_registered else 1)
