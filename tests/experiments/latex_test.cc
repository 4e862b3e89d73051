// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/tables/latex.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "experiments/number_text.h"
#include "experiments/odometry/table_two.h"

namespace quatro {
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
\par\smallskip\footnotesize \textdagger\,Figures of the paper, on KITTI; not of this run.
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

TEST(FormatLatex, NothingQuotedHasNoNote) {
  const Table table{{"a", "origin"}, {{"1", "measured"}}};
  EXPECT_THAT(FormatLatex(table, {}), Not(HasSubstr("KITTI")));
  const Table file{{"a", "origin"}, {{"1", "file"}}};
  EXPECT_THAT(FormatLatex(file, {}), HasSubstr("1\\,\\textdaggerdbl \\\\"));
  EXPECT_THAT(FormatLatex(file, {}), HasSubstr("another program"));
}

// Every line of the body has as many cells as the paper's Table II has.
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
  EXPECT_THAT(latex, HasSubstr("$t_{\\mathrm{rel}}$ \\%"));
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

}  // namespace
}  // namespace quatro
