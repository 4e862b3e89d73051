#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Puts the tables of experiments/reproduce.sh on one page of Markdown.

    report_paper.py FOLDER > report.md

Before the tables it compares the paper's findings with this run: the finding, the
numbers of this run, and whether it holds. For the runs of Table I it also explains
why: how many matches were consistent, and which pairs Quatro misses but others do not.
Missing runs are reported as such.
Exit code: 0; 2 if FOLDER contains none of the runs, with one line that says so.
"""
import json
import os
import statistics

from script_support import BadInput, read_rows, reason, run_script

RUNS = ("table_one", "table_one_paper", "table_two", "table_three", "loops", "yaw",
        "timing", "synthetic")
TITLES = {
    "table_one": "Success of loop pairs, 9-12 m [%] (Table I)",
    "table_one_paper": "Success with the paper's parameters, --preset=paper",
    "table_two": "Drift of odometry on 00 (Table II)",
    "table_three": "Errors by distance on 06 (Table III)",
    "loops": "Success of loops by distance [%], by the rules of kitti_lc",
    "yaw": "Errors over the added yaw",
    "timing": "Median times [ms]",
    "synthetic": "Matched points with known poses",
}
TABLES = {"table_one": "tables/table_one.csv", "table_one_paper": "tables/table_one.csv",
          "table_two": "table_two.csv",
          "table_three": "tables/table_three.csv", "loops": "tables/kitti_lc.csv",
          "yaw": "tables/by_bin.csv",
          "timing": "tables/timing.csv", "synthetic": "tables/by_bin.csv"}
FIGURES = {"table_one": ("success", "recall"), "table_one_paper": ("success", "recall"),
           "table_three": ("distance",), "loops": ("distance",), "yaw": ("yaw",),
           "timing": ("timing",), "synthetic": ("bins",)}
# Figures without a table, in the folder of reproduce.sh.
# The parts of the search of which one is off, in folders of ablation/.
PARTS = {"none": "nothing", "consensus": "consensus search", "segments": "segments",
         "cliques": "cliques", "geometric_choice": "choice by geometry",
         "guided_matching": "guided matching", "rung_2": "rungs 2 and 3", "rung_3": "rung 3"}
WORLDS = ("street", "crossing", "hill")
MORE_FIGURES = {"Relative roll-pitch and yaw of loops up to 12 m": "tilt/figures/tilt.png",
                "Surrogates of truncated least squares": "surrogates.png"}


def read_csv(path, needed=("method",)):
    rows, columns = read_rows(path, needed)
    return columns, [row for _, row in rows]


def read_manifest(path):
    try:
        with open(path, encoding="utf-8") as file:
            manifest = json.load(file)
    except (OSError, ValueError) as error:
        raise BadInput(f"{path}: {reason(error)}") from None
    for name in ("version", "commit", "start_time"):
        if not isinstance(manifest, dict) or name not in manifest:
            raise BadInput(f"{path}: has no {name!r}; is it from an experiment?")
    return manifest


def number(row, column):
    try:
        return float(row[column])
    except (KeyError, ValueError):
        return None


def measured(rows):
    return [row for row in rows if row.get("origin", "measured") == "measured"]


def row_of(rows, method, **where):
    for row in measured(rows):
        if row["method"] == method and all(row.get(key) == value for key, value in where.items()):
            return row
    return {}


def markdown(columns, rows):
    kept = [column for column in columns
            if not column.endswith((" low", " high")) and "all answers" not in column
            and any(row[column] for row in rows)]
    lines = ["| " + " | ".join(kept) + " |", "|" + "---|" * len(kept)]
    for row in rows:
        cells = [row[column] or "-" for column in kept]
        if row.get("origin") == "quoted":
            cells[0] += " (quoted)"
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def finding(claim, figures, holds):
    told = "no data in this run" if holds is None else ("holds" if holds else "does not hold")
    return f"| {claim} | {figures} | {told} |"


def show(value, digits=2):
    return "-" if value is None else f"{value:.{digits}f}"


def success_findings(what, columns, rows):
    sets = [column for column in columns
            if column not in ("method", "origin", "all") and not column.endswith((" low", " high"))]
    for name in sets + ["all"]:
        quatro, teaser, fgr, ransac = (number(row_of(rows, method), name)
                                       for method in ("quatro", "teaser", "fgr", "ransac10k"))
        if quatro is None:
            continue
        yield finding(f"{what}{name}: Quatro at 99 % or more", show(quatro), quatro >= 99.0)
        if teaser is not None:
            yield finding(f"{what}{name}: Quatro above TEASER++", f"{show(quatro)} and {show(teaser)}",
                          quatro > teaser)
        if fgr is not None and ransac is not None:
            yield finding(f"{what}{name}: FGR and RANSAC10K far below Quatro (by 20 points or more)",
                          f"{show(fgr)} and {show(ransac)}", max(fgr, ransac) <= quatro - 20.0)


def ins_findings(columns, rows):
    for column in columns:
        if "r_avg" not in column or column.endswith((" low", " high")):
            continue
        plain = number(row_of(rows, "quatro"), column)
        with_ins = number(row_of(rows, "quatro_ins"), column)
        if plain is not None and with_ins is not None:
            yield finding(f"{column}: Quatro with INS has smaller rotation errors than without",
                          f"{show(with_ins, 3)} and {show(plain, 3)}", with_ins < plain)


def drift_findings(rows):
    row = row_of(rows, "quatro_c2f")
    one, five = (number(row, f"t_rel % at {interval}") for interval in (1, 5))
    if one is None or five is None:
        return
    yield finding("Quatro-c2f as good at interval 5 as at 1 (t_rel at most 1.5 times)",
                  f"{show(five)} and {show(one)} %", five <= 1.5 * one)


def is_within(row, translation, rotation):
    errors = number(row, "translation_error_m"), number(row, "rotation_error_deg")
    return None not in errors and errors[0] <= translation and errors[1] <= rotation


def is_success(row):
    """Within 2 m and 10 deg."""
    return is_within(row, 2.0, 10.0)


def reasons(name, folder):
    """Sentences about the run of Table I in `folder`, from its results.csv; none without it."""
    path = os.path.join(folder, "results.csv")
    if not os.path.exists(path):
        return
    by_method = {}
    for row in read_csv(path, ("method", "pair"))[1]:
        by_method.setdefault(row["method"], {})[row["pair"]] = row
    ours = by_method.get("quatro", {})
    if not ours:
        return
    consistent = statistics.median(number(row, "consistent") or 0.0 for row in ours.values())
    right = {method: {pair for pair, row in rows.items() if is_success(row)}
             for method, rows in by_method.items()}
    missed = set(ours) - right["quatro"]
    yield (f"`{name}`: the median pair has {consistent:g} consistent matches. "
           f"Quatro misses {len(missed)} of {len(ours)} pairs.")
    for method in ("teaser", "ransac10k", "fgr"):
        if method in right:
            yield (f"`{name}`: {method} is correct on {len(missed & right[method])} of the pairs that "
                   f"Quatro misses, and misses {len(right['quatro'] - right[method])} that Quatro "
                   "has.")


def write_run(name, folder):
    columns, rows = read_csv(os.path.join(folder, TABLES[name]))
    print(f"\n## {TITLES[name]}\n")
    manifest = os.path.join(folder, "manifest.json")
    if os.path.exists(manifest):
        made = read_manifest(manifest)
        print(f"`{name}/manifest.json`: version {made['version']}, commit {made['commit']}, "
              f"{made['start_time']}.\n")
    print(markdown(columns, rows))
    for figure in FIGURES.get(name, ()):
        path = f"figures/{figure}.png"
        if os.path.exists(os.path.join(folder, path)):
            print(f"\n![{figure}]({name}/{path})")


def write_ablation(root):
    """Success on pairs 20 to 30 m apart without each part of the search."""
    lines = []
    for part, name in PARTS.items():
        rows, cells = [], []
        for world in WORLDS:
            path = os.path.join(root, "ablation", part, f"{world}.csv")
            if not os.path.exists(path):
                break
            of_world = read_csv(path, ("status", "total_ms"))[1]
            rows += of_world
            cells.append(f"{sum(is_within(row, 2.0, 5.0) for row in of_world)} of {len(of_world)}")
        else:
            registered = [row for row in rows if row["status"] == "registered"]
            cells += [str(len(registered)),
                      str(sum(not is_within(row, 2.0, 10.0) for row in registered)),
                      f"{statistics.median(number(row, 'total_ms') or 0.0 for row in rows):.0f}"]
            lines.append(f"| {name} | " + " | ".join(cells) + " |")
    if lines:
        print("\n## Simulated pairs 20 to 30 m apart, one part of the search off, within 2 m and 5 deg\n\n"
              f"| off | {' | '.join(WORLDS)} | registered | of these incorrect | median ms |\n"
              "|---|---|---|---|---|---|---|")
        for line in lines:
            print(line)


def main(arguments):
    if len(arguments) != 1:
        raise BadInput("give only the folder of reproduce.sh")
    root = arguments[0]
    present = [name for name in RUNS if os.path.exists(os.path.join(root, name, TABLES[name]))]
    if not present:
        raise BadInput(f"{root}: contains none of the runs {', '.join(RUNS)}")
    findings = []
    for name, what in (("table_one", ""), ("table_one_paper", "paper's parameters, ")):
        if name in present:
            findings += success_findings(what, *read_csv(os.path.join(root, name, TABLES[name])))
    if "table_three" in present:
        findings += ins_findings(
            *read_csv(os.path.join(root, "table_three", TABLES["table_three"])))
    if "table_two" in present:
        findings += drift_findings(
            read_csv(os.path.join(root, "table_two", TABLES["table_two"]))[1])
    print("# The paper's tables, reproduced\n\n| the paper | here | |\n|---|---|---|")
    for line in findings:
        print(line)
    why = [line for name in ("table_one", "table_one_paper") if name in present
           for line in reasons(name, os.path.join(root, name))]
    if why:
        print("\nWhy: the more matches are consistent, the more methods solve everything and tie. A "
              "pair that all methods miss has too few consistent matches for any of them.\n")
        for line in why:
            print(f"- {line}")
    for name in RUNS:
        if name in present:
            write_run(name, os.path.join(root, name))
        else:
            print(f"\n## {TITLES[name]}\n\nNot run.")
    write_ablation(root)
    for title, path in MORE_FIGURES.items():
        if os.path.exists(os.path.join(root, path)):
            print(f"\n## {title}\n\n![{title}]({path})")


if __name__ == "__main__":
    run_script(main)
