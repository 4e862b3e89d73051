#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""One table of several methods on the same scan pairs.

    compare_methods.py --pairs=pairs.csv --methods=quatro,teaser,fgr [--output=FOLDER] [-- FLAGS]

Runs run_pairs.py's measurement with each --method of quatro_register and prints
a row each, as Markdown: pairs registered, within the three limits, wrong but
registered, median and mean error of those within 2 m and 10 deg, median time of
front end and of the rest, and the largest memory of a run. The folder gets
METHOD.csv, a line per pair, and METHOD.run, what made it. A run that was stopped
goes on from what is there, if it was made by the same flags.

Exit code: 0; 2 if a flag or a file is wrong, with one line that says which.
"""
import argparse
import csv
import json
import os
import pathlib
import statistics
import sys

import run_pairs

FRONT_END = ("voxels", "features", "matching")


def summarize(method, results):
    def values(key, chosen):
        return [float(result[key]) for result in chosen if result[key] != ""]

    posed = [result for result in results if result["success_2m_10deg"] != ""]
    good = [result for result in posed if int(result["success_2m_10deg"])]

    def middle(key, chosen, digits):
        found = values(key, chosen)
        if not found:
            return "- / -"
        return f"{statistics.median(found):.{digits}f} / {statistics.fmean(found):.{digits}f}"

    def stage_sum(result, in_front):
        stages = (item.split("=") for item in result["stages_ms"].split(";") if item)
        return sum(float(time) for stage, time in stages if (stage in FRONT_END) == in_front)

    timed = [result for result in results if result["stages_ms"]]

    def time(in_front):
        return f"{statistics.median(stage_sum(r, in_front) for r in timed):.1f}" if timed else "-"

    memory = values("peak_mb", results)
    return (method, str(sum(result["status"] == "registered" for result in results)),
            *(str(sum(int(result[key]) for result in posed)) for key in run_pairs.SUCCESS),
            str(sum(int(result["wrong_but_registered"]) for result in results)),
            middle("translation_error_m", good, 3), middle("rotation_error_deg", good, 2),
            time(True), time(False), f"{max(memory):.0f}" if memory else "-")


def run_path(path):
    return os.path.splitext(path)[0] + ".run"


def read_results(path, run):
    try:
        with open(run_path(path), encoding="utf-8") as file:
            same = json.load(file) == run
    except (OSError, json.JSONDecodeError):
        same = False
    if not same:
        raise run_pairs.BadInput(f"{path}: was made by other flags or from other pairs; "
                                 "remove it or name another --output")
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def main(args):
    parser = run_pairs.Parser(prog="compare_methods.py", description=__doc__, allow_abbrev=False,
                              formatter_class=argparse.RawDescriptionHelpFormatter,
                              usage="compare_methods.py --pairs=FILE --methods=A,B [options] "
                                    "[-- FLAGS OF quatro_register]")
    parser.add_argument("--pairs", metavar="FILE.csv", required=True, help="the list of pairs")
    parser.add_argument("--methods", metavar="A,B", required=True,
                        help="of quatro_register --list_methods")
    parser.add_argument("--output", metavar="FOLDER", help="for a file per method")
    parser.add_argument("--program", default=str(run_pairs.DEFAULT_PROGRAM), metavar="FILE",
                        help="quatro_register (default: that in build/bin)")
    parser.add_argument("--exclude", action="append", default=[], metavar="SET",
                        help="leave out this set; may be repeated")
    split = args.index("--") if "--" in args else len(args)
    options, flags = parser.parse_args(args[:split]), args[split + 1:]
    pairs = run_pairs.read_pairs(options.pairs, options.exclude)
    if options.output:
        try:
            os.makedirs(options.output, exist_ok=True)
        except OSError as error:
            raise run_pairs.BadInput(f"{options.output}: {error.strerror}") from None
    rows = [("method", "registered", *(f"{m:g} m {d:g} deg" for m, d in run_pairs.SUCCESS.values()),
             "wrong", "median / mean [m]", "median / mean [deg]", "front end [ms]", "rest [ms]",
             "memory [MB]")]
    for method in options.methods.split(","):
        own = [*flags, f"--method={method}"]
        path = options.output and os.path.join(options.output, f"{method}.csv")
        run = run_pairs.describe_run(options.pairs, options.exclude, options.program, own)
        if path and os.path.exists(path):
            results = read_results(path, run)
        else:
            done = run_pairs.Done(path and path + ".part", run)
            print(f"{method}:", file=sys.stderr)
            results = run_pairs.run_all(pairs, pathlib.Path(options.pairs).parent, options.program,
                                        own, 1, done)
            if path:
                run_pairs.write_atomically(run_path(path), json.dumps(run) + "\n")
                run_pairs.write_atomically(path, run_pairs.format_results(results))
                done.remove()
        rows.append(summarize(method, results))
    rows.insert(1, ("---",) * len(rows[0]))
    sys.stdout.write("".join("| " + " | ".join(row) + " |\n" for row in rows))


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except run_pairs.BadInput as problem:
        print(f"compare_methods.py: {problem}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        print("compare_methods.py: interrupted", file=sys.stderr)
        sys.exit(130)
