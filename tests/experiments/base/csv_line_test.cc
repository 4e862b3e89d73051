// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/base/csv_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "features/base/random.h"

namespace quatro::csv_line_test {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;

TEST(CsvLine, QuotesOnlyWhatNeedsIt) {
  EXPECT_EQ(JoinCsvLine({"a", "b c", ""}), "a,b c,");
  EXPECT_EQ(JoinCsvLine({"1,2", "say \"so\""}), "\"1,2\",\"say \"\"so\"\"\"");
  EXPECT_EQ(QuoteCsvCell("two\nlines"), "two lines");
}

TEST(CsvLine, SplitsAtCommasOutsideQuotes) {
  EXPECT_THAT(SplitCsvLine("a,\"1,2\",\"\"\"\",,c"),
              Optional(ElementsAre("a", "1,2", "\"", "", "c")));
  EXPECT_THAT(SplitCsvLine(""), Optional(ElementsAre("")));
  EXPECT_THAT(SplitCsvLine(","), Optional(ElementsAre("", "")));
  EXPECT_THAT(SplitCsvLine("\"\""), Optional(ElementsAre("")));
}

TEST(CsvLine, RefusesQuotesThatEncloseNoCell) {
  for (const char* const line :
       {"\"a", "a\"b", "\"a\"b", "\"a\" ,b", "a,\"", "\"\"\""}) {
    EXPECT_FALSE(SplitCsvLine(line)) << line;
  }
}

TEST(CsvLine, AnyCellsComeBack) {
  Random random(1);
  for (int round = 0; round < 500; ++round) {
    std::vector<std::string> cells(1 + random.Below(4));
    for (std::string& cell : cells) {
      for (std::uint64_t n = random.Below(5); n > 0; --n) {
        cell += "ab,\" ;"[random.Below(6)];
      }
    }
    EXPECT_THAT(SplitCsvLine(JoinCsvLine(cells)), Optional(cells));
  }
}

}  // namespace
}  // namespace quatro::csv_line_test
