#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""experiments/scripts/script_support.py."""
import contextlib
import io
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

SCRIPTS = pathlib.Path(__file__).resolve().parents[3] / "experiments" / "scripts"
sys.path.insert(0, str(SCRIPTS))

import script_support as support  # noqa: E402


class ScriptSupportTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, data):
        path = self.folder / "table.csv"
        path.write_bytes(data)
        return str(path)

    def refused(self, function, *args):
        with self.assertRaises(support.BadInput) as caught:
            function(*args)
        return str(caught.exception)

    def test_rows_know_their_lines(self):
        # As written by a spreadsheet: with a byte order mark and \r
        # ; empty lines are ignored.
        rows, names = support.read_rows(self.write(b"\xef\xbb\xbfa,b\r\n1,2\r\n\r\n3,\r\n"), ("a",))
        self.assertEqual(names, ["a", "b"])
        self.assertEqual(rows, [(2, {"a": "1", "b": "2"}), (4, {"a": "3", "b": ""})])

    def test_line_ends_and_blanks_do_not_matter(self):
        for end in (b"\n", b"\r\n", b"\r"):
            data = end.join((b"\xef\xbb\xbfa, b ", b" 1,\"2, 3\"", b"  ", b""))
            rows, names = support.read_rows(self.write(data), ("b",))
            self.assertEqual((names, rows), (["a", "b"], [(2, {"a": "1", "b": "2, 3"})]))

    def test_tables_that_are_none_are_told(self):
        for data, needed, problem in ((b"", ("a",), "there is no column a"),
                                      (b"a,b\n1\n", (), "line 2 must have 2 columns"),
                                      (b"a,b\n1,2\n1,2,3\n", (), "line 3 must have 2 columns"),
                                      (b"a;b\n1;2\n", (), "line 1 has semicolons"),
                                      (b"\xff\xfea\0", (), "is not UTF-8 text; save it as")):
            self.assertIn("table.csv: " + problem,
                          self.refused(support.read_rows, self.write(data), needed))
        self.assertEqual(self.refused(support.read_rows, "/none.csv"),
                         "/none.csv: No such file or directory")

    def test_numbers_are_finite(self):
        self.assertEqual(support.parse_number("-1e3", "x"), -1000.0)
        for text, problem in (("inf", "is not finite"), ("", "is not a number"),
                              (None, "is not a number")):
            self.assertEqual(self.refused(support.parse_number, text, "line 2"),
                             f"line 2: {text!r} {problem}")

    def test_a_dash_is_standard_output(self):
        with tempfile.TemporaryFile("w+") as file:
            with contextlib.redirect_stdout(file):
                support.check_writable("-", ["-"])
                support.write_atomically("-", "one\n")
            file.seek(0)
            self.assertEqual(file.read(), "one\n")
        self.assertFalse(pathlib.Path("-").exists())
        path = str(self.folder) + "/-"
        support.write_atomically(path, "two")
        self.assertEqual(pathlib.Path(path).read_text(), "two")
        self.assertIs(support.summary_stream("-", None), sys.stderr)
        self.assertIs(support.summary_stream(None, "./-"), sys.stdout)
        self.assertIn("a folder cannot", self.refused(support.check_folder, "-"))

    def progress(self, is_terminal, writes_over):
        """What 100 steps of a second print."""
        file = io.StringIO()
        file.isatty = lambda: is_terminal
        now = [0.0]
        progress = support.Progress(writes_over, file, lambda: now[0])
        for i in range(1, 102):
            now[0] += 1.0
            progress(f"{i}/101", i == 101)
        return file.getvalue()

    def test_a_log_gets_a_line_every_ten_seconds_and_the_last(self):
        lines = "".join(f"{i}/101\n" for i in (*range(10, 101, 10), 101))
        self.assertEqual(self.progress(False, True), lines)
        self.assertEqual(self.progress(False, False), lines)

    def test_a_terminal_gets_all(self):
        texts = [f"{i}/101" for i in range(1, 102)]
        self.assertEqual(self.progress(True, True), "\r" + "\r".join(texts) + "\n")
        self.assertEqual(self.progress(True, False), "\n".join(texts) + "\n")

    def test_flags_behind_two_dashes_are_anothers(self):
        self.assertEqual(support.split_flags(["a", "--", "b", "--", "c"]), (["a"], ["b", "--", "c"]))
        self.assertEqual(support.split_flags(["a"]), (["a"], []))

    def test_flags_are_not_abbreviated(self):
        parser = support.Parser("Does it.")
        parser.add_argument("--output")
        self.assertEqual(parser.parse_args(["--output=a"]).output, "a")
        self.assertIn("unrecognized", self.refused(parser.parse_args, ["--out=a"]))

    def test_a_write_that_fails_leaves_what_was_there(self):
        path = self.write(b"old")
        with mock.patch("os.replace", side_effect=OSError(28, "No space left on device")):
            self.assertEqual(self.refused(support.write_atomically, path, "new"),
                             f"{path}: No space left on device")
        self.assertEqual([p.read_bytes() for p in self.folder.iterdir()], [b"old"])
        support.write_atomically(path, "new")
        self.assertEqual([p.read_bytes() for p in self.folder.iterdir()], [b"new"])

    def test_what_is_read_is_not_written(self):
        path = self.write(b"old")
        (self.folder / "link").symlink_to(path)
        for name in (path, str(self.folder / "link"), str(self.folder / "." / "table.csv")):
            self.assertIn("would be overwritten", self.refused(support.check_writable, name, [path]))
        self.assertIn("is a directory", self.refused(support.check_writable, str(self.folder)))
        self.assertIn("there is no folder",
                      self.refused(support.check_writable, str(self.folder / "none" / "x")))

    def test_without_matplotlib_there_is_no_picture(self):
        with mock.patch.dict(sys.modules, {"matplotlib.backend_bases": None}):
            self.assertIn("no Matplotlib",
                          self.refused(support.check_picture, str(self.folder / "a.png"), []))

    def run_script(self, main):
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors), mock.patch("sys.argv", ["/a/name.py", "x"]):
            try:
                support.run_script(main)
                code = 0
            except SystemExit as stop:
                code = stop.code
        return code, errors.getvalue()

    def test_scripts_end_with_one_line_and_a_code(self):
        seen = []
        self.assertEqual(self.run_script(seen.append), (0, ""))
        self.assertEqual(seen, [["x"]])
        for error, expected in ((support.BadInput("--x: no"), (2, "name.py: --x: no\n")),
                                (KeyboardInterrupt(), (130, "name.py: interrupted\n"))):
            self.assertEqual(self.run_script(mock.Mock(side_effect=error)), expected)


if __name__ == "__main__":
    unittest.main()
