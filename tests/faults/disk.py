# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""A small disk that gets full, in the middle of a run and at its end."""

import contextlib
import os
import subprocess

from small_run import Skipped, check, check_same, ended, finished_pairs

PAGE = 4096  # What the least file takes of a tmpfs.


@contextlib.contextmanager
def small_disk(folder, num_bytes):
    os.makedirs(folder, exist_ok=True)
    if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={num_bytes}", "tmpfs",
                       folder], stderr=subprocess.DEVNULL, check=False).returncode:
        raise Skipped("cannot mount a small disk")
    try:
        yield folder
    finally:
        subprocess.run(["umount", folder], check=True)


def grow(folder, num_bytes):
    subprocess.run(["mount", "-o", f"remount,size={num_bytes}", folder], check=True)


def sizes_to_try(whole):
    """Full within the rows; while results.csv is written; within the tables."""
    size = {name: os.path.getsize(f"{whole}/{name}")
            for name in ("rows.csv", "results.csv", "manifest.json")}
    pages = {name: -(-bytes // PAGE) for name, bytes in size.items()}
    rows = pages["rows.csv"] + pages["manifest.json"]
    return {"manifest": PAGE,
            "rows": (pages["rows.csv"] // 2 + pages["manifest.json"]) * PAGE,
            "results": (rows + pages["results.csv"] // 2) * PAGE,
            "tables": (rows + pages["results.csv"] + 1) * PAGE}


def run_full_disk(run, whole, scratch):
    """Where it got full -> pairs that were done then, and what was told."""
    found = {}
    for place, num_bytes in sizes_to_try(whole).items():
        with small_disk(f"{scratch}/disk_{place}", num_bytes) as disk:
            output = f"{disk}/run"
            end = ended(run.start(output))
            end.check_one_line(2, disk, "No space left on device")
            done = finished_pairs(output)
            grow(disk, 16 << 20)
            check(set(done) <= set(finished_pairs(output)), "lost pairs")
            run.finish(output)
            check_same(output, whole)
            found[place] = (len(done), end.told[0].replace(scratch, "..."))
    return found


def run_full_disk_files(commands, scratch):
    """name -> command with {} for the file or folder to write: nothing is left
    under that name, nor beside it."""
    told = {}
    for name, (command, file, free_pages) in commands.items():
        with small_disk(f"{scratch}/disk_{name}", 4 * PAGE) as disk:
            # All but so much of it is taken.
            with open(f"{disk}/filler", "wb") as filler:
                filler.write(b"x" * ((4 - free_pages) * PAGE))
            output = f"{disk}/{file}"
            process = subprocess.Popen([part.replace("{}", output) for part in command],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
            _, stderr = process.communicate()
            last = stderr.decode().strip().split("\n")[-1]
            check(process.returncode == 2, f"{name}: exit code {process.returncode}: {last}")
            check("No space left on device" in last and disk in last, f"{name}: {last}")
            left = [entry for entry in os.listdir(disk) if entry != "filler"]
            check(not left, f"{name}: left behind {left}")
            told[name] = last.replace(scratch, "...")
    return told
