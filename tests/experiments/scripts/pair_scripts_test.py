#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""experiments/scripts/run_pairs.py, compare_methods.py, list_wrong_pairs.py and
calibrate_verdict.py against a stand-in for quatro_register; what compare_kitti.py
makes of its measurements."""
import contextlib
import csv
import io
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True
SCRIPTS = pathlib.Path(__file__).resolve().parents[3] / "experiments" / "scripts"
sys.path.insert(0, str(SCRIPTS))
import compare_kitti  # noqa: E402
import list_wrong_pairs  # noqa: E402
import run_pairs  # noqa: E402

# Registers sources named a*; counts its calls; stops the run at c.bin if there
# is a file "stop" beside it, and waits for a file "go" if there is a file
# "wait". --method=half has an error of 5 m.
STAND_IN = """#!/usr/bin/env python3
import json, os, pathlib, sys, time
if sys.argv[1:] == ["--list_methods"]:
    print("whole  all of it\\nhalf   a part of it")
    sys.exit(0)
flags = dict(arg.lstrip("-").split("=", 1) for arg in sys.argv[1:])
source = pathlib.Path(flags["source"])
with open(source.parent / "calls", "a") as calls:
    calls.write(source.name + "\\n")
if source.name == "c.bin" and (source.parent / "stop").exists():
    print("c.bin: stopped", file=sys.stderr)
    sys.exit(2)
while (source.parent / "wait").exists() and not (source.parent / "go").exists():
    time.sleep(0.01)
