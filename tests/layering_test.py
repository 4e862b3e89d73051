#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Checks who includes whom: fails if a room includes one that does not stand
before it in ROOMS, if files include each other in a circle, if a room has
grown too large, or if a file includes one of ours that does not exist.

  tests/layering_test.py [root of the repository]
"""

import pathlib
import re
import sys

# Each room may include itself and the rooms named after it; a name without a
# slash stands for the whole top-level folder.
ROOMS = {
    'features/base': [],
    'features/io': ['features/base'],
    'features': ['features/base', 'features/io'],
    'solvers/closed_form': ['features'],
    'solvers/ceres': ['features', 'solvers/closed_form'],
    'solvers/local': ['features', 'solvers/closed_form', 'solvers/ceres'],
    'robust/gnc': ['features', 'solvers'],
    'robust/graph': ['features', 'solvers'],
    'robust/estimators': ['features', 'solvers', 'robust/gnc', 'robust/graph'],
    'robust/verdict': ['features', 'solvers', 'robust/estimators'],
    'robust/registration': ['features', 'solvers', 'robust'],
    'experiments': ['features', 'solvers', 'robust'],
    'python': ['features', 'solvers', 'robust'],
}
MADE_BY_CMAKE = {'experiments/runner/commit_text.h'}
MAX_SOURCES_IN_ROOM = 26  # A header and its source count as one.


def room_of(path):
    folder = str(pathlib.PurePosixPath(path).parent)
    while folder not in ROOMS and '/' in folder:
        folder = folder.rsplit('/', 1)[0]
    return folder


def may_include(room, included_room):
    allowed = ROOMS[room] + [room]
    return any(
        included_room == name or
        ('/' not in name and room != name and included_room.startswith(name + '/'))
        for name in allowed)


def includes_of(root, path):
    text = (root / path).read_text(encoding='utf-8')
    return re.findall(r'^#include "((?:features|solvers|robust|experiments|'
                      r'python|tests)/[^"]+)"', text, re.M)


def find_missing(root):
    """One line for each include, in tests too, of a file that does not exist."""
    for top in sorted({name.split('/')[0] for name in ROOMS} | {'tests'}):
        for file in sorted((root / top).rglob('*')):
            if file.suffix not in ('.h', '.cc') or 'node_modules' in file.parts:
                continue
            path = file.relative_to(root).as_posix()
            for included in includes_of(root, path):
                if included not in MADE_BY_CMAKE and not (root / included).exists():
                    yield f'{path}: {included} does not exist'


def find_circle(graph):
    """A list of units that include each other in a circle, or None."""
    done = set()

    def visit(unit, way):
        if unit in way:
            return way[way.index(unit):] + [unit]
        if unit in done:
            return None
        for other in sorted(graph.get(unit, ())):
            circle = visit(other, way + [unit])
            if circle:
                return circle
        done.add(unit)
        return None

    for unit in sorted(graph):
        circle = visit(unit, [])
        if circle:
            return circle
    return None


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else
                        pathlib.Path(__file__).resolve().parents[1])
    problems = list(find_missing(root))
    graph = {}
    sizes = {}
    num_includes = 0
    for top in sorted({name.split('/')[0] for name in ROOMS}):
        for file in sorted((root / top).rglob('*')):
            if file.suffix not in ('.h', '.cc') or 'node_modules' in file.parts:
                continue
            path = file.relative_to(root).as_posix()
            unit = path.rsplit('.', 1)[0]
            sizes.setdefault(str(pathlib.PurePosixPath(path).parent),
                             set()).add(unit)
            graph.setdefault(unit, set())
            for included in includes_of(root, path):
                num_includes += 1
                other = included.rsplit('.', 1)[0]
                if other != unit:
                    graph[unit].add(other)
                if not may_include(room_of(path), room_of(included)):
                    problems.append(f'{path}: may not include {included}')
    circle = find_circle(graph)
    if circle:
        problems.append('include each other in a circle: ' +
                        ' -> '.join(circle))
    for folder, units in sorted(sizes.items()):
        if len(units) > MAX_SOURCES_IN_ROOM:
            problems.append(f'{folder}: {len(units)} files with their headers, '
                            f'at most {MAX_SOURCES_IN_ROOM} are allowed')
    if num_includes == 0:
        problems.append(f'no includes found under {root}')
    print('\n'.join(problems) or f'{num_includes} includes are in order')
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())
