// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/tables/latex.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "experiments/base/number_text.h"
#include "experiments/odometry/table_two.h"
#include "features/base/file.h"

namespace quatro::latex_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(EscapeLatex, LeavesNothingThatLatexWouldTake) {
  EXPECT_EQ(EscapeLatex("a_b & 5 % of $3 #1 {x}"),
            "a\\_b \\& 5 \\% of \\$3 \\#1 \\{x\\}");
  EXPECT_EQ(EscapeLatex("\\~^<>|\""),
            "\\textbackslash{}\\textasciitilde{}\\textasciicircum{}"
            "\\textless{}\\textgreater{}\\textbar{}\\textquotedbl{}");
  EXPECT_EQ(EscapeLatex("two\nlines"), "two lines");
}

TEST(EscapeLatex, HyphensBetweenDigitsAreDashes) {
  EXPECT_EQ(EscapeLatex("8-10 m"), "8--10 m");
  EXPECT_EQ(EscapeLatex("VG-ICP -3 4-"), "VG-ICP -3 4-");
}

TEST(FormatLatex, IsATableByHand) {
  const Table table{{"method",
                     "origin",
                     "0-2 m / t_avg m",
                     "0-2 m / r_avg deg",
                     "4-6 m / t_avg m",
                     "rest"},
                    {{"ours_1", "measured", "0.057", "0.2", "", "1"},
                     {"theirs", "quoted", "0.1", "-", "2", "5 %"}}};
  EXPECT_EQ(FormatLatex(table, {.caption = "Errors & more", .label = "tab:x"}),
            R"(\begin{table}
\centering
\caption{Errors \& more}
\label{tab:x}
\smallskip
\begin{tabular}{lrrrr}
\toprule
 & \multicolumn{2}{c}{0--2 m} & \multicolumn{1}{c}{4--6 m} &  \\
\cmidrule(lr){2-3}\cmidrule(lr){4-4}
method & $t_{\mathrm{avg}}$ m & $r_{\mathrm{avg}}$ deg & $t_{\mathrm{avg}}$ m & rest \\
\midrule
ours\_1 & 0.057 & 0.2 & -- & 1 \\
theirs\,\textdagger & 0.1 & -- & 2 & 5 \% \\
\bottomrule
\end{tabular}
\par\smallskip\footnotesize \textdagger\,Values from the paper, on KITTI; not from this run.
\end{table}
)");
}

TEST(FormatLatex, WithoutGroupsQuotesOrLabelHasNoneOfTheirLines) {
  const std::string latex = FormatLatex({{"a", "b"}, {{"1", "2"}}}, {});
  for (const char* const part :
       {"multicolumn", "cmidrule", "textdagger", "caption", "label"}) {
    EXPECT_THAT(latex, Not(HasSubstr(part)));
  }
  EXPECT_THAT(FormatLatex({{}, {}}, {}), HasSubstr("\\begin{tabular}{l}"));
}

TEST(FormatLatex, ManyColumnsAreMadeToFit) {
  Table table{{"method",
               "registered",
               "false registrations",
               "only method correct",
               "all / 2 m 10 deg",
               "all / t_avg m",
               "g",
               "h",
               "i"},
              {std::vector<std::string>(9, "1")}};
  const std::string latex = FormatLatex(table, {});
  EXPECT_THAT(
      latex,
      HasSubstr(
          "method & registered & \\shortstack[r]{false\\\\registrations} & "
          "\\shortstack[r]{only method\\\\correct} & "
          "\\shortstack[r]{2 m\\\\10 deg} & "
          "\\shortstack[r]{$t_{\\mathrm{avg}}$\\\\m} & g & h & i"));
  EXPECT_THAT(latex, HasSubstr("\\end{tabular}}\n\\end{table*}\n"));
  table.columns.resize(8);
  table.rows[0].resize(8);
  EXPECT_THAT(FormatLatex(table, {}),
              HasSubstr("\\end{tabular}}\n\\end{table}\n"));
  table.columns.resize(6);
  table.rows[0].resize(6);
  EXPECT_THAT(FormatLatex(table, {}), Not(HasSubstr("resizebox")));
}

