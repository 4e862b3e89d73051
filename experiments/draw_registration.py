#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Draws a registration from above: before with the matches, and after.

    draw_registration.py DATA.json PICTURE.png

DATA is what experiments/picture.cc writes. quatro_register --picture calls this.
"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

SOURCE, TARGET = "#d9480f", "#1864ab"
INLIER, OUTLIER = "#2b8a3e", "#e03131"
MAX_DRAWN = 400  # Rejected matches; more would hide the rest.


def points(data, name):
    return np.asarray(data[name], dtype=float).reshape(-1, 3)


def draw_cloud(axes, cloud, color, label):
    axes.plot(cloud[:, 0], cloud[:, 1], ",", color=color, alpha=0.5)
    axes.plot([], [], "s", color=color, label=label)


def draw_matches(axes, source, target, color, label, alpha):
    segments = np.stack([source[:, :2], target[:, :2]], axis=1)
    axes.add_collection(LineCollection(segments, colors=color, linewidths=0.5, alpha=alpha))
    axes.plot([], [], "-", color=color, label=label)


def finish(axes, title, clouds):
    shown = np.concatenate([cloud[:, :2] for cloud in clouds])
    low, high = np.percentile(shown, [0.5, 99.5], axis=0) if len(shown) else (-np.ones(2), np.ones(2))
    margin = 0.05 * (high - low) + 0.1
    axes.set_xlim(low[0] - margin[0], high[0] + margin[0])
    axes.set_ylim(low[1] - margin[1], high[1] + margin[1])
    axes.set_aspect("equal", adjustable="box")
    axes.set_title(title)
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    axes.legend(loc="upper right", fontsize="small", framealpha=0.9)


def main():
    if sys.argv[1:] == ["--check"]:
        return
    with open(sys.argv[1]) as file:
        data = json.load(file)
    source, target = points(data, "source"), points(data, "target")
    matched_source, matched_target = points(data, "matched_source"), points(data, "matched_target")
    is_inlier = np.zeros(len(matched_source), dtype=bool)
    is_inlier[data["inliers"]] = True
    rejected = np.flatnonzero(~is_inlier)
    rejected = rejected[:: max(1, -(-len(rejected) // MAX_DRAWN))]

    figure, (before, after) = plt.subplots(1, 2, figsize=(16, 8.5), layout="constrained")
    figure.suptitle(data["title"])
    draw_cloud(before, target, TARGET, "target")
    draw_cloud(before, source, SOURCE, "source")
    draw_matches(before, matched_source[rejected], matched_target[rejected], OUTLIER,
                 f"{np.sum(~is_inlier)} rejected ({len(rejected)} drawn)", 0.35)
    draw_matches(before, matched_source[is_inlier], matched_target[is_inlier], INLIER,
                 f"{np.sum(is_inlier)} inliers", 0.8)
    finish(before, "before, with the matches", [source, target])

    draw_cloud(after, target, TARGET, "target")
    if "aligned" in data:
        aligned = points(data, "aligned")
        draw_cloud(after, aligned, SOURCE, "source, moved")
        moved = points(data, "matched_aligned")[is_inlier]
        after.plot(moved[:, 0], moved[:, 1], ".", color=INLIER, markersize=3, label="inliers")
        finish(after, "after", [aligned, target])
    else:
        finish(after, "no answer", [target])
    figure.savefig(sys.argv[2], dpi=100, format="png")


if __name__ == "__main__":
    main()
