#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Runs every command in README.md and docs/ as it is printed there.

    commands_test.py BUILD SCRATCH [PYTHON]

Blocks of `sh` are run one after another, page by page, in a scratch folder that
looks like the repository after a build. index.md comes first because it creates
the input files of the other pages. A comment above a block changes this:

    <!-- long: REASON -->      not run; only its programs and flags are checked
    <!-- file: PATH -->        must be identical to that file, except its license
    <!-- lines of: PATH -->    its lines must appear in that file, in this order

Blocks of `python` are run by PYTHON, which needs NumPy and the module; without
PYTHON they are skipped. A `cpp` block needs `file` or `lines of`, so that it is
compiled as part of a program.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r'^(?:<!-- ([^\n]*?) -->\n)?```(\w+)\n(.*?)^```$', re.M | re.S)
# Programs of other projects, whose flags are not checked.
INSTALLED = {'cmake', 'pip', 'cp', 'cat'}


def pages():
    first = ROOT / 'docs/index.md'
    rest = [ROOT / 'docs/quick_start.md', ROOT / 'README.md', *sorted((ROOT / 'docs').glob('*.md'))]
    return [first, *(page for k, page in enumerate(rest) if page != first and page not in rest[:k])]


def lay_out(build, scratch):
    """Creates scratch as the commands see the repository; all output stays there."""
    shutil.rmtree(scratch, ignore_errors=True)
    (scratch / 'build').mkdir(parents=True)
    for name in ('features', 'solvers', 'robust', 'third_party', 'tests', 'docs', 'examples', 'python', 'CMakeLists.txt'):
        (scratch / name).symlink_to(ROOT / name)
    for path in [build / 'bin', build / 'python', *build.glob('*.cmake')]:
        if path.exists():
            (scratch / 'build' / path.name).symlink_to(path)
    # Copied, not linked: scripts look for the programs relative to their own path.
    shutil.copytree(ROOT / 'experiments', scratch / 'experiments',
                    ignore=shutil.ignore_patterns('*.cc', '*.h', 'pictures', 'node_modules', '__pycache__'))
    (scratch / 'experiments/pictures').symlink_to(ROOT / 'experiments/pictures')


def commands(block):
    """Yields each command of a block as a list of words, without comments."""
    for line in block.replace('\\\n', ' ').splitlines():
        words = shlex.split(line, comments=True)
        while words:
            end = words.index('&&') if '&&' in words else len(words)
            yield words[:end]
            words = words[end + 1:]


def describe(program):
    """Returns the text that lists a program's flags: its help, or a script's source."""
    if program.parent.name != 'bin':
        return program.read_text()
    return subprocess.run([program, '--help'], capture_output=True, text=True).stdout


def check_long(block, scratch):
    """Returns the first problem of a block that takes too long to run, or nothing."""
    for words in commands(block):
        if words[0] in INSTALLED:
            continue
        programs = [scratch / word for word in words if re.match(r'(build/bin|experiments|tests|third_party)/', word)]
        if not programs or programs[0] != scratch / words[0]:
            return f'{words[0]} is not a program of the repository'
        if programs[0].name == 'quatro_benchmark' and not programs[0].exists():
            continue
        text = ''
        for program in programs:
            if not os.access(program, os.X_OK):
                return f'{program.relative_to(scratch)} cannot be run'
            text += describe(program)
        # Flags after " -- " are passed to quatro_register.
        if '--' in words:
            text += describe(scratch / 'build/bin/quatro_register')
        for flag in (word for word in words if re.match(r'--\w', word)):
            name = re.match(r'--(\w+)', flag).group(1)
            if name.startswith('benchmark_'):  # Google Benchmark's, not in our help texts.
                continue
            names = rf'(?:{name}|{re.sub("^no", "", name)})'
            if not re.search(rf'-{names}\b|"--{names}"|\b{names}\b', text):
                return f'{words[0]} has no flag {flag}'
    return ''


def run(command, scratch, **environment):
    done = subprocess.run(command, cwd=scratch, capture_output=True, text=True, stdin=subprocess.DEVNULL,
                          env={**os.environ, **environment})
    if done.returncode == 0:
        return ''
    return f'ended with {done.returncode}:\n{done.stdout[-2000:]}{done.stderr[-2000:]}'


def is_file(block, path):
    text = re.sub(r'\A(?://|#) SPDX.*\n(?://|#) SPDX.*\n', '', (ROOT / path).read_text())
    return '' if block == text else f'is not {path}'


def has_lines(block, path):
    lines = iter([line.strip() for line in (ROOT / path).read_text().splitlines()])
    for line in block.splitlines():
        if line.strip() and line.strip() not in lines:
            return f'{path} has no line "{line.strip()}" there'
    return ''


def check(mark, language, block, scratch, python):
    """Returns the first problem of a block, or an empty string."""
    kind, _, argument = (mark or '').partition(': ')
    if kind == 'file':
        return is_file(block, argument)
    if kind == 'lines of':
        return has_lines(block, argument)
    if kind == 'long':
        return check_long(block, scratch)
    if language == 'sh':
        if not (scratch / 'build/bin/../share/quatro/report_template.html').resolve().exists():
            block = re.sub(r'^.* --report=.*$', '', block, flags=re.M)  # quatro was built without the npm packages.
        return run(['bash', '-euo', 'pipefail', '-c', block], scratch)
    if language == 'python':
        return run([python, '-c', block], scratch, PYTHONPATH='build/python') if python else ''
    return '' if language == 'cmake' else f'{language}: no test checks this block'


def main():
    build, scratch = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
    python = sys.argv[3] if len(sys.argv) > 3 else ''
    lay_out(build, scratch)
    errors, num_run, num_long = [], 0, 0
    for page in pages():
        text = page.read_text()
        for found in BLOCK.finditer(text):
            mark, language, block = found.groups()
            where = f'{page.relative_to(ROOT)}:{text.count(chr(10), 0, found.start(2)) + 1}'
            begin = time.time()
            error = check(mark, language, block, scratch, python)
            num_run += language == 'sh' and not mark
            num_long += (mark or '').startswith('long')
            print(f'{where}: {language}{f", {mark}" if mark else ""}, {time.time() - begin:.1f} s', flush=True)
            if error:
                errors.append(f'{where} {error}')
    shutil.rmtree(scratch)
    print(f'{num_run} blocks of commands were run, {num_long} only checked')
    if num_run < 10 or num_run < num_long:
        errors.append(f'too few blocks were run: {num_run}, against {num_long} only checked')
    print('\n'.join(errors), file=sys.stderr, end='\n' if errors else '')
    sys.exit(1 if errors else 0)


if __name__ == '__main__':
    main()
