#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Kills, full disks, rights and scans taken away, and too little memory: that
nothing is lost and that each is told in one line.

    tests/faults/faults.py [--programs=build/bin] [--pairs=200] [--kills=50]
                           [--seed=1] [--limit_step=1.05] [PART...]

PART is kills, disk, files, rights or memory; all of them without. Prints a line
for each; exits with 1 at the first that does not hold. What needs a right that
is not there (mount, another user) is skipped, by name, and the exit code is 77
if that was all."""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import disk  # pylint: disable=wrong-import-position
import kills
import memory
import rights
from small_run import Fault, Skipped, SmallRun, check, check_same

PARTS = ("kills", "disk", "files", "rights", "memory")


def tell(part, text):
    print(f"{part}: {text}", flush=True)


def test_kills(args, run, whole, scratch, seconds):
    num_runs, done = kills.run_kills(run, whole, scratch, args.kills, args.seed, seconds)
    tell("kills", f"{len(done)} kills -9 over {num_runs} run(s) of {run.num_pairs} pairs, "
         f"at {sorted(done)} pairs done; the same results and tables")


def test_disk(args, run, whole, scratch, seconds):
    for place, (done, told) in disk.run_full_disk(run, whole, scratch).items():
        tell("disk", f"full at the {place}, {done} pairs done; gone on with, the same. {told}")


def test_files(args, run, whole, scratch, seconds):
    scans = [f"{run.folder}/scans/000_{end}.bin" for end in ("source", "target")]
    matches = f"{scratch}/matches.csv"
    subprocess.run([f"{args.programs}/quatro_register", f"--source={scans[0]}",
                    f"--target={scans[1]}", "--preset=indoor",
                    f"--correspondences_out={matches}"], check=False,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    check(os.path.getsize(matches) > 1000, "no matches to solve")
    register = [f"{args.programs}/quatro_register", f"--source={scans[0]}",
                f"--target={scans[1]}", "--preset=indoor"]
    commands = {
        "register_json": (register + ["--json={}"], "answer.json", 0),
        "register_matches": (register + ["--correspondences_out={}"], "matches.csv", 1),
        "solve_json": ([f"{args.programs}/quatro_solve", f"--correspondences={matches}",
                        "--preset=indoor", "--json={}"], "answer.json", 0),
        "simulate": ([f"{args.programs}/quatro_simulate", "--output={}", "--num_frames=2"],
                     "drive", 1)}
    for name, told in disk.run_full_disk_files(commands, scratch).items():
        tell("files", f"{name}: {told}")


def test_rights(args, run, whole, scratch, seconds):
    if not rights.may_be_nobody():
        raise Skipped("cannot be another user")
    os.chmod(scratch, 0o755)
    for how in ("rights", "files"):
        count = rights.run_scans_go_away(run, whole, scratch, how)
        tell("rights", f"scans' {how} taken away under a run: {count} pairs unreadable, each "
             "noted; the others the same")
    for told in rights.run_output_is_closed(run, whole, scratch):
        tell("rights", f"output read-only: {told}")
    tell("rights", "writable again: gone on with, the same")


def test_memory(args, run, whole, scratch, seconds):
    scans = [f"{run.folder}/scans/000_{end}.bin" for end in ("source", "target")]
    matches, answer = f"{scratch}/many.csv", f"{scratch}/answer.json"
    with open(matches, "w", encoding="ascii") as file:
        for i in range(20000):
            x, y, z = i % 97 / 7, i % 89 / 5, i % 31 / 3
            file.write(f"{x},{y},{z},{x + 1},{y + (i % 3) * (i % 11)},{z}\n")
    threads = "--threads=4"
    commands = {
        "register": [f"{args.programs}/quatro_register", f"--source={scans[0]}",
                     f"--target={scans[1]}", "--preset=indoor", threads, f"--json={answer}"],
        "solve": [f"{args.programs}/quatro_solve", f"--correspondences={matches}",
                  "--method=quatro", threads, f"--json={answer}"]}

    def pose():
        with open(answer, encoding="utf8") as file:
            return json.load(file)["target_from_source"]

    def remove():
        if os.path.exists(answer):
            os.remove(answer)

    for name, command in commands.items():
        code = subprocess.run(command, check=False, stderr=subprocess.DEVNULL).returncode
        before = pose()
        least, enough, too_small = memory.run_limits(
            command, answer, remove, lambda: pose() == before, (code,), args.limit_step)
        tell("memory", f"{name}: {too_small} limits from {least} MiB, told in one line; "
             f"{enough:.0f} MiB are enough")
    output = f"{scratch}/limited"

    def is_same():
        check_same(output, whole)
        return True

    least, enough, too_small = memory.run_limits(
        run.command(output), f"{output}/results.csv", lambda: None, is_same, (0,),
        args.limit_step)
    tell("memory", f"experiment: {too_small} limits from {least} MiB, told in one line, then gone "
         f"on with to the same tables; {enough:.0f} MiB are enough")


def main():
    root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--programs", default=f"{root}/build/bin")
    parser.add_argument("--pairs", type=int, default=200)
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--limit_step", type=float, default=1.05)
    parser.add_argument("parts", nargs="*", metavar="PART", help=", ".join(PARTS))
    args = parser.parse_args()
    args.programs = os.path.abspath(args.programs)
    unknown = [part for part in args.parts if part not in PARTS]
    if unknown:
        parser.error(f"{unknown[0]}: must be one of {', '.join(PARTS)}")
    with tempfile.TemporaryDirectory(prefix="quatro_faults_") as scratch:
        run = SmallRun(args.programs, f"{scratch}/data", args.pairs, seed=args.seed)
        whole = f"{scratch}/whole"
        begin = time.monotonic()
        run.finish(whole)
        seconds = time.monotonic() - begin
        tell("undisturbed", f"{args.pairs} pairs in {seconds:.1f} s")
        parts = args.parts or PARTS
        num_skipped = 0
        for part in parts:
            try:
                globals()[f"test_{part}"](args, run, whole, scratch, seconds)
            except Skipped as reason:
                tell(part, f"SKIPPED, {reason}")
                num_skipped += 1
            except Fault as fault:
                tell(part, f"FAILED, {fault}")
                return 1
    return 77 if num_skipped == len(parts) else 0


if __name__ == "__main__":
    sys.exit(main())
