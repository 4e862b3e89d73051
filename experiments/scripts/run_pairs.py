#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Runs quatro_register over a list of scan pairs and measures the errors.

    run_pairs.py --pairs=pairs.csv --output=results.csv [-- FLAGS OF quatro_register]

The list has the columns source and target, paths relative to its folder, and
optionally set. With tx,ty,tz,qx,qy,qz,qw a pair's pose is known,

    p_in_target = R(q) p_in_source + t,

and the errors of an estimate are the angle of R_true^T R, the difference of the
two yaws, and |t - t_true|. Where a line leaves them empty, or without them where a
column "apart" is not empty, the scans share no place, and the right answer is not to
register them. Otherwise nothing is known of the pose, and no answer is wrong.

The summary is printed on standard output, progress on standard error. Run the same
command again to resume an interrupted run: completed pairs are in a file with the
output's name and .part.
Exit code: 0; 2 if a flag or a file is invalid, with one line that says which.
"""
import collections
import concurrent.futures
import csv
import fcntl
import hashlib
import io
import json
import math
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

from script_support import (BadInput, Parser, Progress, check_writable, parse_number, read_rows,
                            run_script, split_flags, summary_stream, write_atomically)

POSE = ("tx", "ty", "tz", "qx", "qy", "qz", "qw")
COUNTS = ("source_voxels", "target_voxels", "matches", "consistent", "rotation_inliers",
          "translation_inliers", "inliers")
# Limits in meters and degrees (of the whole rotation), whether or not it is
# registered.
SUCCESS = {"success_2m_10deg": (2.0, 10.0), "success_0.6m_5deg": (0.6, 5.0),
           "success_0.3m_1deg": (0.3, 1.0)}
RESULT_COLUMNS = ("set", "source", "target", "status", "rotation_error_deg", "yaw_error_deg",
                  "translation_error_m", *SUCCESS, "within_tolerance", "wrong_but_registered",
                  *COUNTS, "total_ms", "probability", "features", "stages_ms", "peak_mb", "regime",
                  "deviation_m", "deviation_deg", "pose_error", "covariance")

DEFAULT_PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "build/bin/quatro_register"

# pose: (R, t), or None if the scans share no place or, not is_known, nobody knows.
Pair = collections.namedtuple("Pair", "set source target pose is_known", defaults=(True,))


def rotation_from_quaternion(x, y, z, w):
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]


def angle_between_deg(a, b):
    """Angle of a^T b; from its skew part, so that small angles keep their digits."""
    c = [[sum(a[k][i] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
    sine = math.hypot(c[2][1] - c[1][2], c[0][2] - c[2][0], c[1][0] - c[0][1])
    return math.degrees(math.atan2(sine, c[0][0] + c[1][1] + c[2][2] - 1.0))


def pose_error(true_pose, matrix):
    """The error (w, d) of the covariance: R_true = exp([w]x) R, t_true = t + d."""
    true_rotation, true_translation = true_pose
    c = [[sum(true_rotation[i][k] * matrix[j][k] for k in range(3)) for j in range(3)]
         for i in range(3)]
    skew = [c[2][1] - c[1][2], c[0][2] - c[2][0], c[1][0] - c[0][1]]
    sine = math.hypot(*skew)
    angle = math.atan2(sine, c[0][0] + c[1][1] + c[2][2] - 1.0)
    factor = angle / sine if sine > 0.0 else 0.5
    return [factor * x for x in skew] + [t - row[3] for t, row in zip(true_translation, matrix)]


def yaw_deg(rotation):
    return math.degrees(math.atan2(rotation[1][0], rotation[0][0]))


def parse_pose(row, where):
    values = [parse_number(row[name], f"{where}, column {name}") for name in POSE]
    norm = math.hypot(*values[3:])
    if abs(norm - 1.0) > 1e-3:
        raise BadInput(f"{where}: the quaternion has length {norm:g}, must be 1")
    return rotation_from_quaternion(*(q / norm for q in values[3:])), values[:3]


def read_pairs(path, excluded):
    rows, names = read_rows(path, ("source", "target"))
    given = [name for name in POSE if name in names]
    if given and len(given) < len(POSE):
        missing = ",".join(name for name in POSE if name not in names)
        raise BadInput(f"{path}: the pose has no column {missing}")

    folder = pathlib.Path(path).parent
    pairs = []
    for line, row in rows:
        where = f"{path}: line {line}"
        if row.get("set", "") in excluded and "set" in names:
            continue
        for name in ("source", "target"):
            if not row[name] or not (folder / row[name]).is_file():
                raise BadInput(f"{where}, column {name}: there is no file {row[name]!r}")
        has_pose = given and any(row[name] for name in POSE)
        pairs.append(Pair(row.get("set") or pathlib.Path(path).stem, row["source"], row["target"],
                          parse_pose(row, where) if has_pose else None,
                          bool(given or row.get("apart"))))
    unknown = set(excluded) - {row.get("set") for _, row in rows}
    if unknown:
        raise BadInput(f"--exclude={min(unknown)}: {path} has no such set")
    if not pairs:
        raise BadInput(f"{path}: there are no pairs")
    return pairs


def register(pair, folder, program, flags):
    command = [program, f"--source={folder / pair.source}", f"--target={folder / pair.target}",
               *flags]
    with tempfile.TemporaryFile() as output, tempfile.TemporaryFile() as errors:
        try:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output,
                                       stderr=errors)
        except OSError as error:
            raise BadInput(f"{program}: {error.strerror}") from None
        try:
            _, status, usage = os.wait4(process.pid, 0)
        except BaseException:
            process.kill()
            raise
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        errors.seek(0)
        stdout, stderr = output.read().decode(), errors.read().decode(errors="replace")
    if process.returncode in (0, 1):
        try:
            report = json.loads(stdout)
        except json.JSONDecodeError:
            raise BadInput(f"{program}: its standard output is not JSON; "
                           "is there a --json among its flags?") from None
        report["peak_mb"] = round(usage.ru_maxrss / 1024.0, 1)  # Linux has kilobytes.
        return report
    if process.returncode == 2:
        raise BadInput((stderr.strip() or f"{program}: exit code 2").splitlines()[-1])
    return {"status": f"crashed ({process.returncode})", "target_from_source": None}


def measure(pair, report):
    result = dict.fromkeys(RESULT_COLUMNS, "")
    result.update(set=pair.set, source=pair.source, target=pair.target, status=report["status"])
    registered = report["status"] == "registered"
    counts = report.get("counts", {})
    result.update({name: counts.get(name, "") for name in COUNTS})
    result["total_ms"] = report.get("timings_ms", {}).get("total", "")
    result["stages_ms"] = ";".join(f"{stage}={time}" for stage, time
                                   in report.get("timings_ms", {}).items() if stage != "total")
    result["peak_mb"] = report.get("peak_mb", "")
    result["probability"] = report.get("probability", "")
    features = report.get("evidence", {}).get("features", {})
    result["features"] = ";".join(f"{name}={value:.6g}" for name, value in features.items())
    radius = report.get("error_radius") or {}
    result.update({name: radius.get(name, "")
                   for name in ("regime", "deviation_m", "deviation_deg")})
    result["covariance"] = ";".join(f"{value:.9g}" for row in report.get("covariance") or []
                                    for value in row)
    if pair.pose is None:
        result["wrong_but_registered"] = int(registered) if pair.is_known else ""
        return result
    result.update(dict.fromkeys((*SUCCESS, "within_tolerance"), 0))
    matrix = report["target_from_source"]
    if matrix is not None:
        true_rotation, true_translation = pair.pose
        rotation_error = angle_between_deg(true_rotation, matrix)
        yaw_error = abs(math.remainder(yaw_deg(matrix) - yaw_deg(true_rotation), 360.0))
        translation_error = math.dist([row[3] for row in matrix[:3]], true_translation)
        result.update(rotation_error_deg=f"{rotation_error:.4f}", yaw_error_deg=f"{yaw_error:.4f}",
                      translation_error_m=f"{translation_error:.4f}",
                      pose_error=";".join(f"{x:.9g}" for x in pose_error(pair.pose, matrix)))
        for name, (metres, degrees) in SUCCESS.items():
            result[name] = int(translation_error <= metres and rotation_error <= degrees)
        # What the verdict's probability is of: it follows the scale of the scans.
        tolerance = report.get("tolerance", {"translation_m": 2.0, "rotation_deg": 10.0})
        result["within_tolerance"] = int(translation_error <= tolerance["translation_m"] and
                                         rotation_error <= tolerance["rotation_deg"])
    result["wrong_but_registered"] = int(registered and not result["within_tolerance"])
    return result


def describe_run(pairs, exclude, program, flags):
    """Properties that must be equal to resume a run."""
    list_hash = hashlib.sha256(pathlib.Path(pairs).read_bytes()).hexdigest()
    return [os.path.abspath(pairs), list_hash, exclude, os.path.abspath(program), flags]


def open_locked(path):
    """Opens and locks a file for appending; fails if another process uses it."""
    while True:
        file = open(path, "a+b", buffering=0)
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise BadInput(f"{path}: another process is using this file; wait for it or stop it") from None
        if os.fstat(file.fileno()).st_nlink > 0:
            return file
        file.close()  # The previous owner removed it meanwhile.


def parse_done(line):
    """Index and result; None if the line is invalid."""
    try:
        index, result = json.loads(line)
        return (index, result) if result.keys() == set(RESULT_COLUMNS) else None
    except (AttributeError, TypeError, ValueError):
        return None


class Done:
    """The results so far, on disk: a line that describes the run, then a line per result.

    The file is locked while it is open, and is kept only if it contains a result.
    """

    def __init__(self, path, run):
        self.path, self.results, self.file = path, {}, None
        if not path:
            return
        self.head = json.dumps(run).encode() + b"\n"
        try:
            self.file = open_locked(path)
            self.file.seek(0)
            self.read(self.file.readall())
        except OSError as error:
            raise BadInput(f"{path}: {error.strerror}") from None

    def read(self, data):
        head, *lines = data.splitlines(keepends=True) or [b""]
        if data and head != self.head and (lines or not head.startswith(b'["/')):
            raise BadInput(f"{self.path}: belongs to another run, with other flags or pairs; "
                           "remove it to start again")
        # A truncated line is run again.
        if lines and not lines[-1].endswith(b"\n"):
            self.file.truncate(len(data) - len(lines.pop()))
        for number, line in enumerate(lines, 2):
            parsed = parse_done(line)
            if parsed:
                self.results[parsed[0]] = parsed[1]
            else:
                print(f"{self.path}: line {number} cannot be read; its pair is run again",
                      file=sys.stderr)
        if not self.results:
            self.file.truncate(0)

    def add(self, index, result):
        if self.file:
            line = json.dumps([index, result]).encode() + b"\n"
            if not self.results:
                line = self.head + line
            try:
                while line:
                    line = line[self.file.write(line):]
            except OSError as error:
                raise BadInput(f"{self.path}: {error.strerror}") from None
        self.results[index] = result

    def remove(self):
        self.results = {}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.file:
            if not self.results:
                pathlib.Path(self.path).unlink(missing_ok=True)
            self.file.close()


def run_all(pairs, folder, program, flags, num_jobs, done):
    start = time.monotonic()
    progress = Progress()
    left_over = [i for i in range(len(pairs)) if i not in done.results]
    with concurrent.futures.ThreadPoolExecutor(num_jobs) as pool:
        futures = {pool.submit(register, pairs[i], folder, program, flags): i for i in left_over}
        try:
            for num_done, future in enumerate(concurrent.futures.as_completed(futures), 1):
                i = futures[future]
                result = measure(pairs[i], future.result())
                done.add(i, result)
                elapsed = time.monotonic() - start
                left = round(elapsed / num_done * (len(left_over) - num_done))
                errors = (f", {result['translation_error_m']} m {result['rotation_error_deg']} deg"
                          if result["translation_error_m"] else "")
                progress(f"{len(done.results)}/{len(pairs)} {result['source']} -> "
                         f"{result['target']}: {result['status']}{errors}; "
                         f"{left // 60}:{left % 60:02d} left", num_done == len(left_over))
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return [done.results[i] for i in range(len(pairs))]


def format_results(results):
    text = io.StringIO()
    writer = csv.DictWriter(text, RESULT_COLUMNS, lineterminator="\n")
    writer.writeheader()
    writer.writerows(results)
    return text.getvalue()


def format_summary(results):
    """One line per set, and one for all sets."""
    rows = [("set", "pairs", "registered", *(f"{m:g} m {d:g} deg" for m, d in SUCCESS.values()),
             "false registrations", "median ms")]
    by_set = collections.defaultdict(list)
    for result in results:
        by_set[result["set"]].append(result)
    for name, group in [*by_set.items(), ("total", results)]:
        times = [result["total_ms"] for result in group if result["total_ms"] != ""]
        # Without a true pose there is no success to count.
        successes = ["-" if all(result[key] == "" for result in group)
                     else str(sum(result[key] or 0 for result in group)) for key in SUCCESS]
        wrong = [result["wrong_but_registered"] for result in group]
        rows.append((name, str(len(group)),
                     str(sum(result["status"] == "registered" for result in group)), *successes,
                     "-" if all(value == "" for value in wrong)
                     else str(sum(value or 0 for value in wrong)),
                     f"{statistics.median(times):.0f}" if times else "-"))
    widths = [max(map(len, column)) for column in zip(*rows)]
    return "".join(
        "  ".join([row[0].ljust(widths[0])] +
                  [cell.rjust(width) for cell, width in zip(row[1:], widths[1:])]) + "\n"
        for row in rows) + "false registrations: registered, but not within the tolerance of the verdict\n"


def check_program(path):
    if not os.access(path, os.X_OK) or os.path.isdir(path):
        raise BadInput(f"{path}: is not a program; build it or set --program")


def scans_of(pairs, path):
    """The paths of all scans of a list."""
    folder = pathlib.Path(path).parent
    return {folder / scan for pair in pairs for scan in (pair.source, pair.target)}


def parse_args(args):
    parser = Parser(__doc__, usage="run_pairs.py --pairs=FILE [options] [-- FLAGS OF quatro_register]")
    parser.add_argument("--pairs", metavar="FILE.csv", required=True, help="the list of pairs")
    parser.add_argument("--output", metavar="FILE.csv", help="file for one line per pair; -: standard output")
    parser.add_argument("--program", default=str(DEFAULT_PROGRAM), metavar="FILE",
                        help="quatro_register (default: that in build/bin)")
    parser.add_argument("--exclude", action="append", default=[], metavar="SET",
                        help="leave out this set; may be repeated")
    parser.add_argument("--jobs", default="1", metavar="N",
                        help="pairs at a time (default: 1; more make the times longer)")
    own, flags = split_flags(args)
    options = parser.parse_args(own)
    if not re.fullmatch("[1-9][0-9]{0,3}", options.jobs):
        raise BadInput(f"--jobs={options.jobs}: must be a whole number > 0")
    return options, flags


def main(args):
    options, flags = parse_args(args)
    is_file = options.output and options.output != "-"
    part = options.output + ".part" if is_file else None
    if options.output:
        check_writable(options.output, [options.pairs, options.program])
    if part:
        check_writable(part, [options.pairs, options.program])
    pairs = read_pairs(options.pairs, options.exclude)
    if options.output:
        check_writable(options.output, scans_of(pairs, options.pairs))
    if part:
        check_writable(part, scans_of(pairs, options.pairs))
    check_program(options.program)
    run = describe_run(options.pairs, options.exclude, options.program, flags)
    with Done(part, run) as done:
        results = run_all(pairs, pathlib.Path(options.pairs).parent, options.program, flags,
                          int(options.jobs), done)
        if options.output:
            write_atomically(options.output, format_results(results))
            done.remove()
    summary_stream(options.output).write(format_summary(results))


if __name__ == "__main__":
    run_script(main)
