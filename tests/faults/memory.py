# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""A program under ever larger limits of its address space (ulimit -v)."""

import os
import resource
import subprocess

from small_run import check

MIB = 1 << 20


def run_limited(command, num_bytes):
    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (num_bytes, num_bytes))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    return subprocess.run(command, preexec_fn=limit, capture_output=True, check=False)


def least_that_starts(program):
    """[MiB], in steps of one: less than that the loader itself gives up."""
    low, high = 1, 4096
    while high - low > 1:
        middle = (low + high) // 2
        if run_limited([program, "--version"], middle * MIB).returncode == 0:
            high = middle
        else:
            low = middle
    return high


def run_limits(command, output, remove, is_right, good_codes, step):
    """From the least limit on, each `step` times the last, until three in a row
    are enough. Each run either ends as without a limit or says in one line
    that there is not enough memory, and leaves nothing then. Returns the least
    limit, the first that is enough [MiB], and the runs that were too small."""
    limit = least = least_that_starts(command[0])
    enough, too_small, first = 0, 0, None
    while enough < 3:
        check(limit < 65536, f"{command[0]}: 64 GiB are not enough")
        remove()
        run = run_limited(command, int(limit * MIB))
        where = f"{os.path.basename(command[0])} within {limit:.0f} MiB"
        stderr = run.stderr.decode(errors="replace").strip().split("\n")
        if run.returncode in good_codes:
            check(is_right(), f"{where}: another answer")
            enough += 1
            first = first or limit
        else:
            enough, first = 0, None
            too_small += 1
            check(run.returncode in (2, 3), f"{where}: exit code {run.returncode}: {stderr[-3:]}")
            check("memory" in stderr[-1], f"{where}: {stderr[-3:]}")
            check(not os.path.isfile(output), f"{where}: left {output}")
        limit = max(limit * step, limit + 1)
    return least, first, too_small
