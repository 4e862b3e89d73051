#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Prints the results of quatro_benchmark as a Markdown table on standard output.

    quatro_benchmark --benchmark_out=run.json
    tabulate_benchmark.py run.json [--clock=cpu] [--picture=growth.png]

There is a row for each stage and case (names are stage/who/case). Times are medians over
repetitions. --clock=cpu sums over all threads, which is more meaningful on a busy
machine. "of the limit" is our time divided by that of `limit` in the same run. The
column of a library has its time and, in brackets, the ratio to ours. "of one thread"
is the time of threads:2 divided by that of threads:1. Memory is the peak, and its
ratio to the bits of a graph. The picture requires Matplotlib (with_python.sh finds a
Python that has it) and shows times over N.
Exit code: 0; 2 if a flag or a file is invalid, with one line that says which.
"""
import collections
import json
import math
import re
import statistics
import sys

from script_support import (BadInput, Parser, check_picture, reason, run_script, save_picture,
                            summary_stream)

OURS, LIMIT = "quatro", "limit"
MILLISECONDS = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
# Counters that do not describe a stage's input or output.
OWN_COLUMNS = ("peak_bytes", "bitset_bytes", "bytes_per_second")
NOT_COUNTERS = {"name", "run_name", "run_type", "family_index", "per_family_instance_index",
                "repetitions", "repetition_index", "threads", "iterations", "real_time",
                "cpu_time", "time_unit", "aggregate_name", "aggregate_unit", "error_occurred",
                "error_message"}

# One benchmark. The time is None if it was not run, and `error` gives the
# reason.
Measured = collections.namedtuple("Measured", "ms error counters")


def parse_name(name, where):
    """(stage, who, case), without the parts that Google Benchmark adds."""
    parts = [part for part in name.split("/")
             if part not in ("process_time", "real_time") and not re.match(r"(min_time|iterations|repeats):", part)]
    if len(parts) < 2 or not all(parts):
        raise BadInput(f"{where}: {name!r} is not stage/who/case")
    return parts[0], parts[1], "/".join(parts[2:])


def measure(entries, clock, where):
    error = next((e.get("error_message", "failed") for e in entries if e.get("error_occurred")),
                 None)
    if error is not None:
        return Measured(None, error, {})
    runs = [e for e in entries if e.get("run_type", "iteration") == "iteration"]
    runs = runs or [e for e in entries if e.get("aggregate_name") == "median"]
    if not runs:
        raise BadInput(f"{where}: {entries[0]['name']!r} has neither a run nor a median")
    times = []
    for run in runs:
        time, unit = run.get(clock), run.get("time_unit")
        if not isinstance(time, (int, float)) or not time > 0.0 or not math.isfinite(time) \
                or unit not in MILLISECONDS:
            raise BadInput(f"{where}: {run['name']!r}: {clock} = {time!r} {unit}, must be > 0")
        times.append(time * MILLISECONDS[unit])
    counters = {key: value for key, value in runs[-1].items()
                if key not in NOT_COUNTERS and isinstance(value, (int, float))}
    return Measured(statistics.median(times), None, counters)


def read_run(path, clock):
    """(context, {(stage, case): {who: Measured}}), in the order of the file."""
    try:
        with open(path, encoding="utf-8") as file:
            run = json.load(file)
    except OSError as error:
        raise BadInput(f"{path}: {reason(error)}") from None
    except ValueError as error:
        raise BadInput(f"{path}: is not JSON: {error}") from None
    entries = run.get("benchmarks") if isinstance(run, dict) else None
    if not isinstance(entries, list) or not entries:
        raise BadInput(f"{path}: has no benchmarks")
    groups = {}
    for entry in entries:
        if not isinstance(entry, dict) or not isinstance(entry.get("name"), str):
            raise BadInput(f"{path}: a benchmark has no name")
        groups.setdefault(entry.get("run_name", entry["name"]), []).append(entry)
    rows = {}
    for name, group in groups.items():
        stage, who, case = parse_name(name, path)
        rows.setdefault((stage, case), {})[who] = measure(group, clock, path)
    return run.get("context", {}), rows


def number(value):
    """Formats with at most three digits."""
    if value == int(value) and abs(value) < 1e7:
        return str(int(value))
    if abs(value) >= 100.0:
        return f"{value:.0f}"
    return f"{value:.3g}"


def ratio(a, b):
    """a / b as text, "" unless both were measured."""
    if a is None or b is None or a.ms is None or b.ms is None:
        return ""
    return number(a.ms / b.ms)


def time_cell(measured):
    if measured is None:
        return ""
    return f"- ({measured.error})" if measured.ms is None else number(measured.ms)


def count_cell(counters):
    cells = [f"{key} {number(value)}" for key, value in sorted(counters.items())
             if key not in OWN_COLUMNS]
    if "bytes_per_second" in counters:
        cells.append(f"{number(counters['bytes_per_second'] / 1e9)} GB/s")
    return ", ".join(cells)


def memory_cell(counters):
    if "peak_bytes" not in counters:
        return ""
    cell = number(counters["peak_bytes"] / 2**20)
    if counters.get("bitset_bytes"):
        cell += f" ({number(counters['peak_bytes'] / counters['bitset_bytes'])})"
    return cell


def one_thread(rows, stage, case):
    found = re.search(r"(^|/)threads:([0-9]+)$", case)
    if not found or found[2] == "1":
        return None
    other = case[:found.start(2)] + "1"
    return rows.get((stage, other), {}).get(OURS)


def make_table(rows):
    peers = sorted({who for row in rows.values() for who in row} - {OURS, LIMIT})
    header = ["stage", "case", "quatro [ms]", "limit [ms]", "of the limit",
              *(f"{peer} [ms]" for peer in peers), "of one thread", "memory [MiB]", "counted"]
    lines = []
    for (stage, case), row in rows.items():
        ours, limit = row.get(OURS), row.get(LIMIT)
        of_peers = []
        for peer in peers:
            cell, factor = time_cell(row.get(peer)), ratio(row.get(peer), ours)
            of_peers.append(f"{cell} ({factor})" if factor else cell)
        counters = (ours or limit or next(iter(row.values()))).counters
        lines.append([stage, case, time_cell(ours), time_cell(limit), ratio(ours, limit), *of_peers,
                      ratio(ours, one_thread(rows, stage, case)), memory_cell(counters),
                      count_cell(counters)])
    # Drops columns that are empty in every row.
    kept = [k for k, _ in enumerate(header) if k < 3 or any(line[k] for line in lines)]
    return [[line[k] for k in kept] for line in [header, *lines]]


def format_table(table):
    widths = [max(map(len, column)) for column in zip(*table)]
    table = [table[0], ["-" * width for width in widths], *table[1:]]
    return "".join("| " + " | ".join(cell.ljust(width) for cell, width in zip(line, widths)) + " |\n"
                   for line in table)


def describe(context):
    custom = [f"{key} {context[key]}" for key in
              ("cpu", "simd", "threads", "preset", "pair", "version", "compiler") if key in context]
    load = context.get("load_avg") or []
    if load:
        custom.append("load at the start " + number(load[0]) + f" of {context.get('num_cpus')} cores")
    return "; ".join(custom)


def curves_over_size(rows):
    """{"stage, who, case without N": [(N, ms)]}, with at least two sizes."""
    curves = collections.defaultdict(list)
    for (stage, case), row in rows.items():
        parts = case.split("/")
        size = next((part[2:] for part in parts if re.fullmatch("N:[0-9]+", part)), None)
        if size is None:
            continue
        rest = [part for part in parts if not part.startswith("N:")]
        for who, measured in row.items():
            if measured.ms is not None:
                curves[", ".join([stage, who, *rest])].append((int(size), measured.ms))
    return {name: sorted(curve) for name, curve in curves.items() if len(curve) > 1}


def draw(rows, path):
    curves = curves_over_size(rows)
    if not curves:
        raise BadInput("--picture: no stage was measured at two sizes N or more")
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(7.0, 5.0), layout="constrained")
    for name, curve in curves.items():
        is_limit = name.split(", ")[1] == LIMIT
        axes.plot(*zip(*curve), label=name, marker=".", linestyle="--" if is_limit else "-")
    axes.set(xscale="log", yscale="log", xlabel="matches N", ylabel="time [ms]")
    axes.grid(True, which="major", alpha=0.4)
    axes.legend()
    save_picture(figure, path, dpi=150)


def main(args):
    parser = Parser(__doc__)
    parser.add_argument("json", metavar="RUN.json", help="output of quatro_benchmark --benchmark_out")
    parser.add_argument("--picture", metavar="FILE.png", help="times over N")
    parser.add_argument("--clock", choices=("real", "cpu"), default="real",
                        help="time to use (default: real)")
    options = parser.parse_args(args)
    if options.picture:
        check_picture(options.picture, [options.json])
    context, rows = read_run(options.json, f"{options.clock}_time")
    table = format_table(make_table(rows))
    if options.picture:
        draw(rows, options.picture)
    out = summary_stream(options.picture)
    out.write(table)
    if context:
        out.write(f"\n{describe(context)}\n")


if __name__ == "__main__":
    run_script(main)
