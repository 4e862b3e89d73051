#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Measures how similar simulated scans are to real ones for registration.

    compare_kitti.py --real=DATA/pairs.csv --simulated=05 [--simulated=street/pairs.csv]

Runs quatro_register on pairs with a known pose, and prints by distance the medians
of the number of 0.3 m voxels of a scan, the number of mutual matches, and the share
of matches that are within 0.6 m under the true pose.

Then prints the same for each simulated list, and for all of them together, relative
to all real lists together, and how many of these ratios are within a factor of 1.5.

A list is a pairs.csv in the format of run_pairs.py, or a folder in KITTI's layout.
From a folder, pairs of frames are drawn that match the distances (within 0.4 m) and
yaws (within 20 deg) of the real pairs, if there are such pairs. Scans of real lists
with fewer than --min_points points are left out, because they have been thinned.
Exit code: 0; 2 if a flag or a file is invalid.
"""
import collections
import csv
import json
import math
import os
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile

from run_pairs import DEFAULT_PROGRAM, check_program, read_pairs
from script_support import BadInput, Parser, Progress, reason, run_script, split_flags

BINS = (0.0, 2.5, 7.5, 12.5, 17.5, 25.0, 40.0)  # [m]
MAX_ERROR = 0.6  # Of an inlier [m].
LIKE_DISTANCE = 0.4  # Tolerance between a simulated and a real pair, of the distance [m]
LIKE_YAW = math.radians(20.0)  # and of the yaw between the scans.
CLOSE = 1.5  # A ratio within 1/1.5 .. 1.5 is close.

Pair = collections.namedtuple("Pair", "source target pose")  # pose: (R, t)


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def inverse(pose):
    rotation = [[pose[j][i] for j in range(3)] for i in range(3)]
    return [row + [-sum(r * pose[k][3] for k, r in enumerate(row))] for row in rotation] + \
        [[0.0, 0.0, 0.0, 1.0]]


def read_matrices(path, prefix=""):
    """3x4 matrices of the lines that start with `prefix`, extended to 4x4."""
    try:
        lines = pathlib.Path(path).read_text(encoding="utf-8-sig").splitlines()
        rows = [[float(x) for x in line[len(prefix):].split()] for line in lines
                if line.strip() and line.startswith(prefix)]
    except (OSError, UnicodeDecodeError, ValueError) as error:
        raise BadInput(f"{path}: {reason(error)}") from None
    if not rows or any(len(row) != 12 for row in rows):
        raise BadInput(f"{path}: must have 12 numbers per line")
    return [[row[0:4], row[4:8], row[8:12], [0.0, 0.0, 0.0, 1.0]] for row in rows]


def heading(pose):
    return math.atan2(pose[1][0], pose[0][0])


def turn_between(a, b):
    return abs(math.remainder(a - b, 2.0 * math.pi))


def pairs_of_sequence(folder, per_bin, seed, models=None):
    """For each bin, pairs with the distances and yaws of the models in turn; without models,
    any pairs."""
    tr = read_matrices(folder / "calib.txt", "Tr:")[0]
    world_from_sensor = [product(product(inverse(tr), pose), tr)
                         for pose in read_matrices(folder / "poses.txt")]
    headings = [heading(pose) for pose in world_from_sensor]
    by_bin = collections.defaultdict(list)
    for i, target in enumerate(world_from_sensor):
        for j in range(i + 1, len(world_from_sensor)):
            source = world_from_sensor[j]
            distance = math.dist([r[3] for r in source[:3]], [r[3] for r in target[:3]])
            by_bin[bin_of(distance)].append((i, j, distance))
    draw = random.Random(seed)
    pairs = []
    for number, candidates in sorted(by_bin.items(), key=lambda item: str(item[0])):
        if number is None:
            continue
        for i, j, _ in draw_like(candidates, (models or {}).get(number, []), headings, per_bin, draw):
            pose = product(inverse(world_from_sensor[i]), world_from_sensor[j])
            scans = [str(folder / "velodyne" / f"{k:06d}.bin") for k in (j, i)]
            pairs.append(Pair(*scans, ([row[:3] for row in pose[:3]],
                                       [row[3] for row in pose[:3]])))
    return pairs


def draw_like(candidates, models, headings, num, draw):
    """`num` of the candidates (i, j, distance), similar to each model (distance, yaw) in turn if
    there are such candidates."""
    candidates = draw.sample(candidates, len(candidates))
    if not models:
        return candidates[:num]
    drawn = []
    for k in range(min(num, len(candidates))):
        distance, yaw = models[k % len(models)]
        like = next((pair for pair in candidates
                     if abs(pair[2] - distance) <= LIKE_DISTANCE and
                     turn_between(headings[pair[1]] - headings[pair[0]], yaw) <= LIKE_YAW),
                    candidates[0])
        candidates.remove(like)
        drawn.append(like)
    return drawn


def bin_of(distance):
    """Index of the bin, or None beyond the last."""
    for i in range(len(BINS) - 1):
        if BINS[i] <= distance < BINS[i + 1]:
            return i
    return None


def models_of(pairs):
    """Bin -> (distance, yaw) of its pairs."""
    models = collections.defaultdict(list)
    for pair in pairs:
        distance = math.hypot(*pair.pose[1])
        models[bin_of(distance)].append((distance, heading(pair.pose[0])))
    return models


def read_list(path, per_bin, seed, min_points, exclude, models):
    path = pathlib.Path(path)
    if path.is_dir():
        return pairs_of_sequence(path, per_bin, seed, models)
    pairs = [Pair(str(path.parent / pair.source), str(path.parent / pair.target), pair.pose)
             for pair in read_pairs(str(path), exclude) if pair.pose is not None]
    pairs = [pair for pair in pairs
             if all(scan.endswith(".bin") and os.path.getsize(scan) >= 16 * min_points
                    for scan in (pair.source, pair.target))]
    by_bin = collections.defaultdict(list)
    for pair in pairs:
        by_bin[bin_of(math.hypot(*pair.pose[1]))].append(pair)
    draw = random.Random(seed)
    return [pair for number, group in by_bin.items() if number is not None
            for pair in draw.sample(group, min(per_bin, len(group)))]


def measure(pair, program, flags):
    """(voxels of a scan, matches, inlier share)"""
    with tempfile.TemporaryDirectory() as folder:
        matches = os.path.join(folder, "matches.csv")
        run = subprocess.run([program, f"--source={pair.source}", f"--target={pair.target}",
                              f"--correspondences_out={matches}", *flags],
                             stdin=subprocess.DEVNULL, capture_output=True, text=True,
                             check=False)
        if run.returncode not in (0, 1):
            raise BadInput((run.stderr.strip() or f"{program}: failed").splitlines()[-1])
        counts = json.loads(run.stdout)["counts"]
        rotation, translation = pair.pose
        num_true = num_all = 0
        with open(matches, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                source = [float(row[name]) for name in ("sx", "sy", "sz")]
                target = [float(row[name]) for name in ("tx", "ty", "tz")]
                moved = [sum(r * s for r, s in zip(rotation[i], source)) + translation[i]
                         for i in range(3)]
                num_all += 1
                num_true += math.dist(moved, target) < MAX_ERROR
    voxels = (counts["source_voxels"] + counts["target_voxels"]) / 2
    return voxels, num_all, num_true / max(1, num_all)


def summarize(pairs, name, program, flags):
    by_bin = collections.defaultdict(list)
    progress = Progress(writes_over=True)
    for i, pair in enumerate(pairs, 1):
        by_bin[bin_of(math.hypot(*pair.pose[1]))].append(measure(pair, program, flags))
        progress(f"{name}: {i}/{len(pairs)} ", i == len(pairs))
    return by_bin


def format_table(columns):
    """One line per distance; for each column: pairs, voxels, matches, inlier share."""
    lines = ["".join([f"{'':11}"] + [f"{name[-34:]:>36}" for name, _ in columns]),
             "".join([f"{'distance m':11}"] +
                     [f"{'pairs':>6}{'voxels':>9}{'matches':>9}{'true %':>12}" for _ in columns])]
    for i in range(len(BINS) - 1):
        line = f"{BINS[i]:g}-{BINS[i + 1]:g}"
        line = f"{line:11}"
        for _, by_bin in columns:
            group = by_bin.get(i, [])
            if group:
                voxels, matches, share = medians(group)
                line += f"{len(group):6}{voxels:9.0f}{matches:9.0f}{100 * share:12.1f}"
            else:
                line += f"{'-':>6}{'-':>9}{'-':>9}{'-':>12}"
        lines.append(line)
    return "\n".join(lines) + "\n"


def medians(group):
    """(voxels, matches, inlier share)"""
    return tuple(statistics.median(values) for values in zip(*group))


def pool(by_bins):
    """The union of several lists in each bin."""
    together = collections.defaultdict(list)
    for by_bin in by_bins:
        for i, group in by_bin.items():
            together[i] += group
    return together


def ratios(real, simulated):
    """Bin -> simulated / real of voxels, matches and inlier share, if both have pairs. Real
    numbers are nonzero except for the share, whose ratio is then nan."""
    return {i: tuple(s / r if r else math.nan
                     for r, s in zip(medians(real[i]), medians(simulated[i])))
            for i in sorted(real) if real[i] and simulated.get(i)}


def is_close(ratio):
    return 1.0 / CLOSE <= ratio <= CLOSE


def format_ratios(real, simulated):
    """One line per distance for each simulated (name, by_bin)."""
    lines = []
    for name, by_bin in simulated:
        of_bins = ratios(real, by_bin)
        flat = [ratio for row in of_bins.values() for ratio in row]
        lines += ["", f"{name} / real",
                  f"{'distance m':11}{'voxels':>9}{'matches':>9}{'true %':>12}"]
        for i, row in of_bins.items():
            label = f"{BINS[i]:g}-{BINS[i + 1]:g}"
            lines.append(f"{label:11}{row[0]:9.2f}{row[1]:9.2f}{row[2]:12.2f}")
        lines.append(f"within a factor of {CLOSE:g}: {sum(map(is_close, flat))} of {len(flat)}")
    return "\n".join(lines) + "\n"


def parse_args(args):
    parser = Parser(__doc__, usage="compare_kitti.py --real=LIST --simulated=LIST ... "
                                   "[-- FLAGS OF quatro_register]")
    parser.add_argument("--real", metavar="LIST", action="append", default=[])
    parser.add_argument("--simulated", metavar="LIST", action="append", default=[])
    parser.add_argument("--exclude", metavar="SET", action="append", default=[],
                        help="leave out this set of the real lists; may be repeated")
    parser.add_argument("--pairs_per_bin", type=int, default=8)
    parser.add_argument("--min_points", type=int, default=90000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--program", default=str(DEFAULT_PROGRAM), metavar="FILE")
    own, flags = split_flags(args)
    return parser.parse_args(own), flags


def main(args):
    options, flags = parse_args(args)
    if not options.real and not options.simulated:
        raise BadInput("there is neither --real nor --simulated")
    check_program(options.program)
    columns = []
    real = []
    for path in options.real + options.simulated:
        is_real = len(columns) < len(options.real)
        pairs = read_list(path, options.pairs_per_bin, options.seed,
                          options.min_points if is_real else 0,
                          options.exclude if is_real else [],
                          {} if is_real else models_of(real))
        if not pairs:
            raise BadInput(f"{path}: there are no pairs to compare")
        if is_real:
            real += pairs
        name = ("real " if is_real else "simulated ") + os.path.basename(str(path).rstrip("/"))
        columns.append((name, summarize(pairs, name, options.program, flags)))
    sys.stdout.write(format_table(columns))
    num_real = len(options.real)
    if 0 < num_real < len(columns):
        simulated = columns[num_real:]
        if len(simulated) > 1:
            simulated = simulated + [("all simulated", pool(by_bin for _, by_bin in simulated))]
        sys.stdout.write(format_ratios(pool(by_bin for _, by_bin in columns[:num_real]), simulated))


if __name__ == "__main__":
    run_script(main)
