#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Lets Doxygen read plain comments: prints a header with // as /// or ///<.

A comment counts where it opens the file, stands right above a declaration, or
ends its line. It holds for all functions that are declared one right below the
other. Comments in bodies stay as they are, and so does every line number.
"""
import re
import sys

# Braces behind these hold declarations, others hold statements.
SCOPE = re.compile(r'\b(namespace|struct|class|enum|union)\b[^()=]*$|\bextern "C"\s*$')
COMMENT = re.compile(r'^(\s*)//(?!/)(.*)$')
TRAILING = re.compile(r'^(\s*\S.*?[;,]|\s*k\w+)\s+//(?!/) ?(.*)$')


def escape(text):
    """Text for Doxygen; three spaces more than the rest are an equation."""
    if text.startswith('   '):
        return '     ' + text
    parts = text.split('`')
    parts[::2] = [re.sub(r'([\\@<>#%&$])', r'\\\1', part) for part in parts[::2]]
    return '`'.join(parts)


# What several types have by contract, said once.
CONTRACTS = {
    # Subproblem, robust/gnc/gnc.h.
    'Estimate': 'What is estimated.',
    'NumMeasurements': 'How many there are to be weighted.',
    'Identity': 'The estimate before any data.',
    'Solve': 'Weighted least squares; nullopt if the weights leave it undetermined.',
    'SquaredResiduals': 'Squared residuals over the squared noise bound: an inlier has no more than 1.',
    # Surrogate, robust/gnc/surrogate.h, where r2 is such a residual.
    'InitialMu': 'The mu to begin with, from the largest r2.',
    'NextMu': 'The mu of the next iteration.',
    'IsExact': 'Whether the surrogate is the loss itself.',
    'WeightSlope': 'The derivative of the weight by r2.',
    'Weight': 'The weight at r2: the derivative of the surrogate.',
    'OutlierProcess': 'What a weight w costs: the surrogate is the least of w r2 plus this.',
    'Loss': 'The surrogate at r2.',
    # Rows of a file, features/io/ply_rows.h.
    'MaxNumRows': 'An upper bound of the rows that are left.',
    'BeginRow': 'Goes to the next row.',
    'TakeLength': 'Takes the length of a list.',
    'Take': 'Takes a number.',
    'Skip': 'Passes over so many numbers.',
    'EndRow': 'Whether the row ends here.',
    # Allocators.
    'value_type': 'As std::allocator_traits asks for it.',
    'allocate': 'As std::allocator_traits asks for it.',
    'deallocate': 'As std::allocator_traits asks for it.',
    'construct': 'As std::allocator_traits asks for it.',
    'operator==': 'Whether two are alike.',
    # Cost functions and manifolds as Ceres wants them.
    'CostFunction': 'With derivatives by Ceres.',
    'Manifold': 'On which the rotation moves.',
    'Rotate': 'The point turned by r.',
    'Perturb': 'r turned on by delta.',
    'Evaluate': 'As Ceres asks for it.',
    'operator()': 'The residual at rotation r and translation t.',
    'Plus': 'x moved on by delta.',
    'Minus': 'The delta from x to y.',
    # Summaries.
    'IsUsable': 'Whether there is an answer; not whether it is right.',
}


def contract_of(line):
    """The comment of a member that is known by its name, or nothing."""
    name = re.match(r'\s*(?:using (\w+) =|(?!return|typedef)[\w:<>,&\*\[\] ]*?\b(operator(?:\(\)|==)|\w+)\()', line)
    text = CONTRACTS.get((name.group(1) or name.group(2)) if name else '')
    return f'/** {text} */ ' if text else ''


class Scopes:
    """Where in the braces and brackets a line begins."""

    def __init__(self):
        self.declares = [True]
        self.parens = 0
        self.head = ''

    def read(self, code):
        code = re.sub(r'^\s*(public|protected|private):', '', code)
        for char in code:
            if char == '{':
                self.declares.append(self.declares[-1] and bool(SCOPE.search(self.head)))
                self.head = ''
            elif char == '}':
                self.declares.pop()
                self.head = ''
            elif char == ';' and self.parens == 0:
                self.head = ''
            else:
                self.parens += {'(': 1, ')': -1}.get(char, 0)
                self.head += char
        self.head += ' '

    def is_between_declarations(self):
        return self.declares[-1] and self.parens == 0 and not self.head.strip()

    def holds_declarations(self):
        return self.declares[-1] and self.parens == 0


def code_of(line):
    """The line without strings, comments and preprocessor."""
    if line.lstrip().startswith('#'):
        return ''
    line = re.sub(r'"(\\.|[^"\\])*"|\'(\\.|[^\'\\])\'', '""', line)
    return re.sub(r'//.*', '', line)


def is_attached(lines, i):
    """Whether the comment at line i stands right above something."""
    while i < len(lines) and COMMENT.match(lines[i]):
        i += 1
    return i < len(lines) and lines[i].strip() not in ('', '}', '};')


def convert(lines):
    scopes = Scopes()
    in_file_comment = True
    above = []           # The comment of the declarations at hand.
    trailing_column = -1  # Of the comment that ended the line before.
    of_compounds = []    # Those of what is open.
    begins_anew = False
    for i, line in enumerate(lines):
        comment = COMMENT.match(line)
        if in_file_comment:
            in_file_comment = bool(comment)
            if comment:
                spdx = comment.group(2).startswith(' SPDX')
                text = comment.group(2)
                if text.endswith(',') and lines[i + 1] == '//':
                    text = text[:-1] + ':'  # An equation follows; Doxygen would add a full stop.
                yield '/// \\file' if i == 0 else '///' if spdx else '///' + escape(text)
                continue
        if comment and scopes.holds_declarations():
            if len(comment.group(1)) == trailing_column:
                yield comment.group(1) + '///<' + escape(comment.group(2))
            elif is_attached(lines, i):
                above = (above if begins_anew else []) + [escape(comment.group(2))]
                begins_anew = True
                yield comment.group(1) + '///' + escape(comment.group(2))
            else:
                yield line
            continue
        between = scopes.is_between_declarations()
        if between and not begins_anew and not code_of(lines[i - 1]).rstrip().endswith(';'):
            above = []
        text = line
        trailing = TRAILING.match(line)
        trailing_column = -1
        if trailing and scopes.holds_declarations():
            text = trailing.group(1) + '  ///< ' + escape(trailing.group(2))
            trailing_column = line.index('//')
        elif above and between and not begins_anew and re.search(r'\(|^\s*using ', line):
            text = '/**' + ' '.join(above) + ' */ ' + text
        elif between and not above:
            named = lines[i + 1] if line.strip().startswith('template') else line
            text = contract_of(named) + text
        begins_anew = False
        yield text
        depth = len(scopes.declares)
        scopes.read(code_of(line))
        if len(scopes.declares) > depth:
            of_compounds.append(above)
        elif len(scopes.declares) < depth and of_compounds:
            above = of_compounds.pop()  # Holds for what is declared right below it, too.


if __name__ == '__main__':
    with open(sys.argv[1], encoding='utf-8') as header:
        print('\n'.join(convert(header.read().split('\n'))))
