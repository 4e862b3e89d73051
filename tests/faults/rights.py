# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Rights and scans that go away under a run. Rights do not bind root: as root,
the run is that of another user."""

import os
import shutil
import subprocess
import time

from small_run import METHODS, check, check_same, ended, finished_pairs, outcome

NOBODY = 65534


def as_nobody():
    if os.geteuid() != 0:
        return ()
    return ("setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups")


def may_be_nobody():
    if not as_nobody():
        return True
    return shutil.which("setpriv") is not None and subprocess.run(
        [*as_nobody(), "true"], check=False, stderr=subprocess.DEVNULL).returncode == 0


def give_away(folder):
    if os.geteuid() == 0:
        os.chown(folder, NOBODY, NOBODY)


def wait_for_pairs(output, count):
    deadline = time.monotonic() + 120
    while len(finished_pairs(output)) < count and time.monotonic() < deadline:
        time.sleep(0.002)
    check(len(finished_pairs(output)) >= count, f"{output}: no {count} pairs in time")


def make_output(scratch, name):
    output = f"{scratch}/{name}"
    os.makedirs(output)
    give_away(output)
    return output


def check_only_missing(run, output, whole, missing, reason):
    """Pairs of the scans in `missing` are unreadable, the others as ever."""
    now, before = outcome(output)["results.csv"], outcome(whole)["results.csv"]
    check(len(now) == len(before), "not all pairs are there")
    for row, old in zip(now, before):
        index = int(row["pair"].rsplit("/", 1)[-1]) - 1
        if row["status"] == "unreadable":
            check(index in missing, f"{row['pair']} is unreadable")
        else:
            check(row == old, f"{row['pair']} is not as before")
    lost = sorted({row["pair"] for row in now if row["status"] == "unreadable"})
    check(lost, "no scan was missed: it came too late")
    with open(f"{output}/notes.txt", encoding="utf8") as file:
        notes = file.read()
    for pair in lost:
        check(any(line.startswith(f"{pair}: ") and reason in line
                  for line in notes.split("\n")), f"no note of {pair}: {notes}")
    return len(lost)


def run_scans_go_away(run, whole, scratch, how):
    """how: "rights" or "files". Returns the number of pairs missed."""
    output = make_output(scratch, f"without_{how}")
    missing = range(run.num_pairs * 3 // 4, run.num_pairs)
    paths = [f"{run.folder}/scans/{i:03}_source.bin" for i in missing]
    process = run.start(output, wrapper=as_nobody())
    wait_for_pairs(output, run.num_pairs // 10)
    for path in paths:
        if how == "rights":
            os.chmod(path, 0)
        else:
            os.rename(path, path + ".away")
    end = ended(process)
    for path in paths:
        if how == "rights":
            os.chmod(path, 0o644)
        else:
            os.rename(path + ".away", path)
    check(end.code == 0, f"exit code {end.code}: {end.told}")
    reason = "Permission denied" if how == "rights" else "No such file"
    return check_only_missing(run, output, whole, missing, reason)


def run_output_is_closed(run, whole, scratch):
    """Read-only from the start, and from the middle on. Returns what is told."""
    output = make_output(scratch, "closed")
    os.chmod(output, 0o555)
    at_start = ended(run.start(output, wrapper=as_nobody()))
    at_start.check_one_line(2, output, "Permission denied")
    os.chmod(output, 0o755)
    process = run.start(output, wrapper=as_nobody())
    wait_for_pairs(output, run.num_pairs // 10)
    os.chmod(output, 0o555)
    later = ended(process)
    later.check_one_line(2, output, "Permission denied")
    done = len(finished_pairs(output))
    check(done == run.num_pairs, f"{done} pairs, {len(METHODS)} methods each")
    os.chmod(output, 0o755)
    end = ended(run.start(output, wrapper=as_nobody()))
    check(end.code == 0, f"exit code {end.code}: {end.told}")
    check_same(output, whole)
    return at_start.told[0].replace(scratch, "..."), later.told[0].replace(scratch, "...")
