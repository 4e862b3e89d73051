#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Draws the figures of a run from the results.csv in its folder, or the tilts.csv
of --protocol=tilt, as PDF and PNG.

    experiments/scripts/with_python.sh matplotlib experiments/scripts/draw_experiment.py RUN [--output=FOLDER]
        [--figures=success,bins,distance,yaw,tilt,timing,recall] [--limit=2/10]

    success   pairs within the limit [m/deg] by set, with Wilson's 95 % intervals
    bins      the same by bin, for each set with several bins
    distance  errors of all answers by bin of distance ("8-10 m"): boxes from quartile to
              quartile, whiskers from the 5th to the 95th percentile
    yaw       median error of all answers over the added yaw (bins "yaw 90 deg"), quartiles shaded
    tilt      distributions of the relative tilt and yaw of the pairs
    timing    median time of each stage, with and without the front end
    recall    share of pairs over the allowed error

Figures for which the run has no pairs are left out. The names of the written files are
printed on standard output.
Exit code: 0; 2 if a flag or a file is invalid, with one line that says which.
"""
import math
import os
import re

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from script_support import (BadInput, Parser, check_folder, parse_number, read_rows, reason,
                            run_script, save_picture)

TEXT = ("pair", "set", "bin", "method", "status", "stages_ms")
NUMBERS = ("distance_m", "true_yaw_deg", "true_tilt_deg", "rotation_error_deg",
           "translation_error_m", "total_ms")
ERRORS = (("translation_error_m", "translation error [m]"),
          ("rotation_error_deg", "rotation error [deg]"))
FRONT_END = ("voxels", "features", "matching")
LINES = ("-", "--", "-.", ":")
# Smaller errors are drawn at this value because the axes are logarithmic.
FLOOR = 1e-4


def parse_optional(text, where):
    return None if text in ("", "unknown") else parse_number(text, where)


def parse_limit(text):
    parts = [parse_optional(part, "--limit") for part in text.split("/")]
    if len(parts) != 2 or None in parts or min(parts) < 0:
        raise BadInput(f"--limit={text}, must be like 2/10 [m/deg]")
    return parts


def parse_stages(text, where):
    stages = {}
    for part in filter(None, text.split(";")):
        stage, equals, time = part.partition("=")
        value = parse_optional(time, where) if equals and stage else None
        if value is None:
            raise BadInput(f"{where} has no 'stage=ms' in {part!r}")
        stages[stage] = stages.get(stage, 0.0) + value
    return stages


def parse_result(row, where):
    result = {name: row[name] for name in TEXT}
    for name in NUMBERS:
        result[name] = parse_optional(row[name], f"{where}, column {name}")
    if (row["rotation_error_deg"] == "") != (row["translation_error_m"] == ""):
        raise BadInput(f"{where} has only one of two errors")
    result["stages"] = parse_stages(row["stages_ms"], f"{where}, column stages_ms")
    return result


def parse_tilt(row, where):
    """A pair as a result without a method."""
    return {**dict.fromkeys(TEXT, ""), **dict.fromkeys(NUMBERS), "stages": {}, "set": row["set"],
            "pair": row["source"] + "-" + row["target"],
            "true_yaw_deg": parse_optional(row["yaw_deg"], f"{where}, column yaw_deg"),
            "true_tilt_deg": parse_optional(row["rollpitch_deg"], f"{where}, column rollpitch_deg")}


def read_parsed(path, columns, parse):
    rows = [parse(row, f"{path}: line {line}") for line, row in read_rows(path, columns)[0]]
    if not rows:
        raise BadInput(f"{path}: has no results")
    return rows


def read_results(folder):
    path = os.path.join(folder, "results.csv")
    tilts = os.path.join(folder, "tilts.csv")
    if os.path.exists(tilts) and not os.path.exists(path):
        return read_parsed(tilts, ("set", "source", "target", "yaw_deg", "rollpitch_deg"), parse_tilt)
    return read_parsed(path, (*TEXT, *NUMBERS), parse_result)


def names_of(results, key):
    """Names in order of first occurrence."""
    return list(dict.fromkeys(result[key] for result in results))


def wilson(successes, n, z=1.959963984540054):
    """See metrics/intervals.h."""
    p, z2 = successes / n, z * z / n
    center = (p + z2 / 2) / (1 + z2)
    half = math.sqrt(z2 * (p * (1 - p) + z2 / 4)) / (1 + z2)
    return min(p, max(0.0, center - half)), max(p, min(1.0, center + half))


def quantile(values, share):
    values = sorted(values)
    place = share * (len(values) - 1)
    below = int(place)
    above = min(below + 1, len(values) - 1)
    return values[below] + (place - below) * (values[above] - values[below])


def posed(results):
    return [r for r in results if r["status"] != "unreadable" and r["distance_m"] is not None]


def succeeds(result, limit):
    return (result["translation_error_m"] is not None
            and result["translation_error_m"] <= limit[0]
            and result["rotation_error_deg"] <= limit[1])


def distance_of(bin_name):
    match = re.fullmatch(r"(\d+(?:\.\d+)?)-(\d+(?:\.\d+)?) m", bin_name)
    return match and (float(match[1]), float(match[2]))


def yaw_of(bin_name):
    match = re.fullmatch(r"yaw (-?\d+(?:\.\d+)?) deg", bin_name)
    return match and float(match[1])


def style_of(methods, method):
    i = methods.index(method)
    return {"color": plt.get_cmap("tab10")(i % 10), "linestyle": LINES[i // 10 % len(LINES)]}


def make_panels(num_panels, num_entries, height, width=3.5, are_stacked=False):
    """Panels side by side or stacked, below a strip for the common legend. [inches]"""
    rows, columns = (num_panels, 1) if are_stacked else (1, num_panels)
    num_legend_columns = max(1, min(num_entries, int(width * columns / 1.25)))
    strip = 0.1 + 0.2 * math.ceil(num_entries / num_legend_columns)
    figure = plt.figure(figsize=(width * columns, height * rows + strip), layout="constrained")
    grid = figure.add_gridspec(1 + rows, columns, height_ratios=(strip, *[height] * rows))
    legend = figure.add_subplot(grid[0, :])
    legend.axis("off")
    panels = [figure.add_subplot(grid[1 + i // columns, i % columns]) for i in range(num_panels)]

    def finish():
        entries = {}
        for axes in panels:
            for handle, label in zip(*axes.get_legend_handles_labels()):
                entries.setdefault(label, handle)
        box = legend.legend(entries.values(), entries.keys(), loc="center",
                            ncol=num_legend_columns, frameon=False, borderaxespad=0.0,
                            fontsize="small")
        box.set_in_layout(False)
        return figure

    return panels, finish


def draw_success(results):
    results = posed(results)
    if not results:
        return None
    methods, sets = names_of(results, "method"), names_of(results, "set")
    width = 0.8 / len(methods)
    num_bars = len(methods) * len(sets)
    (axes,), finish = make_panels(1, len(methods), 2.6, min(7.2, max(3.6, 1.0 + 0.28 * num_bars)))
    for m, method in enumerate(methods):
        places, rates, below, above = [], [], [], []
        for s, name in enumerate(sets):
            own = [r for r in results if r["method"] == method and r["set"] == name]
            if not own:
                continue
            rate = sum(r["succeeds"] for r in own) / len(own)
            low, high = wilson(sum(r["succeeds"] for r in own), len(own))
            places.append(s + (m - (len(methods) - 1) / 2) * width)
            rates.append(100 * rate)
            below.append(100 * (rate - low))
            above.append(100 * (high - rate))
        axes.bar(places, rates, 0.9 * width, yerr=(below, above), label=method,
                 color=style_of(methods, method)["color"],
                 error_kw={"elinewidth": 0.8, "capsize": 1.5})
    axes.set_xticks(range(len(sets)), [name or "all" for name in sets])
    axes.set_xlim(-0.6, len(sets) - 0.4)
    axes.set_ylim(0, 105)
    axes.set_xlabel("sequence")
    axes.set_ylabel("success [%]")
    return finish()


def draw_bins(results):
    results = posed(results)
    sets = [name for name in names_of(results, "set")
            if len(names_of([r for r in results if r["set"] == name], "bin")) > 1]
    if not sets:
        return None
    methods = names_of(results, "method")
    panels, finish = make_panels(len(sets), len(methods), 2.6, 7.2, are_stacked=len(sets) > 1)
    for axes, name in zip(panels, sets):
        bins = names_of([r for r in results if r["set"] == name], "bin")
        for m, method in enumerate(methods):
            rates, lows, highs, places = [], [], [], []
            for b, bin_name in enumerate(bins):
                own = [r for r in results
                       if (r["set"], r["bin"], r["method"]) == (name, bin_name, method)]
                if not own:
                    continue
                num = sum(r["succeeds"] for r in own)
                low, high = wilson(num, len(own))
                rate = num / len(own)
                rates.append(100 * rate)
                lows.append(100 * (rate - low))
                highs.append(100 * (high - rate))
                # Side by side, because otherwise methods that tie would hide
                # each other.
                places.append(b + 0.4 * ((m + 0.5) / len(methods) - 0.5))
            axes.errorbar(places, rates, (lows, highs), marker="o", markersize=3, elinewidth=0.8,
                          label=method, **style_of(methods, method))
        axes.set_xticks(range(len(bins)), bins)
        axes.set_xlim(-0.5, len(bins) - 0.5)
        axes.set_ylim(-3, 105)
        axes.set_ylabel("success [%]")
        axes.set_title(name, fontsize="medium", loc="left")
        axes.grid(axis="y", color="0.9")
    return finish()


def draw_distance(results):
    answers = [r for r in posed(results) if r["translation_error_m"] is not None
               and distance_of(r["bin"])]
    if not answers:
        return None
    methods = names_of(answers, "method")
    bins = sorted(names_of(answers, "bin"), key=distance_of)
    width = 0.8 / len(methods)
    is_wide = len(methods) * len(bins) > 18
    panels, finish = make_panels(2, len(methods), 2.4, 7.2 if is_wide else 3.6, is_wide)
    for axes, (column, label) in zip(panels, ERRORS):
        for m, method in enumerate(methods):
            color = style_of(methods, method)["color"]
            data, places = [], []
            for b, name in enumerate(bins):
                own = [max(r[column], FLOOR) for r in answers
                       if r["method"] == method and r["bin"] == name]
                if own:
                    data.append(own)
                    places.append(b + (m - (len(methods) - 1) / 2) * width)
            axes.boxplot(data, positions=places, widths=0.8 * width, whis=(5, 95),
                         showfliers=False, patch_artist=True, manage_ticks=False,
                         boxprops={"facecolor": color, "edgecolor": color, "alpha": 0.6},
                         medianprops={"color": "black", "linewidth": 1.2},
                         whiskerprops={"color": color}, capprops={"color": color})
            axes.plot([], [], color=color, linewidth=6, alpha=0.6, label=method)
        axes.set_yscale("log")
        axes.set_xticks(range(len(bins)),
                        [name.removesuffix(" m").replace("-", "–") for name in bins])
        axes.set_xlim(-0.6, len(bins) - 0.4)
        axes.set_xlabel("distance [m]")
        axes.set_ylabel(label)
        axes.grid(axis="y", color="0.9")
        axes.set_axisbelow(True)
    return finish()


def draw_yaw(results):
    answers = [r for r in posed(results) if r["translation_error_m"] is not None
               and yaw_of(r["bin"]) is not None]
    if not answers:
        return None
    methods = names_of(answers, "method")
    panels, finish = make_panels(2, len(methods), 2.6)
    for axes, (column, label) in zip(panels, ERRORS):
        for method in methods:
            style = style_of(methods, method)
            by_yaw = {}
            for r in answers:
                if r["method"] == method:
                    by_yaw.setdefault(yaw_of(r["bin"]), []).append(max(r[column], FLOOR))
            yaws = sorted(by_yaw)
            axes.plot(yaws, [quantile(by_yaw[y], 0.5) for y in yaws], marker="o", markersize=3,
                      label=method, **style)
            axes.fill_between(yaws, [quantile(by_yaw[y], 0.25) for y in yaws],
                              [quantile(by_yaw[y], 0.75) for y in yaws], color=style["color"],
                              alpha=0.15, linewidth=0)
        axes.set_yscale("log")
        axes.xaxis.set_major_locator(matplotlib.ticker.MaxNLocator(steps=[1, 3, 6, 10]))
        axes.set_xlabel("added yaw [deg]")
        axes.set_ylabel(label)
        axes.grid(color="0.9")
    return finish()


def draw_tilt(results):
    pairs = {(r["set"], r["bin"], r["pair"]): r for r in results
             if r["true_tilt_deg"] is not None and r["true_yaw_deg"] is not None}
    if not pairs:
        return None
    figure, panels = plt.subplots(1, 2, figsize=(7.0, 2.6), layout="constrained", sharey=True)
    tilts = [r["true_tilt_deg"] for r in pairs.values()]
    yaws = [abs(r["true_yaw_deg"]) for r in pairs.values()]
    # The same number of bins for both, so that the shares are comparable.
    top = math.ceil(max(max(tilts), 0.5) * 2) / 2
    for axes, values, end, label in ((panels[0], tilts, top, "relative roll-pitch [deg]"),
                                     (panels[1], yaws, 180.0, "relative yaw [deg]")):
        axes.hist(values, bins=[end * i / 18 for i in range(19)],
                  weights=[100 / len(values)] * len(values), color="tab:blue", edgecolor="white",
                  linewidth=0.5)
        axes.set_xlabel(label)
        axes.set_xlim(0, end)
        median = quantile(values, 0.5)
        axes.axvline(median, color="black", linewidth=1, linestyle="--")
        axes.set_title(f"median {median:.2f} deg", loc="right", fontsize="small")
    panels[0].set_ylabel("pairs [%]")
    panels[1].set_xticks(range(0, 181, 30))
    return figure


def order_stages(results):
    """Stages in an order that is consistent with each result."""
    stages = []
    for result in results:
        own = list(result["stages"])
        for i, stage in enumerate(own):
            if stage not in stages:
                later = [stages.index(other) for other in own[i + 1:] if other in stages]
                stages.insert(min(later, default=len(stages)), stage)
    return stages


def draw_timing(results):
    results = [r for r in results if r["status"] != "unreadable" and r["stages"]]
    if not results:
        return None
    methods, stages = names_of(results, "method"), order_stages(results)
    panels, finish = make_panels(2, len(stages), 0.6 + 0.25 * len(methods))
    for axes, left_out in zip(panels, ((), FRONT_END)):
        ends = [0.0] * len(methods)
        for i, stage in enumerate(stages):
            if stage in left_out:
                continue
            medians = [quantile([r["stages"].get(stage, 0.0) for r in results
                                 if r["method"] == method], 0.5) for method in methods]
            axes.barh(methods, medians, left=ends, label=stage, color=plt.get_cmap("tab20")(i % 20),
                      hatch=("", "//", "..")[i // 20 % 3], edgecolor="white", linewidth=0.3)
            ends = [end + median for end, median in zip(ends, medians)]
        for i, end in enumerate(ends):
            axes.text(end, i, f" {end:.3g}", va="center", fontsize="small")
        axes.set_xlim(0, 1.2 * max(max(ends), 1e-6))
        axes.invert_yaxis()
    panels[1].set_yticks(range(len(methods)), [""] * len(methods))
    panels[0].set_xlabel("all stages, median [ms]")
    panels[1].set_xlabel("after matching, median [ms]")
    return finish()


def draw_recall(results):
    results = posed(results)
    if not results:
        return None
    methods = names_of(results, "method")
    panels, finish = make_panels(2, len(methods), 2.6)
    for axes, (column, _), end, label in zip(panels, ERRORS, (3.0, 15.0),
                                             ("allowed translation error [m]",
                                              "allowed rotation error [deg]")):
        for method in methods:
            own = [r for r in results if r["method"] == method]
            errors = sorted(r[column] for r in own if r[column] is not None)
            shares = [100 * (i + 1) / len(own) for i in range(len(errors))]
            # A step at each error, extended to the end.
            num = sum(e <= end for e in errors)
            x = [0.0, *errors[:num], end]
            y = [0.0, *shares[:num], shares[num - 1] if num else 0.0]
            axes.step(x, y, where="post", label=method, **style_of(methods, method))
        axes.set_xlim(0, end)
        axes.set_ylim(0, 103)
        axes.set_xlabel(label)
        axes.grid(color="0.9")
    panels[0].set_ylabel("pairs [%]")
    return finish()


FIGURES = {"success": draw_success, "bins": draw_bins, "distance": draw_distance,
           "yaw": draw_yaw, "tilt": draw_tilt, "timing": draw_timing, "recall": draw_recall}


def main(args):
    parser = Parser(__doc__)
    parser.add_argument("run", metavar="RUN", help="folder with results.csv or tilts.csv")
    parser.add_argument("--output", metavar="FOLDER", help="folder for the figures (default: RUN/figures)")
    parser.add_argument("--figures", default=",".join(FIGURES), metavar="A,B",
                        help="figures to draw (default: all)")
    parser.add_argument("--limit", default="2/10", metavar="M/DEG",
                        help="error limits of a success (default: 2/10)")
    options = parser.parse_args(args)
    chosen = options.figures.split(",")
    for name in chosen:
        if name not in FIGURES:
            raise BadInput(f"--figures: {name!r} is not one of {','.join(FIGURES)}")
    limit = parse_limit(options.limit)
    results = read_results(options.run)
    for result in results:
        result["succeeds"] = succeeds(result, limit)
    folder = options.output or os.path.join(options.run, "figures")
    check_folder(folder)
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise BadInput(f"{folder}: {reason(error)}") from None
    # Fonts that journals accept.
    plt.rcParams.update({"pdf.fonttype": 42, "font.size": 9})
    for name in chosen:
        figure = FIGURES[name](results)
        if figure is None:
            continue
        for suffix, metadata in (("pdf", {"CreationDate": None}), ("png", {"Software": None})):
            path = os.path.join(folder, f"{name}.{suffix}")
            save_picture(figure, path, dpi=150, metadata=metadata)
            print(path)
        plt.close(figure)


if __name__ == "__main__":
    run_script(main)
