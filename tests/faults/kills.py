# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""kill -9 at random moments of a run, which is gone on with each time."""

import random
import time

from small_run import check, check_same, ended, finished_pairs


def run_kills(run, whole, scratch, num_kills, seed, whole_seconds):
    """As many kills, spread over one run or, where it gets to its end before,
    over several. Returns the number of runs and the pairs at each kill."""
    rng = random.Random(seed)
    per_pair = whole_seconds / run.num_pairs
    done_at_kill = []
    num_runs = 0
    while len(done_at_kill) < num_kills:
        output = f"{scratch}/killed_{num_runs}"
        num_runs += 1
        before = set()
        while len(done_at_kill) < num_kills:
            process = run.start(output)
            # So that the kills that are left spread over the pairs that are.
            share = (run.num_pairs - len(before)) / (num_kills - len(done_at_kill) + 1)
            time.sleep(rng.uniform(0.0, 2.0 * per_pair * share + 0.05))
            process.kill()
            end = ended(process)
            if end.code == 0:
                break
            check(end.code == -9, f"exit code {end.code}: {end.told}")
            now = set(finished_pairs(output))
            check(before <= now, f"lost {sorted(before - now)}")
            before = now
            done_at_kill.append(len(now))
        run.finish(output)
        check_same(output, whole)
    return num_runs, done_at_kill
