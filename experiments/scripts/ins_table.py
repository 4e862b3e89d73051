#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Tabulates the rotation errors of quatro_register without and with an INS.

    ins_table.py --pairs=pairs.csv --ins=kitti_ins_rotation.csv [-- FLAGS OF quatro_register]

The pairs are those of run_pairs.py, with known poses. The measurements of the INS are
in --ins, by source and target, or in the list of pairs itself:

    source_rpy_deg,target_rpy_deg   "roll,pitch,yaw" of each cloud in one world, or
    qx,qy,qz,qw                     the rotation from source to target (only in --ins),
    ins_std_deg                     optional: standard deviation of roll and pitch.

A rotation is passed to quatro_register as the source's attitude, with zeros for the
target's. Pairs that are not in --ins are left out.

Prints one Markdown table. For each pair it has the error of the INS, of the whole
rotation and of the tilt (the angle between the verticals, all that Quatro uses), then
the error of the result for --ins_mode none (plain), relative, leveled and fused, with
--polish off and on. [deg]; "-" if there is no answer.

The table goes to standard output, progress to standard error.
Exit code: 0; 2 if a flag or a file is invalid, with one line that says which.
"""
import concurrent.futures
import math
import pathlib
import re
import statistics
import sys

import run_pairs
from script_support import (BadInput, Parser, Progress, check_writable, parse_number, read_rows,
                            run_script, split_flags, summary_stream, write_atomically)

MODES = ("none", "relative", "leveled", "fused")
RUNS = tuple((mode, polish) for mode in MODES for polish in ("off", "on"))
ERRORS = ("ins_error_deg", "ins_tilt_error_deg",
          *(f"{mode}_polish_{polish}_deg" for mode, polish in RUNS))
HEADER = ("pair", "INS", "INS tilt",
          *(f"{'plain' if mode == 'none' else mode}{', polish' if polish == 'on' else ''}"
            for mode, polish in RUNS))
RPY = ("source_rpy_deg", "target_rpy_deg")
QUATERNION = ("qx", "qy", "qz", "qw")
# Flags that this script sets, and a gravity axis that it does not support.
OWN_FLAGS = ("ins_mode", "polish", "gravity", "json", *RPY)


def multiply(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def transpose(a):
    return [list(column) for column in zip(*a)]


def rotation_from_rpy(rpy_deg):
    """World from body, R_z(yaw) R_y(pitch) R_x(roll)."""
    (sr, sp, sy), (cr, cp, cy) = ([f(math.radians(x)) for x in rpy_deg]
                                  for f in (math.sin, math.cos))
    return [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr]]


def rpy_from_rotation(r):
    return tuple(math.degrees(x) for x in (math.atan2(r[2][1], r[2][2]),
                                           math.atan2(-r[2][0], math.hypot(r[2][1], r[2][2])),
                                           math.atan2(r[1][0], r[0][0])))


def tilt_between_deg(a, b):
    """Angle between the up directions of the target, as rotations a and b map them to the source."""
    u, v = a[2], b[2]
    cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return math.degrees(math.atan2(math.hypot(*cross), sum(x * y for x, y in zip(u, v))))


def parse_attitudes(row, names, where):
    if RPY[0] in names:
        attitudes = []
        for name in RPY:
            parts = (row[name] or "").split(",")
            if len(parts) != 3:
                raise BadInput(f"{where}, column {name}: {row[name]!r}, must be three numbers")
            attitudes.append(tuple(parse_number(x, f"{where}, column {name}") for x in parts))
        return attitudes
    q = [parse_number(row[name], f"{where}, column {name}") for name in QUATERNION]
    norm = math.hypot(*q)
    if abs(norm - 1.0) > 1e-3:
        raise BadInput(f"{where}: the quaternion has length {norm:g}, must be 1")
    rotation = run_pairs.rotation_from_quaternion(*(x / norm for x in q))
    return [rpy_from_rotation(rotation), (0.0, 0.0, 0.0)]


def read_ins(path, is_own_file):
    """(source, target) -> (source's attitude, target's, standard deviation or None), in degrees."""
    rows, names = read_rows(path, ("source", "target"))
    ways = [RPY, QUATERNION] if is_own_file else [RPY]
    if not any(set(way) <= set(names) for way in ways):
        missing = " nor ".join(",".join(way) for way in ways)
        raise BadInput(f"{path}: has no columns {missing}"
                       + ("" if is_own_file else "; name a file that has them by --ins"))
    ins = {}
    for line, row in rows:
        where = f"{path}: line {line}"
        std = None
        if row.get("ins_std_deg"):
            std = parse_number(row["ins_std_deg"], f"{where}, column ins_std_deg")
        ins[row["source"], row["target"]] = (*parse_attitudes(row, names, where), std)
    return ins


def ins_flags(mode, polish, attitudes):
    source, target, std = attitudes
    flags = [f"--polish={polish}", f"--ins_mode={mode}"]
    if mode != "none":
        flags += [f"--{name}=" + ",".join(f"{x:.12g}" for x in rpy)
                  for name, rpy in zip(RPY, (source, target))]
    if std is not None and mode == "fused":
        flags.append(f"--ins_std_deg={std:.12g}")
    return flags


def tabulate(pairs, ins, folder, program, flags, num_jobs):
    """A row of errors per pair, in the order of ERRORS; None if there is no answer."""
    rows = [[None] * len(ERRORS) for _ in pairs]
    tasks = []
    progress = Progress()
    for row, pair in zip(rows, pairs):
        source, target, _ = attitudes = ins[pair.source, pair.target]
        rotation = multiply(transpose(rotation_from_rpy(target)), rotation_from_rpy(source))
        row[0] = run_pairs.angle_between_deg(pair.pose[0], rotation)
        row[1] = tilt_between_deg(pair.pose[0], rotation)
        tasks += [(row, 2 + k, pair, flags + ins_flags(*run, attitudes))
                  for k, run in enumerate(RUNS)]
    with concurrent.futures.ThreadPoolExecutor(num_jobs) as pool:
        futures = {pool.submit(run_pairs.register, pair, folder, program, all_flags):
                   (row, column, pair) for row, column, pair, all_flags in tasks}
        try:
            for num_done, future in enumerate(concurrent.futures.as_completed(futures), 1):
                row, column, pair = futures[future]
                matrix = future.result()["target_from_source"]
                if matrix is not None:
                    row[column] = run_pairs.angle_between_deg(pair.pose[0], matrix)
                progress(f"{num_done}/{len(tasks)} {pair.source} -> {pair.target}: "
                         f"{HEADER[column + 1]}, {cell(row[column])} deg",
                         num_done == len(tasks))
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return rows


def cell(value):
    return "-" if value is None else f"{value:.2f}"


def format_table(pairs, rows):
    lines = [(f"{pair.source} → {pair.target}", *map(cell, row)) for pair, row in zip(pairs, rows)]
    for name, of in (("median", statistics.median), ("mean", statistics.mean), ("largest", max)):
        columns = ([x for x in column if x is not None] for column in zip(*rows))
        lines.append((f"**{name}**", *(cell(of(column) if column else None) for column in columns)))
    widths = [max(map(len, column)) for column in zip(HEADER, *lines)]
    lines = [HEADER, tuple("-" * width for width in widths), *lines]
    return "".join(
        "| " + " | ".join([line[0].ljust(widths[0])] +
                          [x.rjust(width) for x, width in zip(line[1:], widths[1:])]) + " |\n"
        for line in lines)


def format_csv(pairs, rows):
    lines = [",".join(("source", "target", *ERRORS))]
    for pair, row in zip(pairs, rows):
        lines.append(",".join((pair.source, pair.target,
                               *("" if x is None else f"{x:.4f}" for x in row))))
    return "\n".join(lines) + "\n"


def parse_args(args):
    parser = Parser(__doc__, usage="ins_table.py --pairs=FILE [options] "
                                   "[-- FLAGS OF quatro_register]")
    parser.add_argument("--pairs", metavar="FILE.csv", required=True, help="the list of pairs")
    parser.add_argument("--ins", metavar="FILE.csv", help="measurements of the INS (default: --pairs)")
    parser.add_argument("--output", metavar="FILE.csv", help="also write the numbers to this file")
    parser.add_argument("--program", default=str(run_pairs.DEFAULT_PROGRAM), metavar="FILE",
                        help="quatro_register (default: that in build/bin)")
    parser.add_argument("--jobs", default="1", metavar="N", help="runs at a time (default: 1)")
    own, flags = split_flags(args)
    options = parser.parse_args(own)
    if not re.fullmatch("[1-9][0-9]{0,3}", options.jobs):
        raise BadInput(f"--jobs={options.jobs}: must be a whole number > 0")
    for flag in flags:
        if flag.lstrip("-").split("=")[0] in OWN_FLAGS:
            raise BadInput(f"{flag}: cannot be used here; the script sets it or does not support it")
    return options, flags


def main(args):
    options, flags = parse_args(args)
    if options.output:
        check_writable(options.output,
                       [options.pairs, options.ins or options.pairs, options.program])
    ins = read_ins(options.ins or options.pairs, bool(options.ins))
    pairs = [pair for pair in run_pairs.read_pairs(options.pairs, [])
             if (pair.source, pair.target) in ins]
    if options.output:
        check_writable(options.output, run_pairs.scans_of(pairs, options.pairs))
    if not pairs:
        raise BadInput(f"{options.ins}: contains none of the pairs in {options.pairs}")
    for pair in pairs:
        if pair.pose is None:
            raise BadInput(f"{options.pairs}: {pair.source} has no pose, so its error is unknown")
    flag = next((flag for flag in flags if flag.lstrip("-").startswith("ins_std_deg")), None)
    if flag and any(std is not None for *_, std in ins.values()):
        raise BadInput(f"{flag}: {options.ins or options.pairs} has a column for it")
    run_pairs.check_program(options.program)
    rows = tabulate(pairs, ins, pathlib.Path(options.pairs).parent, options.program, flags,
                    int(options.jobs))
    if options.output:
        write_atomically(options.output, format_csv(pairs, rows))
    summary_stream(options.output).write(format_table(pairs, rows))


if __name__ == "__main__":
    run_script(main)