registered = source.name.startswith("a")
shift = 5.0 if flags.get("method") in ("half", "coarse") else 0.0
tolerance = 6.0 if flags.get("method") == "coarse" else 2.0
print(json.dumps({"status": "registered" if registered else "ambiguous",
    "probability": 0.95 if registered else 0.1,
    "target_from_source": [[1, 0, 0, shift], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
    "tolerance": {"translation_m": tolerance, "rotation_deg": 10.0},
    "evidence": {"features": {"surprise": 1.0 if registered else 0.0, "margin": 0.5}},
    "timings_ms": {"voxels": 2.0, "matching": 3.0, "clique": 1.0, "total": 6.0}}))
sys.exit(0 if registered else 1)
"""


class PairScriptsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name in ("a.bin", "b.bin", "c.bin", "t.bin"):
            (self.folder / name).touch()
        self.program = self.write("stand_in", STAND_IN)
        os.chmod(self.program, 0o755)
        self.pairs = self.write(
            "pairs.csv", "set,source,target,tx,ty,tz,qx,qy,qz,qw\n"
            "one,a.bin,t.bin,0,0,0,0,0,0,1\none,b.bin,t.bin,0,0,0,0,0,0,1\n"
            "two,c.bin,t.bin,,,,,,,\n")

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
        return str(self.folder / name)

    def run_script(self, name, *args):
        return subprocess.run([sys.executable, str(SCRIPTS / name), *args], capture_output=True,
                              text=True, check=False, stdin=subprocess.DEVNULL)

    def run_pairs(self, *flags):
        return self.run_script("run_pairs.py", f"--program={self.program}",
                               f"--pairs={self.pairs}", f"--output={self.folder}/out.csv",
                               *(["--", *flags] if flags else []))

    def calls(self):
        return (self.folder / "calls").read_text().split()

    def test_pairs_are_measured_and_those_without_a_pose_must_not_be_registered(self):
        run = self.run_pairs()
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(self.folder / "out.csv", newline="", encoding="utf-8") as file:
            a, b, c = csv.DictReader(file)
        self.assertEqual((a["status"], a["success_0.3m_1deg"], a["features"]),
                         ("registered", "1", "surprise=1;margin=0.5"))
        self.assertEqual((b["status"], b["wrong_but_registered"]), ("ambiguous", "0"))
        self.assertEqual((c["success_2m_10deg"], c["wrong_but_registered"]), ("", "0"))
        self.assertGreater(float(a["peak_mb"]), 1.0)
        self.assertEqual(a["stages_ms"], "voxels=2.0;matching=3.0;clique=1.0")

    def test_a_false_registration_is_outside_of_the_tolerance_of_the_verdict(self):
        for method, expected in (("half", ("0", "0", "1")), ("coarse", ("0", "1", "0"))):
            self.assertEqual(self.run_pairs(f"--method={method}").returncode, 0)
            with open(self.folder / "out.csv", newline="", encoding="utf-8") as file:
                row = next(csv.DictReader(file))
            self.assertEqual((row["success_2m_10deg"], row["within_tolerance"],
                              row["wrong_but_registered"]), expected, method)
            (self.folder / "out.csv").unlink()

    def test_without_poses_nothing_is_wrong(self):
        self.pairs = self.write("pairs.csv", "\ufefftarget,source\nt.bin,a.bin\n")
        run = self.run_pairs()
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(self.folder / "out.csv", newline="", encoding="utf-8") as file:
            row, = csv.DictReader(file)
        self.assertEqual((row["status"], row["wrong_but_registered"]), ("registered", ""))
        self.assertRegex(run.stdout, r"total +1 +1 +- +- +- +- ")
        self.pairs = self.write("pairs.csv", "source,target,apart\na.bin,t.bin,far_apart\n")
        (self.folder / "out.csv").unlink()
        self.assertRegex(self.run_pairs().stdout, r"total +1 +1 +- +- +- +1 ")

    def test_a_run_that_was_stopped_goes_on(self):
        self.write("stop", "")
        run = self.run_pairs()
        self.assertEqual(run.returncode, 2)
        self.assertIn("c.bin: stopped", run.stderr)
        self.assertFalse((self.folder / "out.csv").exists())
        (self.folder / "stop").unlink()
        self.assertEqual(self.run_pairs().returncode, 0)
        self.assertEqual(self.calls(), ["a.bin", "b.bin", "c.bin", "c.bin"])
        self.assertFalse((self.folder / "out.csv.part").exists())

    def test_a_line_that_was_cut_short_is_run_again(self):
        self.write("stop", "")
        self.run_pairs()
        part = self.folder / "out.csv.part"
        part.write_text(part.read_text()[:-20])
        (self.folder / "stop").unlink()
        self.assertEqual(self.run_pairs().returncode, 0)
        self.assertEqual(self.calls(), ["a.bin", "b.bin", "c.bin", "b.bin", "c.bin"])

    def test_another_run_is_not_mixed_in(self):
        self.write("stop", "")
        self.run_pairs()
        run = self.run_pairs("--preset=paper")
        self.assertEqual(run.returncode, 2)
        self.assertIn("other flags", run.stderr)

    def expect_refused(self, problem, name, *args, stdout=subprocess.PIPE):
        run = subprocess.run([sys.executable, str(SCRIPTS / name), *args], stdout=stdout,
                             stderr=subprocess.PIPE, text=True, check=False,
                             stdin=subprocess.DEVNULL, cwd=self.folder, timeout=60)
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertIn(problem, run.stderr)

    def test_a_line_that_cannot_be_read_is_run_again_and_the_others_stay(self):
        self.write("stop", "")
        self.run_pairs()
        part = self.folder / "out.csv.part"
        head, a, b = part.read_text().splitlines()
        part.write_text("\n".join((head, "[0, {}]", "\0\xff", b, "")), encoding="latin-1")
        (self.folder / "stop").unlink()
        run = self.run_pairs()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("out.csv.part: line 2 cannot be read", run.stderr)
        self.assertIn("out.csv.part: line 3 cannot be read", run.stderr)
        self.assertEqual(self.calls(), ["a.bin", "b.bin", "c.bin", "a.bin", "c.bin"])

    def test_what_is_done_is_never_cut_off(self):
        self.write("stop", "")
        self.run_pairs()
        part = self.folder / "out.csv.part"
        before = part.read_text()
        with run_pairs.Done(str(part), json.loads(before.splitlines()[0])) as done:
            self.assertEqual(len(done.results), 2)
            self.assertEqual(part.read_text(), before)
        self.assertEqual(part.read_text(), before)

    def test_a_full_disk_is_one_line(self):
        done = run_pairs.Done("", [])
        done.path, done.head = "full.part", b"[]\n"
        with open("/dev/full", "wb", buffering=0) as done.file:
            with self.assertRaisesRegex(run_pairs.BadInput, "full.part: No space left"):
                done.add(0, {})
        self.assertEqual(done.results, {})
        with open("/dev/full", "w", encoding="utf-8") as full:
            self.expect_refused("standard output: No space left", "list_wrong_pairs.py",
                                f"--pairs={self.pairs}", "--output=wrong.csv", stdout=full)

    def test_a_full_standard_output_is_told_after_the_pairs(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            run = subprocess.run([sys.executable, str(SCRIPTS / "run_pairs.py"),
                                  f"--program={self.program}", f"--pairs={self.pairs}"],
                                 stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertEqual(run.stderr.splitlines()[1:],
                         ["run_pairs.py: standard output: No space left on device"])

    def test_two_runs_do_not_share_an_output(self):
        self.write("wait", "")
        args = [f"--program={self.program}", f"--pairs={self.pairs}", "--output=out.csv"]
        with subprocess.Popen([sys.executable, str(SCRIPTS / "run_pairs.py"), *args],
                              cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True) as first:
            try:
                end = time.monotonic() + 60.0
                while not (self.folder / "calls").exists() and time.monotonic() < end:
                    time.sleep(0.01)
                self.expect_refused("out.csv.part: another process is using this file", "run_pairs.py",
                                    *args)
            finally:
                self.write("go", "")
            _, errors = first.communicate()
        self.assertEqual(first.returncode, 0, errors)
        self.assertEqual(self.calls(), ["a.bin", "b.bin", "c.bin"])

    def test_a_run_that_did_nothing_leaves_nothing(self):
        self.write("program", "#!/bin/sh\necho 'unknown flag' >&2\nexit 2\n")
        os.chmod(self.folder / "program", 0o755)
        self.expect_refused("unknown flag", "run_pairs.py", f"--program={self.folder}/program",
                            f"--pairs={self.pairs}", "--output=out.csv")
        self.assertFalse((self.folder / "out.csv.part").exists())
        # A killed process does not block the run either.
        self.write("out.csv.part", '["/another run"]\n')
        self.assertEqual(self.run_pairs().returncode, 0)
        # Unrelated files are left alone.
        self.write("out.csv.part", "mine")
        self.assertEqual(self.run_pairs().returncode, 2)
        self.assertEqual((self.folder / "out.csv.part").read_text(), "mine")

    def test_nothing_that_is_read_is_overwritten(self):
        self.write("whole.csv", pathlib.Path(self.pairs).read_text())
        self.write("places.csv", "set,source,target\none,a.bin,b.bin\ntwo,c.bin,t.bin\n")
        os.symlink("pairs.csv", self.folder / "link.csv")
        before = {path: path.read_bytes() for path in self.folder.iterdir()}
        program = f"--program={self.program}"
        for name, *args in (
                ("run_pairs.py", program, "--pairs=pairs.csv", "--output=./pairs.csv"),
                ("run_pairs.py", program, "--pairs=link.csv", "--output=pairs.csv"),
                ("run_pairs.py", program, "--pairs=pairs.csv", "--output=link.csv"),
                ("run_pairs.py", program, "--pairs=pairs.csv", "--output=a.bin"),
                ("run_pairs.py", program, "--pairs=pairs.csv", "--output=stand_in"),
                ("compare_methods.py", program, "--pairs=whole.csv", "--methods=whole",
                 "--output=."),
                ("list_wrong_pairs.py", "--pairs=places.csv", "--output=places.csv"),
                ("list_wrong_pairs.py", "--pairs=places.csv", "--output=t.bin")):
            self.expect_refused("would be overwritten", name, *args)
        self.assertEqual({path: path.read_bytes() for path in self.folder.iterdir()}, before)

    def test_only_methods_that_there_are_name_files(self):
        for methods in ("../x", "whole,", "other"):
            self.expect_refused("is not one of whole,half", "compare_methods.py",
                                f"--program={self.program}", f"--pairs={self.pairs}",
                                f"--methods={methods}", "--output=out")
        self.expect_refused("did not list its methods", "compare_methods.py",
                            "--program=/bin/false", f"--pairs={self.pairs}", "--methods=whole")
        self.assertFalse((self.folder / "calls").exists())
        self.assertFalse((self.folder / "out").exists())

    def test_only_whole_results_are_gone_on_with(self):
        args = (f"--program={self.program}", f"--pairs={self.pairs}", "--methods=whole",
                "--output=out")
        path = self.folder / "out" / "whole.csv"
        run = subprocess.run([sys.executable, str(SCRIPTS / "compare_methods.py"), *args],
                             capture_output=True, text=True, check=False, cwd=self.folder)
        self.assertEqual(run.returncode, 0, run.stderr)
        good = path.read_text()
        lines = good.splitlines(keepends=True)
        for text, problem in (("", "there is no column set"),
                              ("set,source\none,a.bin\n", "there is no column target"),
                              ("".join(lines[:-1]), "does not contain the results of the pairs"),
                              ("".join(lines[:2] + lines[1:3]), "does not contain the results"),
                              (good.replace("0.0000", "x"), "does not contain the results"),
                              (good.replace("registered,", "\0,"), "whole.csv: ")):
            path.write_text(text)
            self.expect_refused(problem, "compare_methods.py", *args)
            self.assertEqual(path.read_text(), text)

    def test_methods_are_compared_in_one_table(self):
        args = ("compare_methods.py", f"--program={self.program}", f"--pairs={self.pairs}",
                "--methods=whole,half", f"--output={self.folder}/out")
        run = self.run_script(*args)
        self.assertEqual(run.returncode, 0, run.stderr)
        rows = [[cell.strip() for cell in line.strip("|\n").split("|")]
                for line in run.stdout.splitlines()]
        self.assertEqual(rows[2][:8], ["whole", "1", "2", "2", "2", "0", "0.000 / 0.000",
                                       "0.00 / 0.00"])
        self.assertEqual(rows[2][8:10], ["5.0", "1.0"])
        self.assertEqual(rows[3][:7], ["half", "1", "0", "0", "0", "1", "- / -"])
        # A second run resumes, unless the flags differ.
        num_calls = len(self.calls())
        self.assertEqual(self.run_script(*args).stdout, run.stdout)
        self.assertEqual(len(self.calls()), num_calls)
        other = self.run_script(*args, "--", "--preset=paper")
        self.assertEqual(other.returncode, 2)
        self.assertIn("other flags", other.stderr)

    def compare_outside(self, *texts, flags=()):
        outside = [f"--outside=other{i}={self.write(f'other{i}.csv', text)}"
                   for i, text in enumerate(texts)]
        return self.run_script("compare_methods.py", f"--program={self.program}",
                               f"--pairs={self.pairs}", *outside, *flags)

    def test_results_of_other_programs_enter_the_table(self):
        # a has an error of 3 cm and 12 numbers, b is rotated by 90 deg with 16
        # numbers; c has no overlap with t.
        turned = "0,-1,0,0,1,0,0,0,0,0,1,0,0,0,0,1"
        a = "a.bin,t.bin,1,0,0,0.03,0,1,0,0,0,0,1,0\n"
        run = self.compare_outside(
            "source,target,m00\n# here\n" + a + f"\nb.bin,t.bin,{turned}\nc.bin,t.bin,{turned}\n",
            "a.bin, t.bin, 1,0,0,0, 0,1,0,0, 0,0,1,0\n", flags=["--methods=whole"])
        self.assertEqual(run.returncode, 0, run.stderr)
        rows = [[cell.strip() for cell in line.strip("|\n").split("|")]
                for line in run.stdout.splitlines()]
        self.assertEqual([row[0] for row in rows[2:]], ["whole", "other0", "other1"])
        self.assertEqual(rows[3][1:], ["3", "1", "1", "1", "2", "0.030 / 0.030", "0.00 / 0.00",
                                       "-", "-", "-"])
        # A missing pair has no answer and is neither correct nor incorrect.
        self.assertEqual(rows[4][1:6], ["1", "1", "1", "1", "0"])
        # A file with all pairs also works for some of them.
        part = self.compare_outside(a + f"c.bin,t.bin,{turned}\n", flags=["--exclude=two"])
        self.assertEqual(part.returncode, 0, part.stderr)
        self.assertIn("| other0 | 1 | 1 | 1 | 1 | 0 |", part.stdout)

    def test_bad_results_of_other_programs_are_one_line(self):
        good = "a.bin,t.bin,1,0,0,0,0,1,0,0,0,0,1,0"
        for text, problem in (
                ("", "there are no pairs"),
                (f"{good}\n\n{good}\n", "line 3: the pair a.bin,t.bin is listed twice"),
                ("t.bin,a.bin" + good[11:], "line 1: pair t.bin,a.bin is not in the list"),
                ("0" + good[11:], "line 1: pair 0,1 is not in the list"),
                (good + ",0", "line 1 has 13 numbers after source and target, must have 12 or 16"),
                ("a.bin,t.bin", "line 1 has 0 numbers"),
                (good[:-1] + "nan", "line 1 number 12: 'nan' is not finite"),
                (good[:-1] + "x", "line 1 number 12: 'x' is not a number"),
                (good[:-3] + "1.01,0", "is not a rotation"),
                (good[:-3] + "-1,0", "is not a rotation"),
                ("a.bin,t.bin,1,0.002,0,0,0,1,0,0,0,0,1,0", "is not a rotation"),
                (good + ",0,0,0,2", "does not end with the row 0 0 0 1")):
            run = self.compare_outside(good + "\n", text)
            self.assertEqual((run.returncode, run.stdout), (2, ""), text)
            self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
            self.assertIn("other1.csv: ", run.stderr)
            self.assertIn(problem, run.stderr)
        # Six digits suffice for a rotation.
        rounded = "a.bin,t.bin,0.707107,-0.707107,0,0,0.707107,0.707107,0,0,0,0,1,0"
        self.assertEqual(self.compare_outside(rounded).returncode, 0)
        for flag, problem in (("x.csv", "must be NAME=FILE.csv"), ("n=no.csv", "no.csv: No such")):
            run = self.compare_outside(flags=[f"--outside={flag}"])
            self.assertEqual((run.returncode, run.stderr.count("\n")), (2, 1), run.stderr)
            self.assertIn(problem, run.stderr)
        self.assertIn("neither --methods nor --outside", self.compare_outside().stderr)

    def test_wrong_pairs_are_of_different_places(self):
        pair = run_pairs.Pair
        pairs = [pair("s", "a", "b", None), pair("s", "c", "b", None), pair("s", "d", "e", None),
                 pair("t", "f", "g", None), pair("u", "h", "i", None)]
        places = list_wrong_pairs.find_places(pairs, [["t", "u"]])
        self.assertEqual(sorted(map(sorted, places)),
                         [["a", "b", "c"], ["d", "e"], ["f", "g", "h", "i"]])

    def test_wrong_pairs_are_listed_for_run_pairs(self):
        pairs = self.write("places.csv", "set,source,target\none,a.bin,b.bin\ntwo,c.bin,t.bin\n")
        run = self.run_script("list_wrong_pairs.py", f"--pairs={pairs}", "--each=3",
                              f"--output={self.folder}/wrong.csv")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("2 places, 3 pairs", run.stdout)
        listed = run_pairs.read_pairs(str(self.folder / "wrong.csv"), [])
        self.assertEqual(len({(p.source, p.target) for p in listed}), 3)
        for p in listed:
            self.assertIn(pathlib.Path(p.source).name, ("a.bin", "b.bin"))
            self.assertIn(pathlib.Path(p.target).name, ("c.bin", "t.bin"))
            self.assertIsNone(p.pose)

    def test_bad_lists_are_one_line(self):
        for text, problem in (("", "there is no column source"),
                              ("source\n", "there is no column target"),
                              ("source,target\nx.bin,t.bin\n", "there is no file 'x.bin'"),
                              ("source,target\n", "there are no pairs")):
            pairs = self.write("bad.csv", text)
            run = self.run_script("list_wrong_pairs.py", f"--pairs={pairs}",
                                  f"--output={self.folder}/wrong.csv")
            self.assertEqual(run.returncode, 2)
            self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
            self.assertIn(problem, run.stderr)
            for name in ("run_pairs.py", "compare_methods.py"):
                flags = ["--methods=whole"] if name == "compare_methods.py" else []
                self.expect_refused(problem, name, f"--program={self.program}",
                                    f"--pairs={pairs}", *flags)

    def test_sets_of_one_place_are_those_that_there_are(self):
        args = ("list_wrong_pairs.py", f"--pairs={self.pairs}", f"--output={self.folder}/wrong.csv")
        self.expect_refused("--same=three: ", *args, "--same=one,three")
        self.assertFalse((self.folder / "wrong.csv").exists())
        self.assertEqual(self.run_script(*args, "--same=one,two", "--exclude=two").returncode, 0)


class CalibrationTest(unittest.TestCase):
    def setUp(self):
        try:
            import calibrate_verdict
        except ImportError:
            self.skipTest("this Python has no numpy")
        self.calibration = calibrate_verdict

    def test_weights_are_those_that_made_the_data_and_never_negative(self):
        import numpy as np
        random = np.random.default_rng(1)
        x = random.uniform(0.0, 1.0, (20000, 3))
        # The third feature has the opposite sign, so its weight is fixed at 0.
        truth = np.array([-3.0, 4.0, 2.0, -0.5])
        p = 1.0 / (1.0 + np.exp(-(truth[0] + x @ truth[1:])))
        y = (random.uniform(size=len(p)) < p).astype(float)
        w = self.calibration.fit(x, y, ridge=1e-7)
        self.assertEqual(w[3], 0.0)
        self.assertAlmostEqual(w[1], 4.0, delta=0.25)
        self.assertAlmostEqual(w[2], 2.0, delta=0.25)
        # At the minimum the fitted rates equal the observed ones.
        fitted = self.calibration.probability(w, x)
        self.assertAlmostEqual(fitted.mean(), y.mean(), places=6)

    def write_results(self, folder, name, num_pairs):
        """Own poses with two features of clouds, and every other pose a searched one with a third."""
        lines = [",".join(self.calibration.COLUMNS)]
        for i in range(num_pairs):
            is_right = i // 2 % 2
            features = f"surprise={is_right};margin={(i // 4) % 2};overlap={is_right}"
            if i % 2:
                features += f";guided={is_right}"
            lines.append(f"street,{name}{i},t{i},registered,{is_right},0.5,{features}")
        path = pathlib.Path(folder) / name
        path.write_text("\n".join(lines) + "\n")
        return str(path)

    def report(self, folder, fitted, *flags):
        text = io.StringIO()
        with contextlib.redirect_stdout(text):
            self.calibration.main([self.write_results(folder, "fitted", fitted), *flags])
        return text.getvalue()

    def test_searched_poses_have_a_model_of_their_own(self):
        with tempfile.TemporaryDirectory() as folder:
            text = self.report(folder, 200)
        own, searched = text.split("matches and clouds: ")[1].split("searched poses: ")
        self.assertNotIn("guided", own)
        self.assertIn("guided", searched.splitlines()[0])

    def test_reported_pairs_are_not_fitted(self):
        with tempfile.TemporaryDirectory() as folder:
            other = self.write_results(folder, "other", 40)
            text = self.report(folder, 200, f"--report={other}")
        self.assertIn("fitted on 200, reported on 40", text)  # Matches alone.
        self.assertEqual(text.count("fitted on 100, reported on 20"), 2)

    def test_intervals_of_rates_are_wilsons(self):
        low, high = self.calibration.wilson(1, 372)
        self.assertAlmostEqual(low, 0.00047, places=4)
        self.assertAlmostEqual(high, 0.0151, places=4)


class CompareKittiTest(unittest.TestCase):
    def test_bins_are_half_open(self):
        self.assertEqual([compare_kitti.bin_of(d) for d in (0.0, 2.49, 2.5, 39.9, 40.0)],
                         [0, 0, 1, 5, None])

    def test_ratios_are_of_medians_where_both_have_pairs(self):
        real = compare_kitti.pool([{0: [(100, 10, 0.5)], 2: [(1, 1, 1)]},
                                   {0: [(300, 30, 0.1), (200, 20, 0.3)], 3: [(9, 9, 0.0)]}])
        simulated = {0: [(150, 30, 0.6), (170, 34, 0.6)], 1: [(5, 5, 5)], 2: [],
                     3: [(9, 18, 0.1)]}
        found = compare_kitti.ratios(real, simulated)
        self.assertEqual(list(found), [0, 3])
        for ratio, expected in zip(found[0], (160 / 200, 32 / 20, 0.6 / 0.3)):
            self.assertAlmostEqual(ratio, expected)
        self.assertEqual(found[3][:2], (1.0, 2.0))
        self.assertTrue(math.isnan(found[3][2]))
        text = compare_kitti.format_ratios(real, [("05", simulated)])
        self.assertIn("05 / real", text)
        self.assertIn("0-2.5           0.80     1.60        2.00", text)
        self.assertIn("within a factor of 1.5: 2 of 6", text)

    def test_close_is_the_same_both_ways(self):
        for ratio, expected in ((1.0, True), (1.5, True), (1.51, False), (0.67, True),
                                (0.66, False), (math.nan, False)):
            self.assertEqual(compare_kitti.is_close(ratio), expected, ratio)

    def test_poses_of_a_sequence_are_the_sensors(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            # z of cam0 is ahead, x to the right: 3 m along z is 3 m ahead.
            (folder / "calib.txt").write_text("Tr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n")
            (folder / "poses.txt").write_text("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 3\n")
            pair, = compare_kitti.pairs_of_sequence(folder, 8, 1)
        self.assertEqual(pathlib.Path(pair.source).name, "000001.bin")
        rotation, translation = pair.pose
        self.assertEqual(rotation, [[1, 0, 0], [0, 1, 0], [0, 0, 1]])
        self.assertEqual(translation, [3, 0, 0])

    def test_pairs_are_like_their_models_where_there_are_such(self):
        # Six frames 1 m apart, the last one rotated by 90 deg.
        headings = [0.0] * 5 + [math.pi / 2.0]
        candidates = [(i, j, float(j - i)) for i in range(6) for j in range(i + 1, 6)]
        drawn = compare_kitti.draw_like(candidates, [(1.2, 0.1), (3.9, 1.5)], headings, 4,
                                        random.Random(1))
        self.assertEqual(len(set(drawn)), 4)
        for pair in (drawn[0], drawn[2]):
            self.assertEqual(pair[2], 1.0)
            self.assertLess(pair[1], 5)
        self.assertEqual(drawn[1], (1, 5, 4.0))  # The only one; then there is none.


if __name__ == "__main__":
    unittest.main()
