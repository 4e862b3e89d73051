#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Draws the surrogates of truncated least squares, as in the paper's figure.

    build/bin/quatro_experiment --protocol=surrogates --output=surrogates.csv
    experiments/scripts/with_python.sh matplotlib experiments/scripts/draw_surrogates.py surrogates.csv surrogates.png

Exit code: 0; 2 if a flag or a file is invalid, with one line that says which.
"""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from script_support import BadInput, check_picture, read_rows, run_script, save_picture


def read_curves(path):
    """mu -> (residual, loss) of each point."""
    curves = {}
    for line, row in read_rows(path, ("mu", "residual", "loss"))[0]:
        try:
            float(row["mu"])
            curves.setdefault(row["mu"], []).append((float(row["residual"]), float(row["loss"])))
        except (TypeError, ValueError):
            raise BadInput(f"{path}: line {line} is not from --protocol=surrogates") from None
    if not curves:
        raise BadInput(f"{path}: there are no curves; see --protocol=surrogates of "
                       "quatro_experiment")
    return curves


def main(arguments):
    if len(arguments) != 2:
        raise BadInput("give TABLE.csv and PICTURE.png")
    table, picture = arguments
    check_picture(picture, [table])
    curves = read_curves(table)

    figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
    colors = plt.get_cmap("viridis")
    for i, (mu, points) in enumerate(curves.items()):
        x = [-r for r, _ in reversed(points)] + [r for r, _ in points]
        y = [loss for _, loss in reversed(points)] + [loss for _, loss in points]
        is_exact = mu == "inf"
        axes.plot(x, y, color="black" if is_exact else colors(i / len(curves)),
                  linewidth=2 if is_exact else 1.5,
                  label=r"$\mu \to \infty$: truncated" if is_exact else rf"$\mu = {float(mu):g}$")
    axes.axvspan(-1, 1, color="0.93", zorder=0)
    axes.text(0, 1.03, "inlier", ha="center")
    axes.set_ylim(0, 1.15)
    axes.set_xlabel("residual over the noise bound, $r / c$")
    axes.set_ylabel(r"$\rho_\mu(r^2 / c^2)$")
    axes.set_title("Truncated least squares and its surrogates")
    axes.legend(loc="lower right")
    save_picture(figure, picture, dpi=120)


if __name__ == "__main__":
    run_script(main)
