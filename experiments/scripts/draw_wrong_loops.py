#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Draws how often pose graphs are correct over the share of outlier loops.

    build/bin/quatro_pose_graph --protocol=wrong_loops --output=a.csv
    build/bin/quatro_pose_graph --protocol=wrong_loops --sigma_m=0.1 --sigma_deg=4 --output=b.csv
    experiments/scripts/with_python.sh matplotlib experiments/scripts/draw_wrong_loops.py a.csv b.csv wrong_loops.png

Exit code: 0; 2 if a flag or a file is invalid, with one line that says which.
"""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from script_support import BadInput, check_picture, read_rows, run_script, save_picture

STYLES = {
    "gnc": ("GNC", "black", "o", "-"),
    "tukey": ("TukeyLoss", "tab:green", "^", "--"),
    "cauchy": ("CauchyLoss", "tab:orange", "s", "--"),
    "huber": ("HuberLoss", "tab:blue", "v", "--"),
    "none": ("least squares", "tab:red", "x", ":"),
}
TITLES = {"manhattan": "Manhattan, in the plane", "sphere": "Sphere, in space"}


COLUMNS = ("world", "sigma_m", "sigma_deg", "loss", "wrong_share", "correct", "runs",
           "median_error_m")


def read_curves(paths):
    """(world, noise) -> loss -> (share, correct, error) of each point."""
    curves = {}
    for path in paths:
        rows, _ = read_rows(path, COLUMNS)
        if not rows:
            raise BadInput(f"{path}: there are no lines; see --protocol=wrong_loops of "
                           "quatro_pose_graph")
        for line, row in rows:
            panel = row["world"], row["sigma_m"], row["sigma_deg"]
            try:
                point = (100 * float(row["wrong_share"]), 100 * int(row["correct"]) / int(row["runs"]),
                         max(float(row["median_error_m"]), 1e-9))
                STYLES[row["loss"]]
            except (KeyError, TypeError, ValueError, ZeroDivisionError):
                raise BadInput(f"{path}: line {line} is not from --protocol=wrong_loops") from None
            curves.setdefault(panel, {}).setdefault(row["loss"], []).append(point)
    return curves


def main(arguments):
    if len(arguments) < 2:
        raise BadInput("give one or more TABLE.csv, and PICTURE.png")
    *tables, picture = arguments
    check_picture(picture, tables)
    curves = read_curves(tables)

    figure, axes = plt.subplots(2, len(curves), figsize=(1 + 3.5 * len(curves), 6), layout="constrained",
                                sharex=True, sharey="row", squeeze=False)
    for column, ((world, sigma_m, sigma_deg), by_loss) in enumerate(curves.items()):
        for loss, points in by_loss.items():
            label, color, marker, line = STYLES[loss]
            x, correct, error = zip(*points)
            for axis, y in ((axes[0, column], correct), (axes[1, column], error)):
                axis.plot(x, y, label=label, color=color, marker=marker, linestyle=line, clip_on=False)
        axes[0, column].set_title(f"{TITLES.get(world, world)}\nnoise {sigma_m} m, {sigma_deg} deg")
        axes[0, column].set_ylim(0, 103)
        axes[1, column].set_yscale("log")
        axes[1, column].axhline(0.1, color="0.8", zorder=0)
        axes[1, column].set_xlabel("outlier loops [% of the loops]")
    axes[0, 0].set_ylabel("runs within 0.1 m [%]")
    axes[1, 0].set_ylabel("largest error, median [m]")
    axes[0, 0].legend(loc="center right")
    save_picture(figure, picture, dpi=100)


if __name__ == "__main__":
    run_script(main)
