#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""The table in docs/mistakes.md is what the programs answer to these commands.

    mistakes_test.py BUILD SCRATCH [--update]

With --update the table is replaced by what they answer.
"""
import pathlib
import shlex
import shutil
import struct
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / 'docs/mistakes.md'
BEGIN, END = '<!-- mistakes -->\n', '<!-- end of mistakes -->\n'

COMMANDS = [
    ('A file that is not there', 'quatro_register --source=c.bin --target=b.bin'),
    ('A format that is not known', 'quatro_register --source=a.las --target=b.bin'),
    ('A NumPy array that is cut off', 'quatro_register --source=cut.npy --target=b.bin'),
    ('Points with decimal commas', 'quatro_register --source=commas.csv --target=b.bin'),
    ('Text named `.bin`', 'quatro_register --source=text.bin --target=b.bin'),
    ('Matches with semicolons', 'quatro_solve --correspondences=semicolons.csv'),
    ('A flag that is misspelled', 'quatro_register --source=a.bin --target=b.bin --voxelsize=0.3'),
    ('A flag that is given twice', 'quatro_register --source=a.bin --target=b.bin --seed=1 --seed=2'),
    ('A method that is not known', 'quatro_register --source=a.bin --target=b.bin --method=teaser++'),
    ('A length that is negative', 'quatro_register --source=a.bin --target=b.bin --voxel_size=-0.3'),
    ('An input as output', 'quatro_register --source=a.ply --target=b.bin --output=a.ply'),
    ('Two outputs in one place', 'quatro_register --source=a.bin --target=b.bin --json=- --explain'),
    ('A guess that bounds nothing', 'quatro_register --source=a.bin --target=b.bin --guess=8,0,0,90'),
    ('Matches of five columns', 'quatro_solve --correspondences=five.csv'),
    ('A drive without true poses',
     'quatro_experiment --protocol=loop --data=kitti/sequences/07 --output=run'),
]


def make_inputs(folder):
    shutil.rmtree(folder, ignore_errors=True)
    drive = folder / 'kitti/sequences/07'
    (drive / 'velodyne').mkdir(parents=True)
    grid = [(0.5 * i, 0.5 * j, 0.1 * (i * j % 7)) for i in range(40) for j in range(25)]
    four = b''.join(struct.pack('<4f', *point, 0.5) for point in grid)
    for name in ('a.bin', 'b.bin', 'a.las', drive / 'velodyne/000000.bin', drive / 'velodyne/000001.bin'):
        (folder / name).write_bytes(four)
    (drive / 'calib.txt').write_text('Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n')
    lines = [f'{x:.3f} {y:.3f} {z:.3f}' for x, y, z in grid]
    (folder / 'text.bin').write_text('\n'.join(lines) + '\n')
    (folder / 'a.ply').write_text('\n'.join([
        'ply', 'format ascii 1.0', f'element vertex {len(lines)}', 'property float x',
        'property float y', 'property float z', 'end_header', *lines]) + '\n')
    (folder / 'commas.csv').write_text('x;y;z\n1,5;2,5;3,5\n')
    header = "{'descr': '<f4', 'fortran_order': False, 'shape': (1000, 4), }".ljust(117) + '\n'
    (folder / 'cut.npy').write_bytes(b'\x93NUMPY\x01\x00\x76\x00' + header.encode() + four[:8000])
    (folder / 'semicolons.csv').write_text('1;2;3;4;5;6\n')
    (folder / 'five.csv').write_text('1,2,3,4,5\n')


def table(build, folder):
    lines = ['| mistake | command | exit code | answer |', '|---|---|---|---|']
    for mistake, command in COMMANDS:
        make_inputs(folder)
        words = shlex.split(command)
        before = sorted(folder.rglob('*'))
        run = subprocess.run([build / 'bin' / words[0], *words[1:]], cwd=folder, text=True,
                             stdin=subprocess.DEVNULL, capture_output=True, timeout=60, check=False)
        answer = run.stderr.strip().replace(f'{folder}/', '')
        if '\n' in answer or not answer or run.stdout or sorted(folder.rglob('*')) != before:
            sys.exit(f'{command}: must print one line on standard error and leave nothing, but '
                     f'printed\n{run.stdout}{run.stderr}')
        cells = (mistake, f'`{command}`', str(run.returncode), f'`{answer}`')
        lines.append('| ' + ' | '.join(cell.replace('|', '\\|') for cell in cells) + ' |')
    return '\n'.join(lines) + '\n'


def main():
    build, folder = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
    page = PAGE.read_text()
    begin, end = page.index(BEGIN) + len(BEGIN), page.index(END)
    made = table(build, folder)
    if '--update' in sys.argv[3:]:
        PAGE.write_text(page[:begin] + made + page[end:])
    elif page[begin:end] != made:
        sys.exit(f'{PAGE}: its table is not what the programs print now (run this with --update):\n'
                 f'{made}')


if __name__ == '__main__':
    main()
