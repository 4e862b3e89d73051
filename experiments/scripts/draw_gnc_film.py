#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Draws how GNC converges to a yaw: the weights of all TIMs and the cost over all yaws,
iteration by iteration, with the exact optimum marked.

    build/bin/quatro_experiment --protocol=film --outliers=0.7 --output=70.csv
    build/bin/quatro_experiment --protocol=film --outliers=0.9 --output=90.csv
    experiments/scripts/with_python.sh matplotlib experiments/scripts/draw_gnc_film.py 70.csv 90.csv film.png

Each film is one row.

Exit code: 0; 2 if a flag or a file is invalid, with one line that says which.
"""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from script_support import BadInput, check_picture, read_rows, run_script, save_picture

NUM_CURVES = 5  # Evenly spaced iterations, including the last.


def read_film(path):
    film = {"weight": {}, "curve": {}, "yaw": {}, "mu": {}}
    ends = {"truncated": [], "is_true": [], "gnc": [], "exact": [], "truth": []}
    for line, row in read_rows(path)[0]:
        try:
            point = float(row["x"]), float(row["y"])
            if row["kind"] in ends:
                ends[row["kind"]].append(point)
                continue
            iteration = int(row["iteration"])
            film["mu"][iteration] = float(row["mu"])
            film[row["kind"]].setdefault(iteration, []).append(point)
        except (KeyError, TypeError, ValueError) as failure:
            raise BadInput(f"{path}: line {line} is not part of a film") from failure
    film.update(ends)
    if not all(film[kind] for kind in ("weight", "curve", "yaw")) or not all(ends.values()):
        raise BadInput(f"{path}: is not a film; see --protocol=film of quatro_experiment")
    return film


def draw_weights(axes, film):
    is_true = {k for k, y in film["is_true"] if y}
    iterations = sorted(film["weight"])
    last = dict(film["weight"][iterations[-1]])
    order = sorted(last, key=lambda k: (k not in is_true, -last[k]))
    image = [[dict(film["weight"][i])[k] for i in iterations] for k in order]
    axes.imshow(image, aspect="auto", cmap="viridis", vmin=0, vmax=1, interpolation="nearest",
                extent=(-0.5, len(iterations) - 0.5, len(order) - 0.5, -0.5))
    axes.axhline(len(is_true) - 0.5, color="white", linewidth=1.5)
    for text, middle in (("inliers", len(is_true) / 2), ("outliers", (len(is_true) + len(order)) / 2)):
        axes.text(0.97, 1 - middle / len(order), text, transform=axes.transAxes, color="white",
                  ha="right", va="center", fontsize=9,
                  bbox={"facecolor": "black", "alpha": 0.6, "linewidth": 0, "pad": 2})
    axes.set_xlabel("iteration")
    axes.set_ylabel("difference")
    axes.set_title("weights: 0 dark, 1 bright")


def draw_costs(axes, film):
    iterations = [i for i in sorted(film["curve"]) if film["mu"][i] > 0] or [0]
    steps = max(1, NUM_CURVES - 1)
    chosen = sorted({iterations[round(k * (len(iterations) - 1) / steps)]
                     for k in range(NUM_CURVES)})
    colors = plt.get_cmap("plasma")
    for number, iteration in enumerate(chosen):
        curve = film["curve"][iteration]
        color = colors(0.85 * number / max(1, len(chosen) - 1))
        axes.plot(*zip(*curve), color=color, linewidth=1.2,
                  label=rf"iteration {iteration}, $\mu = {film['mu'][iteration]:.2g}$")
        yaw = film["yaw"][iteration][0][0]
        nearest = min(curve, key=lambda point: abs(point[0] - yaw))
        axes.plot(yaw, nearest[1], "o", color=color, markersize=6)
    axes.plot(*zip(*film["truncated"]), color="black", linewidth=0.8, label="truncated cost")
    (exact, cost), (gnc, gnc_cost) = film["exact"][0], film["gnc"][0]
    axes.axvline(exact, color="tab:green", linewidth=1.2, linestyle="--")
    axes.plot(exact, cost, "*", color="tab:green", markersize=14,
              label=f"exact optimum, {exact:.1f} deg, cost {cost:.1f}")
    axes.plot(gnc, gnc_cost, "s", color="tab:red", markersize=6, fillstyle="none",
              label=f"end of GNC, {gnc:.1f} deg, cost {gnc_cost:.1f}")
    axes.set_xlim(-180, 180)
    axes.set_xticks(range(-180, 181, 60))
    axes.set_xlabel("yaw [deg]")
    axes.set_ylabel("cost")
    axes.set_title("surrogates, their yaws, and the truncated cost")
    axes.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.01, 0.5), frameon=False)


def main(arguments):
    if len(arguments) < 2:
        raise BadInput("give one or more FILM.csv, and PICTURE.png")
    check_picture(arguments[-1], arguments[:-1])
    films = [read_film(path) for path in arguments[:-1]]
    figure, rows = plt.subplots(len(films), 2, figsize=(12.5, 3.9 * len(films)), squeeze=False,
                                layout="constrained", width_ratios=(1, 1.7))
    for (left, right), film in zip(rows, films):
        draw_weights(left, film)
        draw_costs(right, film)
    save_picture(figure, arguments[-1], dpi=110, metadata={"Software": None})


if __name__ == "__main__":
    run_script(main)
