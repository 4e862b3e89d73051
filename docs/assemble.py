#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Puts the guide's pages where mkdocs reads them: assemble.py FOLDER

In the repository pages link to headers, pictures and README's sections, as
anyone reads them there. On the site a header is its page of the reference, a
picture is beside the pages, and `<!-- README: Fidelity -->` is README's section
of that title, so that nothing has to be said twice.
"""
import pathlib
import re
import shutil
import sys

DOCS = pathlib.Path(__file__).resolve().parent
ROOT = DOCS.parent


def section(title):
    """README's section, without its title; links as from docs/."""
    found = re.search(rf'^## {re.escape(title)}\n(.*?)(?=^## |\Z)', (ROOT / 'README.md').read_text(),
                      re.M | re.S)
    if not found:
        sys.exit(f'assemble.py: README.md has no section {title}')
    text = found.group(1).replace('](docs/', '](')
    return re.sub(r'\]\((?=(features|solvers|robust|experiments)/)', '](../', text).strip()


def reference_page(header):
    """What Doxygen calls the page of a header."""
    return 'api/' + header.name.replace('_', '__').replace('.', '_8') + '.html'


def for_site(text, folder):
    text = re.sub(r'<!-- README: (.*?) -->.*?<!-- end -->', lambda match: section(match.group(1)),
                  text, flags=re.S)

    def link(match):
        path = ROOT / match.group(1)
        if not path.exists():
            sys.exit(f'assemble.py: no {match.group(1)}')
        if path.suffix == '.h':
            return f']({reference_page(path)})'
        if path.suffix == '.png':
            (folder / 'pictures').mkdir(exist_ok=True)
            shutil.copy(path, folder / 'pictures')
            return f'](pictures/{path.name})'
        sys.exit(f'assemble.py: {match.group(1)} is not on the site')

    return re.sub(r'\]\(\.\./([^)#]+)\)', link, text)


def main():
    folder = pathlib.Path(sys.argv[1])
    for page in sorted(DOCS.glob('*.md')):
        (folder / page.name).write_text(for_site(page.read_text(), folder))
    for name in ('mathjax.js', 'site.css'):
        shutil.copy(DOCS / name, folder)


if __name__ == '__main__':
    main()
