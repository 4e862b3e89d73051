// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A table for a paper, with the packages booktabs and textcomp. Groups of
// columns get a rule of their own; the column "origin" becomes a mark after the
// first cell and a line under the table that says what it means. More than
// six columns have headers of two lines and are made smaller to fit, with the
// package graphicx; more than eight are over both columns of a page.

#ifndef QUATRO_EXPERIMENTS_TABLES_LATEX_H_
#define QUATRO_EXPERIMENTS_TABLES_LATEX_H_

#include <string>
#include <string_view>

#include "experiments/tables/table.h"

namespace quatro {

// Text that prints as it is, but for a hyphen between digits, which becomes a
// dash, and line breaks, which become blanks.
std::string EscapeLatex(std::string_view text);

struct LatexOptions {
  std::string caption = {};  // Text, not LaTeX.
  std::string label = {};    // "tab:success"; none if empty.

  // Of rows whose origin is "quoted".
  std::string quoted_note = "Figures of the paper, on KITTI; not of this run.";
};

std::string FormatLatex(const Table& table, const LatexOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_LATEX_H_
