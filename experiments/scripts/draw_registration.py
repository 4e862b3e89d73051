#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Draws a registration from above: before with the matches, and after.

    draw_registration.py DATA.json PICTURE.png

DATA is written by experiments/programs/picture.cc; quatro_register --picture calls this script.
"""
import json
import signal
import sys

signal.signal(signal.SIGINT, signal.SIG_DFL)  # No traceback on Ctrl-C.

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

SOURCE, TARGET = "#d9480f", "#1864ab"
INLIER, OUTLIER = "#2b8a3e", "#e03131"
MAX_DRAWN = 400  # Outliers; more would hide the rest.


def points(data, name):
    return np.asarray(data[name], dtype=float).reshape(-1, 3)


def draw_cloud(axes, cloud, color, label):
    axes.plot(cloud[:, 0], cloud[:, 1], ",", color=color, alpha=0.5)
    axes.plot([], [], "s", color=color, label=label)


def draw_matches(axes, source, target, color, label, alpha):
    segments = np.stack([source[:, :2], target[:, :2]], axis=1)
    axes.add_collection(LineCollection(segments, colors=color, linewidths=0.5, alpha=alpha))
    axes.plot([], [], "-", color=color, label=label)


def window(clouds):
    """Limits of x and y that include all but a few distant points."""
    shown = np.concatenate([cloud[:, :2] for cloud in clouds])
    if len(shown) == 0:
        return -np.ones(2), np.ones(2)
    low, high = np.percentile(shown, [0.5, 99.5], axis=0)
    margin = 0.05 * (high - low) + 0.1
    return low - margin, high + margin


def finish(axes, title, low, high, origin):
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_aspect("equal", adjustable="box")
    axes.set_title(title)
    for name, value, label in zip("xy", origin, (axes.set_xlabel, axes.set_ylabel)):
        label(f"{name} [m]" if value == 0 else f"{name} - {value:.0f} [m]")
    axes.legend(loc="upper right", fontsize="small", framealpha=0.9)


def draw(data, picture):
    source, target = points(data, "source"), points(data, "target")
    matched_source, matched_target = points(data, "matched_source"), points(data, "matched_target")
    is_inlier = np.zeros(len(matched_source), dtype=bool)
    is_inlier[data["inliers"]] = True
    rejected = np.flatnonzero(~is_inlier)
    rejected = rejected[:: max(1, -(-len(rejected) // MAX_DRAWN))]

    aligned = points(data, "aligned") if "aligned" in data else source[:0]
    low, high = window([source, target, aligned])
    aspect = (high[0] - low[0]) / (high[1] - low[1])
    rows, columns = (2, 1) if aspect > 1.4 else (1, 2)
    width = 13.0 if rows == 2 else 17.0
    height = width / columns / aspect * rows + 1.5
    figure, (before, after) = plt.subplots(rows, columns, figsize=(width, min(height, 20.0)),
                                           layout="constrained")
    figure.suptitle(data["title"], fontsize="medium", wrap=True)
    draw_cloud(before, target, TARGET, "target")
    draw_cloud(before, source, SOURCE, "source")
    draw_matches(before, matched_source[rejected], matched_target[rejected], OUTLIER,
                 f"{np.sum(~is_inlier)} matches rejected ({len(rejected)} drawn)", 0.5)
    draw_matches(before, matched_source[is_inlier], matched_target[is_inlier], INLIER,
                 f"{np.sum(is_inlier)} inliers", 0.8)
    finish(before, "before, with the matches", low, high, data["origin"])

    draw_cloud(after, target, TARGET, "target")
    if "aligned" in data:
        draw_cloud(after, aligned, SOURCE, "source, moved onto the target")
        moved = points(data, "matched_aligned")[is_inlier]
        after.plot(moved[:, 0], moved[:, 1], ".", color=INLIER, markersize=3, label="inliers")
        finish(after, "after", low, high, data["origin"])
    else:
        finish(after, "no answer", low, high, data["origin"])
    figure.savefig(sys.stdout.buffer if picture == "-" else picture, dpi=100, format="png")


def main(arguments):
    """An error message, or None."""
    if arguments == ["--check"]:
        return None
    if len(arguments) != 2:
        return "give DATA.json and PICTURE.png"
    data, picture = arguments
    try:
        with open(data, encoding="utf-8") as file:
            draw(json.load(file), picture)
    except OSError as error:
        return f"{error.filename or picture}: {error.strerror}"
    except (IndexError, KeyError, TypeError, ValueError):
        return f"{data}: was not written by quatro_register --picture"
    return None


if __name__ == "__main__":
    # This script is installed alone, without the helpers of the other scripts.
    problem = main(sys.argv[1:])
    if problem:
        print(f"draw_registration.py: {problem}", file=sys.stderr)
        sys.exit(2)
