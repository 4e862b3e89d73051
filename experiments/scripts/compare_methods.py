#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""One table that compares several methods on the same scan pairs.

    compare_methods.py --pairs=pairs.csv --methods=quatro,teaser,fgr [--output=FOLDER]
        [--outside=NAME=results.csv] [-- FLAGS]

Runs the measurement of run_pairs.py with each --method of quatro_register and prints
one row per method, as Markdown: registered pairs, pairs within the three limits, false
registrations, median and mean error of those within 2 m and 10 deg, median time of
the front end and of the rest, and the largest memory of a run. The folder gets
METHOD.csv, a line per pair, and METHOD.run, the parameters of the run. An interrupted
run is resumed if the parameters are the same.

--outside=NAME=FILE adds a row NAME with the results of another program. A line is

    source,target,m00,m01,m02,m03,m10,...,m23[,0,0,0,1]

with both paths as in the list of pairs and the rows of the 3x4 or 4x4 matrix that
moves the source onto the target. A pair without an answer is left out of the file;
every pair in it counts as registered. Empty lines, lines that start with #, a first
line that starts with source,target, and pairs of excluded sets are ignored.

Exit code: 0; 2 if a flag or a file is invalid, with one line that says which.
"""
import csv
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys

import run_pairs
from script_support import (BadInput, Parser, check_folder, check_writable, parse_number,
                            read_rows, reason, run_script, split_flags, write_atomically)

FRONT_END = ("voxels", "features", "matching")
MAX_DEVIATION = 1e-3  # Of R^T R from the identity, per element.


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
            str(sum(int(result["wrong_but_registered"] or 0) for result in results)),
            middle("translation_error_m", good, 3), middle("rotation_error_deg", good, 2),
            time(True), time(False), f"{max(memory):.0f}" if memory else "-")


def parse_matrix(fields, where):
    """4 rows of 4, the last one 0 0 0 1."""
    if len(fields) not in (12, 16):
        raise BadInput(f"{where} has {len(fields)} numbers after source and target, "
                       "must have 12 or 16")
    values = [parse_number(field, f"{where} number {number}")
              for number, field in enumerate(fields, 1)]
    rows = [values[i:i + 4] for i in range(0, len(values), 4)]
    if len(rows) == 3:
        rows.append([0.0, 0.0, 0.0, 1.0])
    if math.dist(rows[3], (0.0, 0.0, 0.0, 1.0)) > 1e-6:
        raise BadInput(f"{where} does not end with the row 0 0 0 1")
    a, b, c = ([row[j] for row in rows[:3]] for j in range(3))
    deviation = max(abs(sum(x * y for x, y in zip(u, v)) - (u is v))
                    for u in (a, b, c) for v in (a, b, c))
    determinant = sum(a[i] * (b[i - 2] * c[i - 1] - b[i - 1] * c[i - 2]) for i in range(3))
    if not deviation <= MAX_DEVIATION or determinant < 0.0:
        raise BadInput(f"{where} is not a rotation and a translation")
    return rows


def parse_outside(text):
    """Splits NAME=FILE."""
    name, _, path = text.partition("=")
    if not name or not path:
        raise BadInput(f"--outside={text}: must be NAME=FILE.csv")
    return name, path


def read_outside(path, known):
    """(source, target) -> matrix; each must be one of `known`."""
    try:
        with open(path, encoding="utf-8") as file:
            lines = file.read().splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise BadInput(f"{path}: {reason(error)}") from None
    found = {}
    for number, line in enumerate(lines, 1):
        fields = [field.strip() for field in next(csv.reader([line]), ())]
        if not any(fields) or line.startswith("#"):
            continue
        if number == 1 and fields[:2] == ["source", "target"]:
            continue
        where = f"{path}: line {number}"
        pair = tuple(fields[:2])
        if pair not in known:
            raise BadInput(f"{where}: pair {','.join(pair)} is not in the list of pairs")
        if pair in found:
            raise BadInput(f"{where}: the pair {','.join(pair)} is listed twice")
        found[pair] = parse_matrix(fields[2:], where)
    if not found:
        raise BadInput(f"{path}: there are no pairs")
    return found


def measure_outside(pairs, found):
    results = []
    for pair in pairs:
        matrix = found.get((pair.source, pair.target))
        results.append(run_pairs.measure(pair, {
            "status": "no answer" if matrix is None else "registered",
            "target_from_source": matrix}))
    return results


def run_path(path):
    return os.path.splitext(path)[0] + ".run"


def check_methods(methods, program):
    """Checks the names, which become file names."""
    run_pairs.check_program(program)
    try:
        listed = subprocess.run([program, "--list_methods"], stdin=subprocess.DEVNULL,
                                capture_output=True, text=True, check=True).stdout
    except (OSError, UnicodeDecodeError, subprocess.CalledProcessError):
        raise BadInput(f"{program}: did not list its methods (--list_methods); "
                       "is it quatro_register?") from None
    names = [line.split()[0] for line in listed.splitlines() if line.strip()]
    for method in methods:
        if method not in names:
            raise BadInput(f"--methods: {method!r} is not one of {','.join(names)}")


def read_results(path, run, pairs):
    try:
        with open(run_path(path), encoding="utf-8") as file:
            same = json.load(file) == run
    except (OSError, ValueError):
        same = False
    if not same:
        raise BadInput(f"{path}: was made with other flags or from other pairs; "
                       "remove it or choose another --output")
    results = [row for _, row in read_rows(path, run_pairs.RESULT_COLUMNS)[0]]
    found = [(result["set"], result["source"], result["target"]) for result in results]
    try:
        if found != [pair[:3] for pair in pairs]:
            raise ValueError
        summarize("", results)
    except (TypeError, ValueError):
        raise BadInput(f"{path}: does not contain the results of the pairs; "
                       "remove it to run them again") from None
    return results


def main(args):
    parser = Parser(__doc__, usage="compare_methods.py --pairs=FILE [--methods=A,B] [options] "
                                   "[-- FLAGS OF quatro_register]")
    parser.add_argument("--pairs", metavar="FILE.csv", required=True, help="the list of pairs")
    parser.add_argument("--methods", metavar="A,B", default="",
                        help="methods of quatro_register, see its --list_methods")
    parser.add_argument("--outside", action="append", default=[], metavar="NAME=FILE.csv",
                        help="add a row with the results of another program; may be repeated")
    parser.add_argument("--output", metavar="FOLDER", help="folder for a file per method")
    parser.add_argument("--program", default=str(run_pairs.DEFAULT_PROGRAM), metavar="FILE",
                        help="quatro_register (default: that in build/bin)")
    parser.add_argument("--exclude", action="append", default=[], metavar="SET",
                        help="leave out this set; may be repeated")
    own, flags = split_flags(args)
    options = parser.parse_args(own)
    if not options.methods and not options.outside:
        raise BadInput("there is neither --methods nor --outside")
    pairs = run_pairs.read_pairs(options.pairs, options.exclude)
    known = {(row["source"], row["target"]) for _, row in read_rows(options.pairs)[0]}
    methods = options.methods.split(",") if options.methods else []
    if methods:
        check_methods(methods, options.program)
    # Read these before hours of runs.
    outside = [(name, read_outside(path, known))
               for name, path in map(parse_outside, options.outside)]
    if options.output:
        check_folder(options.output)
        try:
            os.makedirs(options.output, exist_ok=True)
        except OSError as error:
            raise BadInput(f"{options.output}: {error.strerror}") from None
        inputs = [options.pairs, options.program,
                  *(path for _, path in map(parse_outside, options.outside)),
                  *run_pairs.scans_of(pairs, options.pairs)]
        for method in methods:
            for ending in (".csv", ".csv.part", ".run"):
                check_writable(os.path.join(options.output, method + ending), inputs)
    rows = [("method", "registered", *(f"{m:g} m {d:g} deg" for m, d in run_pairs.SUCCESS.values()),
             "false registrations", "median / mean [m]", "median / mean [deg]", "front end [ms]", "rest [ms]",
             "memory [MB]")]
    for method in methods:
        own = [*flags, f"--method={method}"]
        path = options.output and os.path.join(options.output, f"{method}.csv")
        run = run_pairs.describe_run(options.pairs, options.exclude, options.program, own)
        if path and os.path.exists(path):
            results = read_results(path, run, pairs)
        else:
            with run_pairs.Done(path and path + ".part", run) as done:
                print(f"{method}:", file=sys.stderr)
                results = run_pairs.run_all(pairs, pathlib.Path(options.pairs).parent,
                                            options.program, own, 1, done)
                if path:
                    write_atomically(run_path(path), json.dumps(run) + "\n")
                    write_atomically(path, run_pairs.format_results(results))
                    done.remove()
        rows.append(summarize(method, results))
    for name, found in outside:
        rows.append(summarize(name, measure_outside(pairs, found)))
    rows.insert(1, ("---",) * len(rows[0]))
    sys.stdout.write("".join("| " + " | ".join(row) + " |\n" for row in rows))


if __name__ == "__main__":
    run_script(main)
