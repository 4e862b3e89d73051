#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Lists pairs of scans of different places, from a list of pairs of the same place.

    list_wrong_pairs.py --pairs=pairs.csv --output=wrong.csv [--same=SET,SET ...]

Scans that pairs connect, directly or through others, belong to the same place; so do
all scans of the sets that --same names. For any two places, --each pairs are listed,
spread evenly over their scans and without a pose: every registration of them is false.
The list is input of run_pairs.py and contains absolute paths.

Exit code: 0; 2 if a flag or a file is invalid, with one line that says which.
"""
import csv
import io
import itertools
import pathlib

from run_pairs import read_pairs, scans_of
from script_support import (BadInput, Parser, check_writable, run_script, summary_stream,
                            write_atomically)


def find_places(pairs, same):
    """Lists of scans, one list per place, in the order of the pairs."""
    place = {}

    def root(scan):
        while place[scan] != scan:
            scan = place[scan]
        return scan

    def join(a, b):
        place[max(root(a), root(b))] = min(root(a), root(b))

    first_of_group = {}
    for pair in pairs:
        for scan in (pair.source, pair.target):
            place.setdefault(scan, scan)
        join(pair.source, pair.target)
        for k, group in enumerate(same):
            if pair.set in group:
                join(first_of_group.setdefault(k, pair.source), pair.source)
    places = {}
    for scan in place:
        places.setdefault(root(scan), []).append(scan)
    return list(places.values())


def main(args):
    parser = Parser(__doc__)
    parser.add_argument("--pairs", metavar="FILE.csv", required=True, help="the list of pairs")
    parser.add_argument("--output", metavar="FILE.csv", required=True, help="the list to write")
    parser.add_argument("--exclude", action="append", default=[], metavar="SET",
                        help="leave out this set; may be repeated")
    parser.add_argument("--same", action="append", default=[], metavar="SET,SET",
                        help="sets of the same place; may be repeated")
    parser.add_argument("--each", type=int, default=3, metavar="N",
                        help="pairs for any two places (default: 3)")
    options = parser.parse_args(args)
    if options.each < 1:
        raise BadInput(f"--each={options.each}: must be > 0")
    check_writable(options.output, [options.pairs])
    pairs = read_pairs(options.pairs, options.exclude)
    check_writable(options.output, scans_of(pairs, options.pairs))
    same = [group.split(",") for group in options.same]
    unknown = {name for group in same for name in group} - {pair.set for pair in pairs}
    unknown -= set(options.exclude)
    if unknown:
        raise BadInput(f"--same={min(unknown)}: {options.pairs} has no such set")
    places = find_places(pairs, same)
    folder = pathlib.Path(options.pairs).resolve().parent
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("set", "source", "target"))
    for a, b in itertools.combinations(places, 2):
        scans = list(itertools.product(a, b))
        num_listed = min(options.each, len(scans))
        for k in range(num_listed):
            source, target = scans[k * len(scans) // num_listed]
            writer.writerow(("different places", folder / source, folder / target))
    write_atomically(options.output, text.getvalue())
    print(f"{len(places)} places, {text.getvalue().count(chr(10)) - 1} pairs",
          file=summary_stream(options.output))


if __name__ == "__main__":
    run_script(main)
