#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""experiments/scripts/tabulate_benchmark.py on small runs made by hand."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
SCRIPT = ROOT / "experiments" / "scripts" / "tabulate_benchmark.py"


def entry(name, time, unit="ms", **others):
    return {"name": name + "/real_time", "run_name": name + "/real_time", "run_type": "iteration",
            "iterations": 3, "real_time": time, "cpu_time": 1.0, "time_unit": unit, **others}


class TabulateBenchmarkTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, entries, context=None):
        path = self.folder / "run.json"
        path.write_text(json.dumps({"context": context or {}, "benchmarks": entries}),
                        encoding="utf-8")
        return str(path)

    def run_script(self, *args, wrapped=()):
        return subprocess.run([*(wrapped or [sys.executable]), str(SCRIPT), *args],
                              capture_output=True, text=True, check=False,
                              stdin=subprocess.DEVNULL)

    def table(self, entries):
        """(stage, case) -> {column: cell}."""
        run = self.run_script(self.write(entries))
        self.assertEqual(run.returncode, 0, run.stderr)
        lines = [[x.strip() for x in line[1:-1].split("|")]
                 for line in run.stdout.splitlines() if line.startswith("|")]
        self.assertEqual(len({len(line) for line in lines}), 1)
        return {(line[0], line[1]): dict(zip(lines[0], line)) for line in lines[2:]}

    def expect_refused(self, what, *args):
        run = self.run_script(*args)
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertEqual(run.stdout, "")
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertIn(what, run.stderr)

    def test_ratios_are_of_the_same_stage_and_case(self):
        table = self.table([
            entry("graph/quatro/N:1000", 3.0, peak_bytes=250000.0, bitset_bytes=125000.0),
            entry("graph/limit/N:1000", 2000.0, "us"),
            entry("graph/quatro/N:9000", 300.0),
            entry("fpfh/pcl", 80.0), entry("fpfh/quatro", 20.0, voxels=7.0)])
        self.assertEqual(list(table), [("graph", "N:1000"), ("graph", "N:9000"), ("fpfh", "")])
        small = table["graph", "N:1000"]
        self.assertEqual((small["quatro [ms]"], small["limit [ms]"], small["of the limit"]),
                         ("3", "2", "1.5"))
        self.assertEqual(small["memory [MiB]"], "0.238 (2)")
        self.assertEqual(table["graph", "N:9000"]["of the limit"], "")
        fpfh = table["fpfh", ""]
        self.assertEqual((fpfh["quatro [ms]"], fpfh["pcl [ms]"], fpfh["counted"]),
                         ("20", "80 (4)", "voxels 7"))
        self.assertNotIn("of one thread", fpfh)

    def test_threads_are_compared_with_one(self):
        table = self.table([entry("arc/quatro/N:10/threads:1", 8.0),
                            entry("arc/quatro/N:10/threads:2", 5.0),
                            entry("arc/quatro/N:20/threads:2", 5.0)])
        self.assertEqual([row["of one thread"] for row in table.values()], ["", "0.625", ""])

    def test_repetitions_give_their_median(self):
        runs = [entry("a/quatro", time) for time in (9.0, 1.0, 2.0)]
        mean = entry("a/quatro", 4.0) | {"run_type": "aggregate", "aggregate_name": "mean"}
        median = entry("a/quatro", 5.5) | {"run_type": "aggregate", "aggregate_name": "median"}
        self.assertEqual(self.table([*runs, mean])["a", ""]["quatro [ms]"], "2")
        self.assertEqual(self.table([mean, median])["a", ""]["quatro [ms]"], "5.5")

    def test_times_may_be_those_of_the_processor(self):
        path = self.write([entry("a/quatro/process_time", 5.0) | {"cpu_time": 2.0},
                           entry("a/limit/process_time", 5.0) | {"cpu_time": 4.0}])
        run = self.run_script(path, "--clock=cpu")
        self.assertIn("| a     |      | 2           | 4          | 0.5          |", run.stdout)

    def test_what_was_not_run_says_why(self):
        failed = {"name": "gicp/quatro", "run_name": "gicp/quatro", "run_type": "iteration",
                  "error_occurred": True, "error_message": "the pair has no pose",
                  "real_time": 0.0, "time_unit": "ms"}
        row = self.table([failed, entry("gicp/limit", 1.0)])["gicp", ""]
        self.assertEqual(row["quatro [ms]"], "- (the pair has no pose)")
        self.assertEqual(row["limit [ms]"], "1")
        self.assertNotIn("of the limit", row)

    def test_context_is_told(self):
        run = self.run_script(self.write([entry("a/quatro", 1.0)],
                                         {"simd": "AVX2", "pair": "simulated", "load_avg": [3.5],
                                          "num_cpus": 2, "host_name": "secret"}))
        self.assertTrue(run.stdout.endswith(
            "\nsimd AVX2; pair simulated; load at the start 3.5 of 2 cores\n"), run.stdout)

    def test_growth_is_drawn(self):
        path = self.write([entry(f"{stage}/quatro/N:{n}", n * 0.1)
                           for stage in ("graph", "arc") for n in (10, 100)])
        picture = self.folder / "growth.png"
        run = self.run_script(path, f"--picture={picture}",
                              wrapped=[str(ROOT / "experiments" / "scripts" / "with_python.sh"), "matplotlib"])
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(picture.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_bad_input_is_refused(self):
        self.expect_refused("No such file", str(self.folder / "none.json"))
        (self.folder / "text").write_text("graph 3 ms", encoding="utf-8")
        self.expect_refused("is not JSON", str(self.folder / "text"))
        self.expect_refused("has no benchmarks", self.write([]))
        self.expect_refused("'graph/real_time' is not stage/who/case", self.write([entry("graph", 1.0)]))
        self.expect_refused("real_time = 0.0 ms", self.write([entry("a/quatro", 0.0)]))
        self.expect_refused("real_time = 1.0 h", self.write([entry("a/quatro", 1.0, "h")]))
        self.expect_refused("two sizes", self.write([entry("a/quatro/N:5", 1.0)]), "--picture=a.png")
        path = self.write([entry(f"a/quatro/N:{n}", 1.0) for n in (10, 100)])
        self.expect_refused("would be overwritten", path, f"--picture={path}")
        self.assertIn("quatro", pathlib.Path(path).read_text(encoding="utf-8"))
        self.expect_refused("there is no folder", path, "--picture=none/a.png")
        self.expect_refused("--clock", self.write([entry("a/quatro", 1.0)]), "--clock=sun")
        self.expect_refused("unrecognized", self.write([entry("a/quatro", 1.0)]), "--frame=3")


if __name__ == "__main__":
    unittest.main()
