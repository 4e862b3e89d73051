#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Copies the pages of the guide to the folder that mkdocs reads: assemble.py FOLDER

In the repository, pages link to headers, pictures and sections of README.md. On
the site, a link to a header leads to its page of the reference, pictures are in
a folder beside the pages, and `<!-- README: Results -->` is replaced by the
section of README.md with that title, so that no text is kept twice.
"""
import pathlib
import re
import shutil
import sys

DOCS = pathlib.Path(__file__).resolve().parent
ROOT = DOCS.parent


def section(title):
    """Returns a section of README.md without its title, with links as from docs/."""
    found = re.search(rf'^## {re.escape(title)}\n(.*?)(?=^## |\Z)', (ROOT / 'README.md').read_text(),
                      re.M | re.S)
    if not found:
        sys.exit(f'assemble.py: README.md has no section {title}')
    text = found.group(1).replace('](docs/', '](')
    return re.sub(r'\]\((?=(features|solvers|robust|experiments)/)', '](../', text).strip()


def reference_page(header):
    """Returns the name that Doxygen gives the page of a header."""
    return 'api/' + header.name.replace('_', '__').replace('.', '_8') + '.html'


def for_site(text, folder):
    text = re.sub(r'<!-- README: (.*?) -->.*?<!-- end -->', lambda match: section(match.group(1)),
                  text, flags=re.S)

    def link(match):
        path = ROOT / match.group(1)
        if not path.exists():
            sys.exit(f'assemble.py: {match.group(1)} does not exist')
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
