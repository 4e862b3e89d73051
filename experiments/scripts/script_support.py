# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Common parts of the scripts: reading flags and files, writing, and exiting.

A script is a main(arguments), run by run_script. For an invalid flag or file it raises
BadInput, whose text is the one line that the user sees.
"""
import argparse
import csv
import io
import math
import os
import sys
import tempfile
import time


class BadInput(Exception):
    pass


class Parser(argparse.ArgumentParser):
    def __init__(self, description, **options):
        super().__init__(description=description, allow_abbrev=False,
                         formatter_class=argparse.RawDescriptionHelpFormatter, **options)

    def error(self, message):
        raise BadInput(message)


def split_flags(arguments):
    """Splits at "--"; the arguments after it are for the program that the script runs."""
    split = arguments.index("--") if "--" in arguments else len(arguments)
    return arguments[:split], arguments[split + 1:]


def reason(error):
    """The text of an OSError or another error, without its path."""
    return getattr(error, "strerror", None) or str(error)


def parse_number(text, where):
    try:
        value = float(text)
    except (TypeError, ValueError):
        raise BadInput(f"{where}: {text!r} is not a number") from None
    if not math.isfinite(value):
        raise BadInput(f"{where}: {text!r} is not finite")
    return value


def read_rows(path, columns=()):
    """(line, row) of each, and the names of the columns, of which `columns` must be there.

    Takes a byte order mark, every line's end, blank lines, and blanks around cells.
    """
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            reader = csv.reader(file, skipinitialspace=True)
            lines = [(reader.line_num, [cell.strip() for cell in cells]) for cells in reader]
    except UnicodeDecodeError:
        raise BadInput(f"{path}: is not UTF-8 text; save it as UTF-8") from None
    except (OSError, csv.Error) as error:
        raise BadInput(f"{path}: {reason(error)}") from None
    lines = [(line, cells) for line, cells in lines if cells and cells != [""]]
    names = lines[0][1] if lines else []
    if len(names) == 1 and ";" in names[0]:
        raise BadInput(f"{path}: line 1 has semicolons, must have commas between columns")
    for name in columns:
        if name not in names:
            raise BadInput(f"{path}: there is no column {name}")
    for line, cells in lines[1:]:
        if len(cells) != len(names):
            raise BadInput(f"{path}: line {line} must have {len(names)} columns")
    return [(line, dict(zip(names, cells))) for line, cells in lines[1:]], names


class Progress:
    """What is done, on standard error. On a terminal every text is printed, over the one
    before it or on a line of its own; elsewhere a line every ten seconds at most, and the
    last."""
    SECONDS_BETWEEN_LINES = 10.0

    def __init__(self, writes_over=False, file=None, clock=time.monotonic):
        self.file = file or sys.stderr
        self.is_terminal = self.file.isatty()
        self.writes_over = writes_over and self.is_terminal
        self.clock = clock
        self.last_printed = clock()

    def __call__(self, text, is_last):
        now = self.clock()
        if not (self.is_terminal or is_last or
                now - self.last_printed >= self.SECONDS_BETWEEN_LINES):
            return
        self.last_printed = now
        self.file.write(("\r" if self.writes_over else "") + text +
                        ("" if self.writes_over and not is_last else "\n"))
        self.file.flush()


def check_writable(path, inputs=()):
    """Before the work that is to be written; never over what it is made of. "-" is standard
    output, "./-" a file."""
    if path == "-":
        return
    if os.path.isdir(path):
        raise BadInput(f"{path}: is a directory, must be a file to write")
    folder = os.path.dirname(path) or "."
    if not os.path.isdir(folder):
        raise BadInput(f"{path}: there is no folder {folder}")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise BadInput(f"{path}: may not write into folder {folder}")
    if os.path.realpath(path) in [os.path.realpath(name) for name in inputs if name != "-"]:
        raise BadInput(f"{path}: would be overwritten, but is read here; name another file")


def check_folder(path):
    if path == "-":
        raise BadInput("--output=-: a folder cannot go to standard output; ./- is one named -")


def check_picture(path, inputs):
    check_writable(path, inputs)
    try:
        from matplotlib.backend_bases import FigureCanvasBase
    except ImportError:
        raise BadInput(f"{path}: this Python has no Matplotlib; run by with_python.sh "
                       "matplotlib") from None
    if path == "-":
        return
    endings = FigureCanvasBase.get_supported_filetypes()
    if os.path.splitext(path)[1][1:].lower() not in endings:
        raise BadInput(f"{path}: a picture's name must end with one of .{' .'.join(endings)}")


def save_picture(figure, path, **options):
    picture = io.BytesIO()
    ending = "png" if path == "-" else os.path.splitext(path)[1][1:].lower()
    figure.savefig(picture, format=ending, **options)
    write_atomically(path, picture.getvalue())


def write_atomically(path, content):
    """Text or bytes. "-" is standard output."""
    data = content.encode() if isinstance(content, str) else content
    if path == "-":
        sys.stdout.flush()
        sys.stdout.buffer.write(data)
        sys.stdout.buffer.flush()
        return
    try:
        descriptor, temporary = tempfile.mkstemp(dir=os.path.dirname(path) or ".",
                                                 prefix=os.path.basename(path) + ".tmp.")
        try:
            with open(descriptor, "wb") as file:
                file.write(data)
                os.fchmod(file.fileno(), 0o644)
            os.replace(temporary, path)
        except BaseException:
            os.unlink(temporary)
            raise
    except OSError as error:
        raise BadInput(f"{path}: {reason(error)}") from None


def summary_stream(*outputs):
    """Where a script prints what it found: standard error if an output goes to standard
    output, which is then this output alone."""
    return sys.stderr if "-" in outputs else sys.stdout


def run_script(main):
    """Runs main(arguments) and prints errors in one line."""
    try:
        main(sys.argv[1:])
        sys.stdout.flush()
        return
    except BadInput as error:
        problem, code = error, 2
    except OSError as error:
        problem, code = f"{error.filename or 'standard output'}: {reason(error)}", 2
        # Avoids a second failure in Python's own flush at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    except KeyboardInterrupt:
        problem, code = "interrupted", 130
    print(f"{os.path.basename(sys.argv[0])}: {problem}", file=sys.stderr)
    sys.exit(code)
