#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""third_party/install.sh prints a command for every system, and what it hands to
apt-get is the command that it prints for Debian: packages_test.py SCRATCH
"""
import os
import pathlib
import shutil
import subprocess
import sys

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / 'third_party' / 'install.sh'
TOOLS = {'debian': 'sudo apt-get install --no-install-recommends ', 'fedora': 'sudo dnf install ',
         'arch': 'sudo pacman -S --needed ', 'brew': 'brew install ',
         'conda': 'conda install -c conda-forge '}
OS_RELEASE = {'fedora': 'ID="rocky"\nID_LIKE="rhel centos fedora"\n', 'arch': 'ID=arch\n'}


def run(*arguments, **environment):
    return subprocess.run(['bash', str(SCRIPT), *arguments], capture_output=True, text=True,
                          env={**os.environ, **environment})


def printed(system):
    """The packages of the command for this system."""
    answer = run('--print', system)
    command = answer.stdout.splitlines()[0]
    assert answer.returncode == 0 and command.startswith(TOOLS[system]), answer
    names = command[len(TOOLS[system]):].split()
    assert len(names) >= 15 and len(set(names)) == len(names), command
    assert not {'+', '-'} & set(names), command
    return names


def program(folder, name, text):
    path = folder / name
    path.write_text('#!/bin/sh\n' + text)
    path.chmod(0o755)


def main(scratch):
    shutil.rmtree(scratch, ignore_errors=True)
    names = {system: printed(system) for system in TOOLS}
    assert run('--print', 'plan9').returncode == 2

    # A Debian that has nothing: node and npm stand for those of others.
    debian = scratch / 'debian'
    debian.mkdir(parents=True)
    program(debian, 'dpkg-query', 'exit 1\n')
    program(debian, 'apt-get', f'echo "$@" >>{scratch}/apt.txt\n')
    program(debian, 'sudo', 'shift\nexec "$@"\n')
    for name in ('node', 'npm'):
        program(debian, name, 'exit 1\n')
    answer = run(PATH=f'{debian}:{os.environ["PATH"]}')
    assert answer.returncode == 1 and 'could not install' in answer.stderr, answer
    install = [line.split() for line in (scratch / 'apt.txt').read_text().splitlines()
               if ' install ' in line]
    assert len(install) == 1, install
    asked = install[0][install[0].index('--no-install-recommends') + 1:]
    assert asked == [name for name in names['debian'] if name not in ('nodejs', 'npm')], asked

    # Systems without apt: a PATH of the few tools that the script calls.
    bare = scratch / 'bare'
    bare.mkdir()
    for tool in ('bash', 'awk', 'sed', 'grep', 'paste', 'uname', 'dirname', 'cmp'):
        (bare / tool).symlink_to(shutil.which(tool))
    for system, text in OS_RELEASE.items():
        (scratch / 'os-release').write_text(text)
        answer = run(PATH=str(bare), OS_RELEASE=str(scratch / 'os-release'))
        assert answer.returncode == 0 and ' '.join(names[system]) in answer.stderr, answer
    (scratch / 'os-release').write_text('ID=other\n')
    answer = run(PATH=str(bare), OS_RELEASE=str(scratch / 'os-release'), CONDA_PREFIX='/opt/conda')
    assert ' '.join(names['conda']) in answer.stderr, answer
    answer = run(PATH=str(bare), OS_RELEASE=str(scratch / 'os-release'), CONDA_PREFIX='')
    assert answer.returncode == 0 and 'Ceres Solver 2.1' in answer.stderr, answer
    shutil.rmtree(scratch)
    print(', '.join(f'{system}: {len(names[system])} packages' for system in TOOLS))


if __name__ == '__main__':
    main(pathlib.Path(sys.argv[1]))
