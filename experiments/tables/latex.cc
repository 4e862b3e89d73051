// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/tables/latex.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <vector>

namespace quatro {
namespace {

constexpr std::string_view kGroupMark = " / ";
constexpr std::string_view kQuotedMark = "\\textdagger";
// The number of columns up to which a table keeps its size, and up to which it
// fits into one column of the page.
constexpr std::size_t kFewColumns = 6;
constexpr std::size_t kMostColumns = 8;
constexpr std::string_view kFileMark = "\\textdaggerdbl";

bool IsDigit(char c) { return c >= '0' && c <= '9'; }
bool IsLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)); }

std::string GroupOf(const std::string& column) {
  const std::size_t at = column.find(kGroupMark);
  return at == std::string::npos ? "" : column.substr(0, at);
}

std::string NameInGroup(const std::string& column) {
  const std::size_t at = column.find(kGroupMark);
  return at == std::string::npos ? column
                                 : column.substr(at + kGroupMark.size());
}

// Formats t_avg as t with a subscript.
std::string Header(const std::string& name) {
  if (name.size() < 3 || name[1] != '_' || !IsLetter(name[0])) {
    return EscapeLatex(name);
  }
  std::size_t end = 2;
  while (end < name.size() && IsLetter(name[end])) ++end;
  return std::string("$") + name[0] + "_{\\mathrm{" + name.substr(2, end - 2) +
         "}}$" + EscapeLatex(name.substr(end));
}

// Breaks a header into two lines at the space closest to the middle that does
// not follow a number.
std::string Stacked(const std::string& name) {
  std::size_t best = std::string::npos;
  const auto off = [&](std::size_t at) {
    return 2 * at > name.size() ? 2 * at - name.size() : name.size() - 2 * at;
  };
  for (std::size_t at = name.find(' '); at != std::string::npos;
       at = name.find(' ', at + 1)) {
    if (at > 0 && IsDigit(name[at - 1])) continue;
    if (best == std::string::npos || off(at) < off(best)) best = at;
  }
  if (best == std::string::npos) return Header(name);
  return "\\shortstack[r]{" + Header(name.substr(0, best)) + "\\\\" +
         EscapeLatex(name.substr(best + 1)) + "}";
}

std::string Cell(const std::string& cell) {
  return cell.empty() || cell == "-" ? "--" : EscapeLatex(cell);
}

std::string Joined(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    if (&cell != &cells.front()) line += " & ";
    line += cell;
  }
  return line + " \\\\\n";
}

// The line of groups and the rules below it. Columns count from 1.
std::string GroupLines(const std::vector<std::string>& columns) {
  std::vector<std::string> cells;
  std::string rules;
  for (std::size_t i = 0, end = 0; i < columns.size(); i = end) {
    const std::string group = GroupOf(columns[i]);
    for (end = i + 1; end < columns.size(); ++end) {
      if (group.empty() || GroupOf(columns[end]) != group) break;
    }
    if (group.empty()) {
      cells.emplace_back();
      continue;
    }
    cells.push_back("\\multicolumn{" + std::to_string(end - i) + "}{c}{" +
                    EscapeLatex(group) + "}");
    rules += "\\cmidrule(lr){" + std::to_string(i + 1) + "-" +
             std::to_string(end) + "}";
  }
  return rules.empty() ? "" : Joined(cells) + rules + "\n";
}

}  // namespace

std::string EscapeLatex(std::string_view text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    switch (c) {
      case '\\':
        escaped += "\\textbackslash{}";
        break;
      case '~':
        escaped += "\\textasciitilde{}";
        break;
      case '^':
        escaped += "\\textasciicircum{}";
        break;
      case '<':
        escaped += "\\textless{}";
        break;
      case '>':
        escaped += "\\textgreater{}";
        break;
      case '|':
        escaped += "\\textbar{}";
        break;
      case '"':
        escaped += "\\textquotedbl{}";
        break;
      case '&':
      case '%':
      case '$':
      case '#':
      case '_':
      case '{':
      case '}':
        escaped += '\\';
        escaped += c;
        break;
      case '\n':
      case '\r':
        escaped += ' ';
        break;
      case '-':
        escaped += i > 0 && i + 1 < text.size() && IsDigit(text[i - 1]) &&
                           IsDigit(text[i + 1])
                       ? "--"
                       : "-";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string FormatLatex(const Table& table, const LatexOptions& options) {
  std::vector<std::string> columns = table.columns;
  const auto origin = std::find(columns.begin(), columns.end(), "origin");
  const bool has_origin = origin != columns.end();
  const auto at = origin - columns.begin();
  if (has_origin) columns.erase(origin);

  const bool is_fitted = columns.size() > kFewColumns;
  std::vector<std::string> names;
  for (const std::string& column : columns) {
    const std::string name = NameInGroup(column);
    names.push_back(is_fitted ? Stacked(name) : Header(name));
  }
  std::string body;
  bool has_quoted = false;
  bool has_file = false;
  for (std::vector<std::string> row : table.rows) {
    std::string mark;
    if (has_origin) {
      const std::string text = row[static_cast<std::size_t>(at)];
      row.erase(row.begin() + at);
      if (text == "quoted") mark = kQuotedMark;
      if (text == "file") mark = kFileMark;
      has_quoted = has_quoted || text == "quoted";
      has_file = has_file || text == "file";
    }
    for (std::string& cell : row) cell = Cell(cell);
    if (!row.empty() && !mark.empty()) row[0] += "\\," + mark;
    body += Joined(row);
  }

  const std::string place = columns.size() > kMostColumns ? "table*" : "table";
  std::string latex = "\\begin{" + place + "}\n\\centering\n";
  if (!options.caption.empty()) {
    latex += "\\caption{" + EscapeLatex(options.caption) + "}\n";
  }
  if (!options.label.empty()) latex += "\\label{" + options.label + "}\n";
  if (!options.caption.empty()) latex += "\\smallskip\n";
  if (is_fitted) {
    latex +=
        "\\footnotesize\\setlength{\\tabcolsep}{3pt}\n"
        "\\resizebox{\\ifdim\\width>\\linewidth\\linewidth\\else\\width\\fi}"
        "{!}{%\n";
  }
  latex += "\\begin{tabular}{l" +
           std::string(columns.empty() ? 0 : columns.size() - 1, 'r') +
           "}\n\\toprule\n" + GroupLines(columns) + Joined(names) +
           "\\midrule\n" + body + "\\bottomrule\n\\end{tabular}" +
           (is_fitted ? "}\n" : "\n");
  if (has_quoted) {
    latex += "\\par\\smallskip\\footnotesize " + std::string(kQuotedMark) +
             "\\," + EscapeLatex(options.quoted_note) + "\n";
  }
  if (has_file) {
    latex += "\\par\\smallskip\\footnotesize " + std::string(kFileMark) +
             "\\,From a file of poses, written by another program.\n";
  }
  return latex + "\\end{" + place + "}\n";
}

}  // namespace quatro
