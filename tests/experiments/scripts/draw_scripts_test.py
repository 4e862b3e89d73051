#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""experiments/scripts/draw_surrogates.py, draw_wrong_loops.py, draw_gnc_film.py,
draw_registration.py and calibrate_verdict.py: what is wrong is one line, and no
picture is lost."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
SCRIPTS = pathlib.Path(__file__).resolve().parents[3] / "experiments" / "scripts"
sys.path.insert(0, str(SCRIPTS))
import calibrate_verdict  # noqa: E402
import draw_gnc_film  # noqa: E402
import draw_registration  # noqa: E402
import draw_surrogates  # noqa: E402
import draw_wrong_loops  # noqa: E402
import script_support  # noqa: E402

LOOPS = ",".join(draw_wrong_loops.COLUMNS) + "\n"
RESULTS = ",".join(calibrate_verdict.COLUMNS) + "\n"
DRAWERS = (draw_surrogates, draw_wrong_loops, draw_gnc_film)


class DrawScriptsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.picture = self.folder / "old.png"
        self.picture.write_text("old")

    def table(self, content):
        path = self.folder / "table.csv"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return str(path)

    def expect_refused(self, problem, script, *args):
        with self.assertRaises(script_support.BadInput) as refused:
            script.main([str(arg) for arg in args])
        self.assertIn(problem, str(refused.exception))
        self.assertNotIn("\n", str(refused.exception))
        self.assertEqual(self.picture.read_text(), "old")

    def test_bad_tables_are_told(self):
        for script in DRAWERS:
            self.expect_refused("give ", script)
            self.expect_refused("none.csv: No such file", script, "none.csv", self.picture)
            self.expect_refused("table.csv: is not UTF-8 text", script, self.table(b"x\n\xff\n"),
                                self.picture)
            for text in ("", "a,b\n", "a,b\n1,2\n"):
                self.expect_refused("table.csv: ", script, self.table(text), self.picture)
        for script, text, problem in (
                (draw_surrogates, "mu,residual,loss\n", "there are no curves"),
                (draw_surrogates, "mu,residual,loss\n1,2\n", "line 2 must have 3 columns"),
                (draw_surrogates, "mu,residual,loss\nx,2,3\n", "line 2 is not from"),
                (draw_wrong_loops, LOOPS, "there are no lines"),
                (draw_wrong_loops, LOOPS + "w,1,1,gnc,0.1,1,0,1\n", "line 2 is not from"),
                (draw_wrong_loops, LOOPS + "w,1,1,other,0.1,1,1,1\n", "line 2 is not from")):
            self.expect_refused(problem, script, self.table(text), self.picture)

    def test_bad_pictures_are_told_first(self):
        for script in DRAWERS:
            table = self.table("")
            self.expect_refused("there is no folder", script, table, self.folder / "no/x.png")
            for name in ("x.xyz", "x"):
                self.expect_refused("must end with", script, table, self.folder / name)
            self.expect_refused("would be overwritten", script, table, table)

    def test_good_tables_are_drawn(self):
        for script, text in (
                (draw_surrogates, "mu,residual,loss\n1,0,0\n1,1,0.5\ninf,0,0\ninf,1,1\n"),
                (draw_wrong_loops, LOOPS + "sphere,1,1,gnc,0.1,1,2,0.3\n")):
            script.main([self.table(text), str(self.picture)])
            self.assertEqual(self.picture.read_bytes()[:4], b"\x89PNG")

    def test_bad_results_are_told(self):
        for content, problem in (("", "there is no column"), (RESULTS, "there are no pairs"),
                                 (b"\xff", "is not UTF-8 text"),
                                 (RESULTS + "s,a,b\n", "line 2 must have 7 columns"),
                                 (RESULTS + "s,a,b,registered,1,0.9,m=x\n", "line 2 is not of"),
                                 (RESULTS + "s,a,b,ambiguous,,,\n", "there are no pairs")):
            self.expect_refused(problem, calibrate_verdict, self.table(content))

    def test_exit_code_is_2(self):
        for name in ("draw_surrogates.py", "draw_registration.py"):
            run = subprocess.run([sys.executable, str(SCRIPTS / name)], capture_output=True,
                                 text=True, check=False)
            self.assertEqual((run.returncode, run.stderr.count("\n")), (2, 1), run.stderr)
            self.assertTrue(run.stderr.startswith(f"{name}: give "), run.stderr)

    def test_bad_data_of_a_registration_are_told(self):
        for content in ("", "[]", "{}", b"\xff"):
            self.assertIn("was not written by quatro_register --picture",
                          draw_registration.main([self.table(content), str(self.picture)]))
        self.assertIn("No such file", draw_registration.main(["none.json", str(self.picture)]))


if __name__ == "__main__":
    unittest.main()
