#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Fails if a page of the site would fetch anything from another host, or links to
a file or an anchor that does not exist: check_site.py FOLDER
"""
import html.parser
import pathlib
import re
import sys
import urllib.parse

# What a browser fetches by itself. Links to click may lead to other hosts.
FETCHED = {'script': 'src', 'img': 'src', 'iframe': 'src', 'source': 'src', 'embed': 'src',
           'object': 'data', 'link': 'href'}
NOT_FETCHED = {'canonical', 'prev', 'next'}


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.fetched, self.links, self.names = [], [], set()
        self.feed(path.read_text(encoding='utf-8'))

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.names.update(attrs[key] for key in ('id', 'name') if attrs.get(key))
        if tag == 'a' and attrs.get('href'):
            self.links.append(attrs['href'])
        url = attrs.get(FETCHED.get(tag, ''))
        if url and attrs.get('rel') not in NOT_FETCHED:
            self.fetched.append(url)


def is_elsewhere(url):
    return bool(urllib.parse.urlsplit(url).netloc)


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    pages = {path: Page(path) for path in folder.rglob('*.html')}
    errors = []
    for path, page in pages.items():
        where = path.relative_to(folder)
        errors += [f'{where} fetches {url}' for url in page.fetched if is_elsewhere(url)]
        for url in page.links + page.fetched:
            parts = urllib.parse.urlsplit(url)
            if parts.scheme or parts.netloc or where.name == '404.html':
                continue
            target = path
            if parts.path:
                target = (path.parent / urllib.parse.unquote(parts.path)).resolve()
            if target.is_dir():
                target /= 'index.html'
            name = urllib.parse.unquote(parts.fragment)
            if not target.exists():
                errors.append(f'{where} links to {url}, which does not exist')
            elif (name and target in pages and name not in pages[target].names
                  and name != 'nested-classes'):  # Doxygen 1.9.4 does not list private ones.
                errors.append(f'{where} links to {url}, which has no such anchor')
    for path in folder.rglob('*.css'):
        for url in re.findall(r'(?:url\(|@import\s)\s*["\']?([^"\')\s]+)', path.read_text(encoding='utf-8')):
            if is_elsewhere(url):
                errors.append(f'{path.relative_to(folder)} fetches {url}')
    print('\n'.join(sorted(set(errors))), file=sys.stderr, end='\n' if errors else '')
    if not pages:
        sys.exit(f'check_site.py: {folder} contains no pages')
    sys.exit(1 if errors else 0)


if __name__ == '__main__':
    main()
