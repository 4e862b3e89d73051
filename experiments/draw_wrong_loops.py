#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Draws how often pose graphs come out right against the share of wrong loops.

    build/bin/quatro_pose_graph --protocol=wrong_loops --output=a.csv
    build/bin/quatro_pose_graph --protocol=wrong_loops --sigma_m=0.1 --sigma_deg=4 --output=b.csv
    experiments/with_python.sh matplotlib experiments/draw_wrong_loops.py a.csv b.csv wrong_loops.png
"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

STYLES = {
    "gnc": ("GNC", "black", "o", "-"),
    "tukey": ("TukeyLoss", "tab:green", "^", "--"),
    "cauchy": ("CauchyLoss", "tab:orange", "s", "--"),
    "huber": ("HuberLoss", "tab:blue", "v", "--"),
    "none": ("least squares", "tab:red", "x", ":"),
}
TITLES = {"manhattan": "Manhattan, in the plane", "sphere": "Sphere, in space"}


def main():
    if len(sys.argv) < 3:
        sys.exit(f"usage: {sys.argv[0]} TABLE.csv... PICTURE.png")
    curves = {}
    for path in sys.argv[1:-1]:
        with open(path, newline="") as file:
            for row in csv.DictReader(file):
                panel = row["world"], row["sigma_m"], row["sigma_deg"]
                x = 100 * float(row["wrong_share"])
                right = 100 * int(row["right"]) / int(row["runs"])
                error = max(float(row["median_error_m"]), 1e-9)
                curves.setdefault(panel, {}).setdefault(row["loss"], []).append((x, right, error))

    figure, axes = plt.subplots(2, len(curves), figsize=(1 + 3.5 * len(curves), 6), layout="constrained",
                                sharex=True, sharey="row", squeeze=False)
    for column, ((world, sigma_m, sigma_deg), by_loss) in enumerate(curves.items()):
        for loss, points in by_loss.items():
            label, color, marker, line = STYLES[loss]
            x, right, error = zip(*points)
            for axis, y in ((axes[0, column], right), (axes[1, column], error)):
                axis.plot(x, y, label=label, color=color, marker=marker, linestyle=line, clip_on=False)
        axes[0, column].set_title(f"{TITLES.get(world, world)}\nnoise {sigma_m} m, {sigma_deg} deg")
        axes[0, column].set_ylim(0, 103)
        axes[1, column].set_yscale("log")
        axes[1, column].axhline(0.1, color="0.8", zorder=0)
        axes[1, column].set_xlabel("wrong loops [% of the loops]")
    axes[0, 0].set_ylabel("runs within 0.1 m [%]")
    axes[1, 0].set_ylabel("largest error, median [m]")
    axes[0, 0].legend(loc="center right")
    figure.savefig(sys.argv[-1], dpi=100)


if __name__ == "__main__":
    main()
