#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""experiments/scripts/draw_experiment.py on results of a few pairs."""
import contextlib
import io
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
SCRIPT = pathlib.Path(__file__).resolve().parents[3] / "experiments" / "scripts" / "draw_experiment.py"
sys.path.insert(0, str(SCRIPT.parent))
import draw_experiment  # noqa: E402

COLUMNS = ("pair", "set", "bin", "method", "status", "distance_m", "true_yaw_deg", "true_tilt_deg",
           "rotation_error_deg", "translation_error_m", "total_ms", "stages_ms")


def row(pair="a", bin_name="8-10 m", method="quatro", error=0.1, **changes):
    cells = {"pair": pair, "set": "00", "bin": bin_name, "method": method, "status": "registered",
             "distance_m": "9", "true_yaw_deg": "-170", "true_tilt_deg": "0.5",
             "rotation_error_deg": "" if error is None else str(4 * error),
             "translation_error_m": "" if error is None else str(error), "total_ms": "30",
             "stages_ms": "voxels=10;matching=15;rotation=5"}
    return {**cells, **changes}


def text_of(rows, columns=COLUMNS):
    lines = [",".join(columns)] + [",".join(r[name] for name in columns) for r in rows]
    return "\n".join(lines) + "\n"


ROWS = [row(), row("b", error=0.3), row("c", error=5.0), row("d", error=None),
        row("a", method="teaser", error=0.0), row("e", method="teaser", status="unreadable"),
        row("f", bin_name="0-2 m"), row("g", bin_name="yaw 90 deg"),
        row("g", bin_name="yaw 0 deg"),
        row("h", distance_m="", true_yaw_deg="", true_tilt_deg="", error=None)]


class DrawExperimentTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, text):
        (self.folder / "results.csv").write_text(text, encoding="utf-8")

    def draw(self, *args):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            draw_experiment.main([str(self.folder), *args])
        return [pathlib.Path(line) for line in out.getvalue().splitlines()]

    def expect_refused(self, why, *args):
        before = sorted(self.folder.rglob("*"))
        with self.assertRaises(draw_experiment.BadInput) as caught:
            self.draw(*args)
        self.assertIn(why, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))
        self.assertEqual(sorted(self.folder.rglob("*")), before)

    def test_every_figure_is_drawn_as_pdf_and_png(self):
        self.write(text_of(ROWS))
        files = self.draw("--output=" + str(self.folder / "new" / "figures"))
        self.assertEqual([file.name for file in files],
                         [f"{name}.{suffix}" for name in draw_experiment.FIGURES
                          for suffix in ("pdf", "png")])
        for file in files:
            self.assertEqual(file.parent, self.folder / "new" / "figures")
            start = b"%PDF-" if file.suffix == ".pdf" else b"\x89PNG\r\n\x1a\n"
            self.assertTrue(file.read_bytes().startswith(start), file)

    def test_the_same_results_give_the_same_bytes(self):
        self.write(text_of(ROWS))
        first = [file.read_bytes() for file in self.draw("--figures=success")]
        self.assertEqual([file.read_bytes() for file in self.draw("--figures=success")], first)
        self.write(text_of(ROWS[1:]))
        self.assertNotEqual([file.read_bytes() for file in self.draw("--figures=success")], first)

    def test_figures_without_pairs_are_left_out(self):
        self.write(text_of([row(status="unreadable", distance_m="", true_yaw_deg="",
                                true_tilt_deg="", error=None, stages_ms="")]))
        self.assertEqual(self.draw(), [])
        self.write(text_of([row(bin_name="all", error=None, stages_ms="")]))
        self.assertEqual([file.name for file in self.draw("--figures=distance,yaw,timing,recall")],
                         ["recall.pdf", "recall.png"])

    def test_bins_are_drawn_where_a_set_has_several(self):
        self.write(text_of([row(), row("b")]))
        self.assertEqual(self.draw("--figures=bins"), [])
        self.write(text_of([row(), row("b", bin_name="95 % outliers")]))
        self.assertEqual(len(self.draw("--figures=bins")), 2)

    def test_tilts_alone_are_drawn(self):
        tilts = self.folder / "tilts.csv"
        tilts.write_text("set,source,target,yaw_deg,rollpitch_deg\n00,7,3,-170,1\n00,8,3,10,x\n",
                         encoding="utf-8")
        self.expect_refused("tilts.csv: line 3, column rollpitch_deg: 'x' is not a number")
        tilts.write_text("set,source,target,yaw_deg,rollpitch_deg\n00,7,3,-170,1\n",
                         encoding="utf-8")
        self.assertEqual([file.name for file in self.draw()], ["tilt.pdf", "tilt.png"])
        self.write(text_of(ROWS))  # results.csv takes precedence.
        self.assertIn("recall.pdf", [file.name for file in self.draw()])

    def test_bad_input_is_one_line_and_exit_code_2(self):
        run = subprocess.run([sys.executable, str(SCRIPT), str(self.folder)], capture_output=True,
                             text=True, check=False, stdin=subprocess.DEVNULL)
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertEqual(run.stderr, f"draw_experiment.py: {self.folder}/results.csv: "
                         "No such file or directory\n")

    def test_bad_input_is_told(self):
        self.expect_refused("results.csv: No such file")
        self.write(text_of([]))
        self.expect_refused("has no results")
        self.write("")
        self.expect_refused("there is no column pair")
        self.write(text_of(ROWS, [name for name in COLUMNS if name != "stages_ms"]))
        self.expect_refused("there is no column stages_ms")
        self.write(text_of([row(), row(distance_m="x")]))
        self.expect_refused("line 3, column distance_m: 'x' is not a number")
        self.write(text_of([row(total_ms="nan")]))
        self.expect_refused("line 2, column total_ms: 'nan' is not finite")
        self.write(text_of([row(stages_ms="voxels")]))
        self.expect_refused("line 2, column stages_ms has no 'stage=ms' in 'voxels'")
        self.write(text_of([row()]) + "a,b\n")
        self.expect_refused("line 3 must have 12 columns")
        self.write(text_of([row(error=None, translation_error_m="1")]))
        self.expect_refused("line 2 has only one of two errors")
        self.write(text_of(ROWS))
        self.expect_refused("'pie' is not one of", "--figures=success,pie")
        for limit in ("2", "2/", "2/-1", "1/2/3"):
            self.expect_refused("must be like 2/10", "--limit=" + limit)
        self.expect_refused("results.csv: File exists",
                            "--output=" + str(self.folder / "results.csv"))
        self.expect_refused("unrecognized arguments", "--colour=red")

    def test_success_is_within_both_limits(self):
        def result(translation, rotation):
            return {"translation_error_m": translation, "rotation_error_deg": rotation}
        limit = draw_experiment.parse_limit("2/10")
        self.assertTrue(draw_experiment.succeeds(result(2.0, 10.0), limit))
        self.assertFalse(draw_experiment.succeeds(result(2.01, 1.0), limit))
        self.assertFalse(draw_experiment.succeeds(result(0.1, 10.01), limit))
        self.assertFalse(draw_experiment.succeeds(result(None, None), limit))

    def test_intervals_are_wilsons(self):
        # Newcombe 1998, table I, as in intervals_test.cc.
        for successes, n, low, high in ((81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605),
                                        (0, 20, 0.0, 0.1611), (1, 29, 0.0061, 0.1718)):
            interval = draw_experiment.wilson(successes, n)
            self.assertAlmostEqual(interval[0], low, delta=5e-5)
            self.assertAlmostEqual(interval[1], high, delta=5e-5)
        self.assertEqual(draw_experiment.wilson(7, 7)[1], 1.0)
        self.assertEqual(draw_experiment.wilson(0, 7)[0], 0.0)

    def test_quantiles_are_linear_between_values(self):
        self.assertEqual(draw_experiment.quantile([20.0, 0.0, 10.0], 0.25), 5.0)
        self.assertEqual(draw_experiment.quantile([20.0, 0.0, 10.0], 1.0), 20.0)
        self.assertEqual(draw_experiment.quantile([7.0], 0.5), 7.0)

    def test_bins_are_told_by_their_names(self):
        self.assertEqual(draw_experiment.distance_of("8-10 m"), (8.0, 10.0))
        self.assertEqual(draw_experiment.yaw_of("yaw 0 deg"), 0.0)
        self.assertEqual(draw_experiment.yaw_of("yaw -22.5 deg"), -22.5)
        for name in ("", "all", "8-10", "yaw deg", "8-10 m "):
            self.assertFalse(draw_experiment.distance_of(name), name)
            self.assertIsNone(draw_experiment.yaw_of(name), name)

    def test_stages_are_in_the_order_of_the_methods(self):
        def result(*stages):
            return {"stages": dict.fromkeys(stages, 1.0)}
        self.assertEqual(draw_experiment.order_stages(
            [result("voxels", "ransac", "judge"), result("voxels", "fgr", "judge"),
             result("voxels", "graph", "clique", "judge", "last")]),
            ["voxels", "ransac", "fgr", "graph", "clique", "judge", "last"])


if __name__ == "__main__":
    unittest.main()
