#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""experiments/scripts/report_paper.py on tables made up for it."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[3] / "experiments" / "scripts" / "report_paper.py"

TABLE_ONE = """method,origin,00,00 low,00 high,all,all low,all high
quatro,measured,{quatro},90,100,{quatro},90,100
teaser,measured,98.00,90,100,98.00,90,100
fgr,measured,40.00,30,50,40.00,30,50
ransac10k,measured,50.00,30,50,50.00,30,50
Quatro,quoted,12.34,,,,,
"""
TABLE_TWO = """method,origin,t_rel % at 1,t_rel % at 5
quatro_c2f,measured,0.50,{five}
"""


class ReportPaperTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, name, text):
        path = pathlib.Path(self.folder.name) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def run_script(self):
        return subprocess.run([sys.executable, str(SCRIPT), self.folder.name],
                              capture_output=True, text=True, check=False)

    def verdicts(self, word):
        return [line.rsplit("|", 2)[1].strip() for line in self.run_script().stdout.splitlines()
                if line.startswith("| 00") and word in line]

    def test_findings_follow_the_figures(self):
        for quatro, expected in (("99.50", "holds"), ("98.90", "does not hold")):
            self.write("table_one/tables/table_one.csv", TABLE_ONE.format(quatro=quatro))
            self.assertEqual(self.verdicts("99 % or more"), [expected])
        self.assertEqual(self.verdicts("above TEASER++"), ["holds"])
        self.assertEqual(self.verdicts("far below"), ["holds"])
        self.write("table_one/tables/table_one.csv", TABLE_ONE.format(quatro="69.00"))
        self.assertEqual(self.verdicts("above TEASER++"), ["does not hold"])
        self.assertEqual(self.verdicts("far below"), ["does not hold"])

    def test_quoted_rows_are_marked_and_never_taken(self):
        self.write("table_one/tables/table_one.csv", TABLE_ONE.format(quatro="99.50"))
        page = self.run_script().stdout
        self.assertIn("Quatro (quoted)", page)
        self.assertEqual(page.count("12.34"), 1)
        self.assertNotIn(" low", page)

    def test_reasons_are_counted(self):
        self.write("table_one/tables/table_one.csv", TABLE_ONE.format(quatro="50.00"))
        self.assertNotIn("Why:", self.run_script().stdout)
        self.write("table_one/results.csv",
                   "pair,method,translation_error_m,rotation_error_deg,consistent\n"
                   "a,quatro,0.1,1,20\na,teaser,3,1,20\n"
                   "b,quatro,0.1,11,10\nb,teaser,0.1,9,10\n"
                   "c,quatro,,,0\nc,teaser,,,0\n"
                   "d,quatro,1,1,14\nd,teaser,1,1,14\n")
        page = self.run_script().stdout
        self.assertIn("the median pair has 12 consistent matches. Quatro misses 2 of 4",
                      page)
        self.assertIn("teaser is correct on 1 of the pairs that Quatro misses, and misses 1 that", page)
        self.assertNotIn("fgr is correct", page)

    def test_the_ablation_counts_pairs(self):
        self.write("table_one/tables/table_one.csv", TABLE_ONE.format(quatro="99.50"))
        self.assertNotIn("one part of the search off", self.run_script().stdout)
        header = "set,status,translation_error_m,rotation_error_deg,total_ms\n"
        for world, rows in (("street", "a,registered,0.1,1,20\nb,registered,1.9,4.9,30\n"),
                            ("crossing", "a,registered,0.1,5.1,20\nb,ambiguous,,,40\n"),
                            ("hill", "a,registered,3.0,1,20\n")):
            self.write(f"ablation/none/{world}.csv", header + rows)
        self.write("ablation/segments/street.csv", header + "a,registered,0.1,1,20\n")
        page = self.run_script().stdout
        self.assertIn("| nothing | 2 of 2 | 0 of 2 | 0 of 1 | 4 | 1 | 20 |", page)
        self.assertNotIn("| segments |", page)

    def test_drift_at_five_may_be_better(self):
        for five, expected in (("0.10", "holds"), ("0.75", "holds"), ("0.76", "does not hold")):
            self.write("table_two/table_two.csv", TABLE_TWO.format(five=five))
            line = [line for line in self.run_script().stdout.splitlines() if "c2f as good" in line]
            self.assertEqual(line[0].rsplit("|", 2)[1].strip(), expected)

    def test_missing_runs_are_told(self):
        self.write("table_two/table_two.csv", TABLE_TWO.format(five="0.5"))
        run = self.run_script()
        self.assertEqual(run.returncode, 0)
        self.assertIn("Not run.", run.stdout)

    def test_figures_without_a_table_are_shown_where_they_are(self):
        self.write("table_two/table_two.csv", TABLE_TWO.format(five="0.5"))
        self.assertNotIn("tilt.png", self.run_script().stdout)
        self.write("tilt/figures/tilt.png", "")
        page = self.run_script().stdout
        self.assertIn("(tilt/figures/tilt.png)", page)
        self.assertNotIn("surrogates.png", page)

    def test_nothing_at_all_is_an_error(self):
        run = self.run_script()
        self.assertEqual(run.returncode, 2)
        self.assertEqual(run.stderr.count("\n"), 1)
        self.assertIn("contains none of the runs", run.stderr)

    def test_what_is_not_of_an_experiment_is_told_in_one_line(self):
        self.write("table_one/tables/table_one.csv", TABLE_ONE.format(quatro="99.50"))
        for name, text, problem in (
                ("table_two/table_two.csv", "a,b\n1,2\n", "there is no column method"),
                ("table_one/manifest.json", "{", "manifest.json: "),
                ("table_one/manifest.json", "{}", "has no 'version'"),
                ("table_one/results.csv", "method\nquatro\n", "there is no column pair")):
            self.write(name, text)
            run = self.run_script()
            self.assertEqual((run.returncode, run.stderr.count("\n")), (2, 1), run.stderr)
            self.assertIn(problem, run.stderr)
            (pathlib.Path(self.folder.name) / name).unlink()


if __name__ == "__main__":
    unittest.main()
