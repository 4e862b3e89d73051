# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""A run of many small pairs, started, killed and compared."""

import csv
import math
import os
import random
import struct
import subprocess

METHODS = ("quatro", "ransac1k")
TIMES = ("total_ms", "stages_ms")  # The columns that no two runs share.


class Fault(Exception):
    """What should have held and did not."""


class Skipped(Exception):
    """What can't be tried here, and why."""


def check(holds, message):
    if not holds:
        raise Fault(message)


def room(rng, num_points):
    """Points of two walls, a floor and a few boxes in a room of 12 m by 9 m."""
    boxes = [(rng.uniform(-5, 5), rng.uniform(-4, 4)) for _ in range(6)]
    points = []
    for i in range(num_points):
        a, b = rng.random(), rng.random()
        if i % 4 == 0:
            points.append((12 * a - 6, 9 * b - 4.5, 0.0))
        elif i % 4 == 1:
            points.append((-6.0, 9 * a - 4.5, 2.5 * b))
        elif i % 4 == 2:
            points.append((12 * a - 6, 4.5, 2.5 * b))
        else:
            x, y = boxes[i % len(boxes)]
            points.append((x + 0.8 * a, y + 0.6 * math.sin(6 * b), 1.5 * b))
    return points


def moved(points, yaw, x, y):
    c, s = math.cos(yaw), math.sin(yaw)
    return [(c * p[0] - s * p[1] + x, s * p[0] + c * p[1] + y, p[2])
            for p in points]


def write_bin(path, points):
    with open(path, "wb") as file:
        for p in points:
            file.write(struct.pack("<4f", *p, 0.0))


def write_pairs(folder, num_pairs, num_points, seed):
    """scans/NNN.bin and pairs.csv, which names each scan pair by pair."""
    rng = random.Random(seed)
    os.makedirs(f"{folder}/scans", exist_ok=True)
    lines = ["source,target,tx,ty,tz,qx,qy,qz,qw"]
    for i in range(num_pairs):
        points = room(rng, num_points)
        yaw, x, y = rng.uniform(-3, 3), rng.uniform(-2, 2), rng.uniform(-2, 2)
        write_bin(f"{folder}/scans/{i:03}_source.bin", points)
        write_bin(f"{folder}/scans/{i:03}_target.bin", moved(points, yaw, x, y))
        lines.append(f"scans/{i:03}_source.bin,scans/{i:03}_target.bin,{x},{y},"
                     f"0,0,0,{math.sin(yaw / 2)},{math.cos(yaw / 2)}")
    with open(f"{folder}/pairs.csv", "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")


class SmallRun:
    """The experiment on the pairs of a folder, as one command."""

    def __init__(self, programs, folder, num_pairs, num_points=600, seed=1):
        self.programs = programs
        self.folder = folder
        self.num_pairs = num_pairs
        write_pairs(folder, num_pairs, num_points, seed)

    def command(self, output, *more):
        return [f"{self.programs}/quatro_experiment", "--protocol=pairs",
                f"--pairs={self.folder}/pairs.csv", "--preset=indoor",
                f"--methods={','.join(METHODS)}", "--threads=2",
                f"--output={output}", *more]

    def start(self, output, *more, wrapper=(), **options):
        return subprocess.Popen([*wrapper, *self.command(output, *more)],
                                stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, **options)

    def finish(self, output):
        """The command as it is, to its end, which must be a good one."""
        end = ended(self.start(output))
        check(end.code == 0, f"exit code {end.code}, not 0: {end.told}")


class Ended:
    def __init__(self, code, stderr):
        self.code = code
        # Without the progress, which a carriage return writes over.
        lines = stderr.decode(errors="replace").split("\n")
        lines = [line.rsplit("\r", 1)[-1] for line in lines]
        self.told = [line for line in lines
                     if line.strip() and " s left" not in line]

    def check_one_line(self, code, *parts):
        check(self.code == code, f"exit code {self.code}, not {code}: {self.told}")
        check(len(self.told) == 1, f"not one line but {self.told}")
        for part in parts:
            check(part in self.told[0], f"no '{part}' in: {self.told[0]}")


def ended(process):
    _, stderr = process.communicate()
    return Ended(process.returncode, stderr)


def finished_pairs(output):
    """The pairs in rows.csv with a line for each method."""
    try:
        with open(f"{output}/rows.csv", encoding="utf8") as file:
            lines = file.read().split("\n")[1:-1]
    except FileNotFoundError:
        return []
    names = [line.split(",")[0] for line in lines]
    whole = len(names) // len(METHODS) * len(METHODS)
    return names[0:whole:len(METHODS)]


def outcome(output):
    """All that a run leaves but its times: file -> content."""
    files = {}
    with open(f"{output}/results.csv", encoding="utf8", newline="") as file:
        rows = list(csv.DictReader(file))
    files["results.csv"] = [
        {name: cell for name, cell in row.items() if name not in TIMES}
        for row in rows]
    for name in sorted(os.listdir(f"{output}/tables")):
        if name.startswith("timing"):
            continue
        with open(f"{output}/tables/{name}", "rb") as file:
            files[name] = file.read()
    return files


def check_same(output, whole):
    now, before = outcome(output), outcome(whole)
    check(now.keys() == before.keys(), f"{sorted(now)} for {sorted(before)}")
    for name, content in before.items():
        check(now[name] == content, f"{output}/{name} is not that of {whole}")
    left = [name for name in os.listdir(output) if ".tmp." in name]
    check(not left, f"{output}: left behind {left}")
