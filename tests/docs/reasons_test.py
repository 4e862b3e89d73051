#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Checks that docs/parameters.md lists exactly the reasons that the library and
--explain can give: reasons_test.py

In the page, a reason is text in backquotes in the first column of a table, with
"..." for the parts that vary. In the sources, a reason is a string literal of
three or more words in one of the files below; adjacent literals are joined. All
rejected options ("..., must be > 0") share one row.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCES = ['robust/verdict/verdict.cc', 'robust/estimators/quatro.cc', 'robust/estimators/teaser.cc', 'robust/estimators/fgr.cc',
           'robust/estimators/ransac.cc', 'robust/estimators/arc_consensus.cc', 'robust/estimators/polish.cc', 'robust/registration/refinement.cc',
           'robust/registration/ins.cc', 'robust/estimators/bound_solver.cc', 'robust/estimators/decoupled.cc', 'robust/registration/local_registration.cc', 'robust/gnc/gnc.cc', 'robust/registration/front_end.cc',
           'robust/registration/registration.cc', 'robust/registration/level_registration.cc', 'robust/registration/ladder.cc', 'solvers/closed_form/valid_matches.cc', 'solvers/ceres/pose_covariance.cc',
           'solvers/ceres/observability.cc', 'solvers/local/local_alignment.cc',
           'solvers/local/vgicp.cc', 'features/voxel_grid.cc', 'experiments/programs/explain.cc']
LITERAL = re.compile(r'"((?:\\.|[^"\\])*)"')


def advice_alone(text):
    """Returns the part of explain.cc that gives advice; the rest describes stages."""
    return text[text.index('void AdviseOnMatches'):text.index('return advice;\n}')]


def literals(path):
    text = path.read_text()
    if path.name == 'explain.cc':
        text = advice_alone(text)
    text = re.sub(r'^\s*(//|#).*$', '', text, flags=re.M)
    text = re.sub(r'"\s*\n?\s*"', '', text)  # Adjacent literals are one.
    found = [re.sub(r'\s+', ' ', literal).strip(' ;,') for literal in LITERAL.findall(text)]
    return [literal.split(' %.3g')[0] for literal in found if '%.*f' not in literal]


def is_reason(text):
    return text.count(' ') >= 2 and 'must be' not in text


def reasons_of_the_page():
    page = (ROOT / 'docs/parameters.md').read_text()
    cells = re.findall(r'^\| (`.*?) \| ', page, flags=re.M)
    return [re.sub(r'\s+', ' ', reason) for cell in cells for reason in re.findall(r'`([^`]+)`', cell)
            if is_reason(reason)]


def main():
    said = {literal: name for name in SOURCES for literal in literals(ROOT / name)}
    page = reasons_of_the_page()
    sources = {literal: name for literal, name in said.items() if is_reason(literal)}
    errors = [f'{name}: "{literal}" is not in docs/parameters.md' for literal, name in sources.items()
              if not any(literal in reason for reason in page)]
    longest_first = sorted((literal for literal in said if literal), key=len, reverse=True)
    for reason in page:
        rest = reason
        for literal in longest_first:
            rest = re.sub(rf'(?<!\w){re.escape(literal)}(?!\w)', '', rest)
        if re.search(r'\w', rest):
            errors.append(f'docs/parameters.md: "{reason}": no source contains "{rest.strip()}"')
    if len(sources) < 60 or len(page) < 60:
        errors.append(f'only {len(sources)} reasons in the sources, {len(page)} in the page')
    print('\n'.join(errors), file=sys.stderr, end='\n' if errors else '')
    sys.exit(1 if errors else 0)


if __name__ == '__main__':
    main()
