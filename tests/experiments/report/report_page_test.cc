// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/report/report_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "experiments/report/report_template.h"
#include "tests/support/pair_results.h"

namespace quatro::report_page_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr char kTemplate[] =
    "<title>@@QUATRO_TITLE@@</title>[[@@QUATRO_DATA@@]]\n@@QUATRO_VIEWS@@end";
constexpr char kEvil[] = "</script><!--<b>&\"'\n\xff@@QUATRO_VIEWS@@";

std::string Between(const std::string& text,
                    const std::string& before,
                    const std::string& after) {
  const std::size_t begin = text.find(before);
  EXPECT_NE(begin, std::string::npos) << before;
  const std::size_t end = text.find(after, begin);
  EXPECT_NE(end, std::string::npos) << after;
  return text.substr(begin + before.size(), end - begin - before.size());
}

nlohmann::json DataOf(const std::string& page) {
  return nlohmann::json::parse(Between(page, "[[{", "}]]\n").insert(0, "{") +
                               "}");
}

ReportPage SmallPage() {
  ReportPage page;
  page.title = "run";
  page.results = {ResultOff("quatro", "a", 0.123456789, 1.0),
                  ResultWithoutAnswer("quatro", "b")};
  page.tables = MakeRunTables(page.results, TableOptions());
  page.views = {{"a", R"({"pair":"a"})"}, {"b", R"({"pair":"b"})"}};
  return page;
}

TEST(ReportPage, FillsTheTemplate) {
  const std::string page = FormatReportPage(SmallPage(), kTemplate);
  EXPECT_THAT(page, StartsWith("<title>run</title>[[{"));
  EXPECT_TRUE(page.ends_with("end"));
  EXPECT_THAT(page, Not(HasSubstr("@@")));
  const auto data = DataOf(page);
  EXPECT_EQ(data["pairs"]["rows"].size(), 2u);
  EXPECT_EQ(data["pairs"]["columns"].size(), data["pairs"]["rows"][0].size());
  EXPECT_EQ(data["pairs"]["rows"][0][5], 0.123457);
  EXPECT_TRUE(data["pairs"]["rows"][1][5].is_null());
  EXPECT_EQ(data["limits"][0]["rotation_deg"], 10.0);
  EXPECT_EQ(data["views"], (nlohmann::json{{"a", 0}, {"b", 1}}));
  EXPECT_TRUE(data["notes"].empty());
  EXPECT_EQ(Between(page, "id=\"view-1\">", "</script>"), R"({"pair":"b"})");
}

TEST(ReportPage, TextOfDataIsNoHtml) {
  ReportPage report = SmallPage();
  report.title = kEvil;
  report.results[0].pair = report.results[0].set = kEvil;
  report.manifest.flags[kEvil] = kEvil;
  report.tables = MakeRunTables(report.results, TableOptions());
  report.views = {{kEvil, R"({"pair":"</script><!--"})"}};
  report.figures = {{kEvil, "png"}};
  const std::string page = FormatReportPage(report, kTemplate);
  // The ends of the title and of the only view.
  std::size_t num_tags = 0;
  for (std::size_t at = page.find('<'); at != std::string::npos;
       at = page.find('<', at + 1)) {
    ++num_tags;
  }
  EXPECT_EQ(num_tags, 4u) << page;
  const auto data = DataOf(page);
  const std::string name = data["pairs"]["rows"][0][0];
  EXPECT_THAT(name, StartsWith("</script><!--<b>&\"'\n"));
  EXPECT_EQ(data["views"].size(), 1u);
  EXPECT_TRUE(data["views"].contains(name));
  EXPECT_EQ(nlohmann::json::parse(
                Between(page, "id=\"view-0\">", "</script>"))["pair"],
            "</script><!--");
}

TEST(ReportPage, StaysWithinItsLimitAndSaysWhatIsLeftOut) {
  ReportPage report = SmallPage();
  for (int i = 0; i < 100; ++i) {
    report.views.push_back(
        {std::to_string(i), "\"" + std::string(10'000, 'x') + "\""});
  }
  const std::string page =
      FormatReportPage(report, kTemplate, {.max_bytes = 300'000});
  EXPECT_LE(page.size(), 300'000u);
  EXPECT_GT(page.size(), 270'000u);
  const auto data = DataOf(page);
  const std::size_t num_views = data["views"].size();
  ASSERT_GT(num_views, 10u);
  ASSERT_EQ(data["notes"].size(), 1u);
  EXPECT_THAT(data["notes"][0].get<std::string>(),
              HasSubstr(std::to_string(num_views) + " of 102 stored 3D views"));
  const auto few_rows =
      DataOf(FormatReportPage(SmallPage(), kTemplate, {.max_rows = 1}));
  EXPECT_EQ(few_rows["pairs"]["rows"].size(), 1u);
  EXPECT_THAT(few_rows["notes"][0].get<std::string>(),
              HasSubstr("1 of 2 rows"));
}

TEST(ReportPage, OfNothingIsAPage) {
  const auto data = DataOf(FormatReportPage({}, kTemplate));
  EXPECT_TRUE(data["pairs"]["rows"].empty());
}

}  // namespace
}  // namespace quatro::report_page_test
