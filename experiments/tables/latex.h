// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Formats a table for a paper, with the packages booktabs and textcomp. Groups
// of columns get their own rule. The column "origin" becomes a mark after the
// first cell, explained in a line below the table. A table with more than six
// columns has headers of two lines and is scaled to fit, with the package
// graphicx; with more than eight it spans both columns of the page.

#ifndef QUATRO_EXPERIMENTS_TABLES_LATEX_H_
#define QUATRO_EXPERIMENTS_TABLES_LATEX_H_

#include <string>
#include <string_view>

#include "experiments/tables/table.h"

namespace quatro {

// Escapes text so that it prints unchanged, except that a hyphen between digits
// becomes a dash and a line break becomes a space.
std::string EscapeLatex(std::string_view text);

struct LatexOptions {
  std::string caption = {};  // Text, not LaTeX.
  std::string label = {};    // "tab:success"; none if empty.

  // The note for rows whose origin is "quoted".
  std::string quoted_note =
      "Values from the paper, on KITTI; not from this run.";
};

std::string FormatLatex(const Table& table, const LatexOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_LATEX_H_