TEST(FormatLatex, NothingQuotedHasNoNote) {
  const Table table{{"a", "origin"}, {{"1", "measured"}}};
  EXPECT_THAT(FormatLatex(table, {}), Not(HasSubstr("KITTI")));
  const Table file{{"a", "origin"}, {{"1", "file"}}};
  EXPECT_THAT(FormatLatex(file, {}), HasSubstr("1\\,\\textdaggerdbl \\\\"));
  EXPECT_THAT(FormatLatex(file, {}), HasSubstr("another program"));
}

// Every line of the body has as many cells as the paper's Table II.
TEST(FormatTableTwoLatex, IsThePapersTable) {
  DriftEntry ours;
  ours.method = "quatro_c2f";
  ours.interval = 3;
  ours.translation_percent = 0.5;
  auto entries = QuotedTableTwo();
  entries.push_back(ours);
  const std::string latex = FormatTableTwoLatex(entries);
  EXPECT_THAT(latex, HasSubstr("\\begin{tabular}{lrrrrrr}"));
  EXPECT_THAT(latex, HasSubstr("\\multicolumn{2}{c}{interval 3}"));
  EXPECT_THAT(latex, HasSubstr("$t_{\\mathrm{rel}}$\\\\\\%"));
  EXPECT_THAT(latex,
              HasSubstr("LO-Net\\,\\textdagger & 1.47 & 0.72 & -- & -- & -- & "
                        "-- \\\\"));
  EXPECT_THAT(latex,
              HasSubstr("quatro\\_c2f & -- & -- & 0.50 & 0.00 & -- & -- \\\\"));
  int num_rows = 0;
  for (const std::string_view line : SplitLines(latex)) {
    if (!line.ends_with("\\\\") || line.find("multicolumn") != line.npos) {
      continue;
    }
    ++num_rows;
    EXPECT_EQ(std::count(line.begin(), line.end(), '&'), 6) << line;
  }
  EXPECT_EQ(num_rows, 1 + 14 + 1);
}

// Narrow, wide, quoted and empty tables, in both document classes.
TEST(FormatLatex, PdflatexTakesItWithoutAnOverfullBox) {
  if (std::system("pdflatex --version >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "needs pdflatex with booktabs (texlive-latex-extra)";
  }
  const Table narrow{{"method", "origin", "a & b / t_avg m"},
                     {{"ours_1", "quoted", "5 %"}, {"theirs", "file", ""}}};
  Table wide{{"method"}, {{"quatro_ins"}}};
  for (const char* const column : {"pairs",
                                   "false registrations",
                                   "success % / 0.6 m 5 deg",
                                   "r median deg"}) {
    for (int i = 0; i < 5; ++i) {
      wide.columns.emplace_back(column);
      wide.rows[0].emplace_back("100.00");
    }
  }
  const auto folder = std::filesystem::path(::testing::TempDir()) /
                      ("latex_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  for (const char* const layout : {"onecolumn", "twocolumn"}) {
    std::string text = "\\documentclass[" + std::string(layout) +
                       "]{article}\n\\usepackage{booktabs,textcomp,graphicx}\n"
                       "\\begin{document}\n";
    for (const std::string& table :
         {FormatLatex(narrow, {.caption = "50 % ~ <x>", .label = "tab:a"}),
          FormatLatex(wide, {.caption = "Wide"}),
          FormatTableTwoLatex(QuotedTableTwo())}) {
      text += table;
    }
    text += "\\end{document}\n";
    std::string error;
    ASSERT_TRUE(WriteFileAtomically((folder / "t.tex").string(), text, &error))
        << error;
    const std::string command =
        "cd '" + folder.string() +
        "' && pdflatex -interaction=nonstopmode -halt-on-error t.tex >log.txt";
    EXPECT_EQ(std::system(command.c_str()), 0) << layout;
    std::ifstream file(folder / "log.txt");
    const std::string log{std::istreambuf_iterator<char>(file), {}};
    EXPECT_THAT(log, HasSubstr("Output written")) << layout;
    EXPECT_THAT(log, Not(HasSubstr("Overfull"))) << layout;
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace quatro::latex_test
