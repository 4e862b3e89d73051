#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""experiments/scripts/ins_table.py against a stand-in for quatro_register, which turns by
what its flags say."""
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
SCRIPT = pathlib.Path(__file__).resolve().parents[3] / "experiments" / "scripts" / "ins_table.py"
sys.path.insert(0, str(SCRIPT.parent))
import ins_table  # noqa: E402

# Answers with the tilt of the source's attitude; the identity without an INS,
# with a yaw of 2 deg for the polish, and of --ins_std_deg for fused. None for
# b.bin.
STAND_IN = """#!/usr/bin/env python3
import json, sys
sys.path.insert(0, {folder!r})
import ins_table as t
flags = dict(arg.lstrip("-").split("=", 1) for arg in sys.argv[1:])
rpy = [0.0, 0.0, 0.0]
if flags["ins_mode"] != "none":
    assert flags["target_rpy_deg"]
    rpy = [float(x) for x in flags["source_rpy_deg"].split(",")]
    rpy[2] = 0.0
else:
    assert "source_rpy_deg" not in flags
if flags["polish"] == "on":
    rpy[2] = 2.0
if flags["ins_mode"] == "fused":
    rpy[2] += float(flags.get("ins_std_deg", 0.0))
matrix = [row + [0.0] for row in t.rotation_from_rpy(rpy)] + [[0.0, 0.0, 0.0, 1.0]]
answer = None if flags["source"].endswith("b.bin") else matrix
print(json.dumps({{"status": "registered", "target_from_source": answer}}))
sys.exit(0 if answer else 1)
"""


class InsTableTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name in ("a.bin", "b.bin", "c.bin", "t.bin"):
            (self.folder / name).touch()
        self.program = self.write("stand_in", STAND_IN.format(folder=str(SCRIPT.parent)))
        os.chmod(self.program, 0o755)
        # Rolled by 10 deg: the true tilt.
        half = math.radians(5.0)
        self.quaternion = f"{math.sin(half)!r},0,0,{math.cos(half)!r}"
        self.pairs = self.write("pairs.csv", "source,target,tx,ty,tz,qx,qy,qz,qw\n" + "".join(
            f"{name}.bin,t.bin,0,0,0,{self.quaternion}\n" for name in "abc"))

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
        return str(self.folder / name)

    def run_table(self, *args):
        return subprocess.run([sys.executable, str(SCRIPT), f"--program={self.program}", *args],
                              capture_output=True, text=True, check=False,
                              stdin=subprocess.DEVNULL)

    def table(self, *args):
        """Name of the row -> cells."""
        run = self.run_table(*args)
        self.assertEqual(run.returncode, 0, run.stderr)
        lines = [[x.strip() for x in line.strip("|\n").split("|")]
                 for line in run.stdout.splitlines()]
        self.assertEqual(lines[0], list(ins_table.HEADER))
        return {line[0]: line[1:] for line in lines[2:]}

    def expect_refused(self, what, why, *args):
        run = self.run_table(*args)
        self.assertEqual(run.returncode, 2, run.stdout)
        self.assertEqual(run.stdout, "")
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertIn(what, run.stderr)
        self.assertIn(why, run.stderr)

    def test_relative_rotation_is_the_sources_attitude(self):
        half = math.radians(5.5)  # An error of 1 deg.
        ins = self.write("ins.csv", "source,target,qx,qy,qz,qw\n"
                         f"a.bin,t.bin,{math.sin(half)!r},0,0,{math.cos(half)!r}\n"
                         f"b.bin,t.bin,{self.quaternion}\n")
        table = self.table(f"--pairs={self.pairs}", f"--ins={ins}")
        # c.bin is not in the file.
        self.assertEqual(list(table), ["a.bin → t.bin", "b.bin → t.bin", "**median**", "**mean**",
                                       "**largest**"])
        self.assertEqual(table["a.bin → t.bin"],
                         ["1.00", "1.00", "10.00", "10.20", "1.00", "2.24", "1.00", "2.24",
                          "1.00", "2.24"])
        self.assertEqual(table["b.bin → t.bin"], ["0.00", "0.00"] + ["-"] * 8)
        self.assertEqual(table["**mean**"][:3], ["0.50", "0.50", "10.00"])
        self.assertEqual(table["**largest**"][:3], ["1.00", "1.00", "10.00"])

    def test_attitudes_may_be_in_the_list_of_pairs(self):
        # Both in a world rotated by 30 deg: the relative rotation is correct.
        text = "source,target,tx,ty,tz,qx,qy,qz,qw,source_rpy_deg,target_rpy_deg,ins_std_deg\n"
        pairs = self.write("own.csv", text +
                           f'a.bin,t.bin,0,0,0,{self.quaternion},"10,0,30","0,0,30",3\n')
        row = self.table(f"--pairs={pairs}")["a.bin → t.bin"]
        self.assertEqual(row, ["0.00", "0.00", "10.00", "10.20", "0.00", "2.00", "0.00", "2.00",
                               "3.00", "5.00"])

    def test_truth_is_not_taken_for_an_ins(self):
        self.expect_refused("pairs.csv", "source_rpy_deg,target_rpy_deg; name a file that has them "
                            "by --ins", f"--pairs={self.pairs}")

    def test_numbers_go_to_a_file(self):
        ins = self.write("ins.csv", f"source,target,qx,qy,qz,qw\nb.bin,t.bin,{self.quaternion}\n")
        output = self.folder / "out.csv"
        self.table(f"--pairs={self.pairs}", f"--ins={ins}", f"--output={output}")
        header, row = output.read_text(encoding="utf-8").splitlines()
        self.assertEqual(header.split(",")[:4],
                         ["source", "target", "ins_error_deg", "ins_tilt_error_deg"])
        self.assertEqual(row, "b.bin,t.bin,0.0000,0.0000" + "," * 8)

    def test_what_is_wrong_is_told(self):
        pairs = f"--pairs={self.pairs}"
        head = "source,target,source_rpy_deg,target_rpy_deg\n"
        ins = self.write("ins.csv", head + 'a.bin,t.bin,"1,2","0,0,0"\n')
        self.expect_refused("line 2, column source_rpy_deg", "must be three numbers", pairs,
                            f"--ins={ins}")
        ins = self.write("ins.csv", head + 'a.bin,t.bin,"1,2,x","0,0,0"\n')
        self.expect_refused("line 2, column source_rpy_deg", "'x' is not a number", pairs,
                            f"--ins={ins}")
        ins = self.write("ins.csv", "source,target,qx,qy,qz,qw\na.bin,t.bin,1,1,0,0\n")
        self.expect_refused("ins.csv: line 2", "the quaternion has length 1.41421", pairs,
                            f"--ins={ins}")
        ins = self.write("ins.csv", "source,target,qx,qy,qz,qw\nx.bin,t.bin,0,0,0,1\n")
        self.expect_refused("ins.csv", "contains none of the pairs", pairs, f"--ins={ins}")
        ins = self.write("ins.csv", "source,target\n")
        self.expect_refused("ins.csv", "has no columns", pairs, f"--ins={ins}")
        self.expect_refused("none.csv", "No such file", pairs, "--ins=none.csv")
        for flag in ("--polish=on", "--ins_mode=fused", "--gravity=1,0,0"):
            self.expect_refused(flag, "cannot be used here", pairs, f"--ins={ins}", "--", flag)
        ins = self.write("ins.csv", "source,target,qx,qy,qz,qw,ins_std_deg\n"
                         f"a.bin,t.bin,{self.quaternion},1\n")
        self.expect_refused("--ins_std_deg=2", "has a column for it", pairs, f"--ins={ins}", "--",
                            "--ins_std_deg=2")
        no_pose = self.write("no_pose.csv", "source,target\na.bin,t.bin\n")
        self.expect_refused("no_pose.csv", "has no pose", f"--pairs={no_pose}", f"--ins={ins}")

    def test_nothing_that_is_read_is_overwritten(self):
        ins = self.write("ins.csv", f"source,target,qx,qy,qz,qw\nb.bin,t.bin,{self.quaternion}\n")
        before = {path: path.read_bytes() for path in self.folder.iterdir()}
        for name in ("pairs.csv", "ins.csv", "b.bin"):
            self.expect_refused(name, "would be overwritten", f"--pairs={self.pairs}",
                                f"--ins={ins}", f"--output={self.folder}/{name}")
        self.assertEqual({path: path.read_bytes() for path in self.folder.iterdir()}, before)

    def test_empty_files_are_told(self):
        empty = self.write("empty.csv", "")
        self.expect_refused("empty.csv", "there is no column source", f"--pairs={empty}")
        self.expect_refused("empty.csv", "there is no column source", f"--pairs={self.pairs}",
                            f"--ins={empty}")

    def test_attitudes_and_rotations_are_inverse(self):
        for rpy in ((1.0, -2.0, 170.0), (0.0, 0.0, 0.0), (-20.0, 80.0, -3.0)):
            back = ins_table.rpy_from_rotation(ins_table.rotation_from_rpy(rpy))
            for expected, actual in zip(rpy, back):
                self.assertAlmostEqual(expected, actual, places=9)
        # R_z(90 deg) R_x(90 deg): y -> z, x -> y.
        rotation = ins_table.rotation_from_rpy((90.0, 0.0, 90.0))
        for row, expected in zip(rotation, ([0, 0, 1], [1, 0, 0], [0, 1, 0])):
            for a, b in zip(row, expected):
                self.assertAlmostEqual(a, b, places=12)

    def test_tilt_is_what_a_yaw_does_not_change(self):
        truth = ins_table.rotation_from_rpy((5.0, -3.0, 40.0))
        turned = ins_table.multiply(ins_table.rotation_from_rpy((0.0, 0.0, 7.0)), truth)
        self.assertAlmostEqual(ins_table.tilt_between_deg(truth, turned), 0.0, places=9)
        tilted = ins_table.multiply(ins_table.rotation_from_rpy((0.5, 0.0, 0.0)), truth)
        self.assertAlmostEqual(ins_table.tilt_between_deg(truth, tilted), 0.5, places=9)


if __name__ == "__main__":
    unittest.main()
