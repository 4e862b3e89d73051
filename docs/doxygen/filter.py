#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The quatro authors
# SPDX-License-Identifier: MIT
"""Prints a header with its // comments as /// or ///<, so that Doxygen reads them.

A comment is converted if it opens the file, is right above a declaration, or
ends the line of one. It applies to all functions declared without a blank line
between them. Comments in function bodies and line numbers do not change.
"""
import re
import sys

# Braces after these contain declarations, other braces contain statements.
SCOPE = re.compile(r'\b(namespace|struct|class|enum|union)\b[^()=]*$|\bextern "C"\s*$')
COMMENT = re.compile(r'^(\s*)//(?!/)(.*)$')
TRAILING = re.compile(r'^(\s*\S.*?[;,]|\s*k\w+)\s+//(?!/) ?(.*)$')


def escape(text):
    """Escapes text for Doxygen; text indented by three more spaces is an equation."""
    if text.startswith('   '):
        return '     ' + text
    parts = text.split('`')
    parts[::2] = [re.sub(r'([\\@<>#%&$])', r'\\\1', part) for part in parts[::2]]
    return '`'.join(parts)


# Comments of members that several types have by contract.
CONTRACTS = {
    # Subproblem, robust/gnc/gnc.h.
    'Estimate': 'The type of the estimate.',
    'NumMeasurements': 'The number of measurements that get a weight.',
    'Identity': 'The estimate before any data.',
    'Solve': 'Weighted least squares; nullopt if the weights leave it undetermined.',
    'SquaredResiduals': 'Squared residuals over the squared noise bound: at most 1 for an inlier.',
    # Surrogate, robust/gnc/surrogate.h; r2 is such a squared residual.
    'InitialMu': 'The initial mu, from the largest r2.',
    'NextMu': 'The mu of the next iteration.',
    'IsExact': 'Whether the surrogate equals the loss.',
    'WeightSlope': 'The derivative of the weight with respect to r2.',
    'Weight': 'The weight at r2: the derivative of the surrogate.',
    'OutlierProcess': 'The penalty of a weight w: the surrogate is the minimum over w of w r2 plus this.',
    'Loss': 'The surrogate at r2.',
    # Readers of rows, features/io/ply_rows.h.
    'MaxNumRows': 'An upper bound on the number of remaining rows.',
    'BeginRow': 'Moves to the next row.',
    'TakeLength': 'Reads the length of a list.',
    'Take': 'Reads a number.',
    'Skip': 'Skips this many numbers.',
    'EndRow': 'Whether the row ends here.',
    # Allocators.
    'value_type': 'Required by std::allocator_traits.',
    'allocate': 'Required by std::allocator_traits.',
    'deallocate': 'Required by std::allocator_traits.',
    'construct': 'Required by std::allocator_traits.',
    'operator==': 'Whether two allocators are equal.',
    # Cost functions and manifolds in the form that Ceres requires.
    'CostFunction': 'The cost function, differentiated by Ceres.',
    'Manifold': 'The manifold of the rotation.',
    'Rotate': 'The point rotated by r.',
    'Perturb': 'r rotated further by delta.',
    'Evaluate': 'Required by Ceres.',
    'operator()': 'The residual at rotation r and translation t.',
    'Plus': 'x moved by delta.',
    'Minus': 'The delta from x to y.',
    # Summaries.
    'IsUsable': 'Whether there is a result; this does not say whether it is correct.',
}


def contract_of(line):
    """Returns the comment of a member whose name is in CONTRACTS, or nothing."""
    name = re.match(r'\s*(?:using (\w+) =|(?!return|typedef)[\w:<>,&\*\[\] ]*?\b(operator(?:\(\)|==)|\w+)\()', line)
    text = CONTRACTS.get((name.group(1) or name.group(2)) if name else '')
    return f'/** {text} */ ' if text else ''


class Scopes:
    """Tracks the braces and parentheses that are open at the start of a line."""

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
    """Returns the line without strings, comments and preprocessor directives."""
    if line.lstrip().startswith('#'):
        return ''
    line = re.sub(r'"(\\.|[^"\\])*"|\'(\\.|[^\'\\])\'', '""', line)
    return re.sub(r'//.*', '', line)


def is_attached(lines, i):
    """Returns whether the comment at line i is right above a declaration."""
    while i < len(lines) and COMMENT.match(lines[i]):
        i += 1
    return i < len(lines) and lines[i].strip() not in ('', '}', '};')


def convert(lines):
    scopes = Scopes()
    in_file_comment = True
    above = []            # The comment of the current declarations.
    trailing_column = -1  # Column of the comment at the end of the previous line.
    of_compounds = []     # The comments of the open classes and namespaces.
    begins_anew = False
    for i, line in enumerate(lines):
        comment = COMMENT.match(line)
        if in_file_comment:
            in_file_comment = bool(comment)
            if comment:
                spdx = comment.group(2).startswith(' SPDX')
                text = comment.group(2)
                if text.endswith(',') and lines[i + 1] == '//':
                    text = text[:-1] + ':'  # An equation follows; Doxygen would add a period.
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
            above = of_compounds.pop()  # The comment also applies to the next declaration.


if __name__ == '__main__':
    with open(sys.argv[1], encoding='utf-8') as header:
        print('\n'.join(convert(header.read().split('\n'))))
