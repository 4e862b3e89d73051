#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Checks what docs/parameters.md says about presets against quatro_register: the
table of presets, and the resolution of `auto`.

    presets_test.py BUILD SCRATCH
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
LENGTHS = ('voxel_size', 'normal_radius', 'fpfh_radius', 'noise_bound')
EXTENSIONS = ('replace_missed_optimum', 'recover_translation', 'polish')


def rows():
    """Yields each preset: name, the five lengths as written, "on..." or "off"."""
    page = (ROOT / 'docs/parameters.md').read_text()
    table = page[page.index('| preset |'):].split('\n\n')[0]
    for line in table.splitlines()[2:]:
        cells = [cell.strip() for cell in line.strip('|').split('|')]
        sizes = cells[1].split(', ') + cells[2:4]
        for name in re.findall(r'`(\w+)`', cells[0]):
            yield name, sizes, cells[4]


def in_metres(size, voxel_size):
    """Converts "0.3", or "3 v" with v the voxel size, to meters."""
    factor, _, unit = size.replace('v', '1 v' if size == 'v' else 'v').partition(' ')
    return float(factor) * (voxel_size if unit else 1.0)


def answer_of(build, scans, preset):
    answer = subprocess.run([build / 'bin/quatro_register', f'--source={scans}/000001.bin',
                             f'--target={scans}/000000.bin', f'--preset={preset}', '--threads=1'],
                            capture_output=True, text=True)
    return json.loads(answer.stdout)


def main():
    build, scratch = map(pathlib.Path, sys.argv[1:])
    shutil.rmtree(scratch, ignore_errors=True)
    subprocess.run([build / 'bin/quatro_simulate', f'--output={scratch}', '--num_frames=2'], check=True,
                   capture_output=True)
    names, errors = [], []
    for name, sizes, extensions in rows():
        names.append(name)
        answer = answer_of(build, scratch / 'velodyne', name)
        used = answer['parameters']
        num_voxels = max(answer['counts']['source_voxels'], answer['counts']['target_voxels'])
        if name == 'auto' and not 0.9 * 15000 <= num_voxels <= 1.1 * 15000:
            errors.append(f'auto: {num_voxels} voxels are not 15,000')
        of_a_difference = used['tim_bound_factor'] * used['noise_bound']
        for what, size, value in zip(LENGTHS + ('of a difference',), sizes,
                                     [used[key] for key in LENGTHS] + [of_a_difference]):
            if abs(in_metres(size, used['voxel_size']) - value) > 1e-9:
                errors.append(f'{name}: {what} is {value}, the page says {size}')
        if {used[key] for key in EXTENSIONS} != {extensions.startswith('on')}:
            errors.append(f'{name}: what is beyond the paper is not {extensions}')
    shutil.rmtree(scratch)
    help_text = subprocess.run([build / 'bin/quatro_register', '--preset=?', '--source=x', '--target=x'],
                               capture_output=True, text=True).stderr
    known = set(re.findall(r'\w+', help_text.partition('must be')[2])) - {'or', 'one', 'of'}
    if known != set(names):
        errors.append(f'the page has {sorted(names)}, quatro_register {sorted(known)}: {help_text}')
    print('\n'.join(errors), file=sys.stderr, end='\n' if errors else '')
    sys.exit(1 if errors else 0)


if __name__ == '__main__':
    main()
