// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Tables of results whose values are known by hand.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "experiments/metrics/paired_test.h"
#include "experiments/tables/curve_tables.h"
#include "experiments/tables/error_table.h"
#include "experiments/tables/run_tables.h"
#include "experiments/tables/success_table.h"
#include "experiments/tables/summary_table.h"
#include "experiments/tables/timing_table.h"
#include "features/base/degree.h"
#include "tests/support/pair_results.h"

namespace quatro::result_tables_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

PairResult In(PairResult result,
              const std::string& set,
              const std::string& bin = "9-12 m") {
  result.set = set;
  result.bin = bin;
  return result;
}

// On "00", a succeeds in 2 of 2 and b in 1 of 2; on "xx", a in 0 of 1.
std::vector<PairResult> Results() {
  return {In(ResultOff("a", "1", 0.2, 1.0), "00"),
          In(ResultOff("a", "2", 1.0, 6.0), "00"),
          In(ResultOff("a", "3", 5.0, 6.0), "xx"),
          In(ResultOff("b", "1", 0.4, 2.0), "00"),
          In(ResultWithoutAnswer("b", "2"), "00"),
          In(UnreadableResult("b", "3"), "xx")};
}

// The row with these first two cells, as column -> cell.
std::map<std::string, std::string> RowOf(const Table& table,
                                         const std::string& first,
                                         const std::string& second) {
  for (const auto& row : table.rows) {
    EXPECT_EQ(row.size(), table.columns.size());
    if (row[0] != first || row[1] != second) continue;
    std::map<std::string, std::string> cells;
    for (std::size_t i = 0; i < row.size(); ++i) {
      EXPECT_TRUE(cells.emplace(table.columns[i], row[i]).second)
          << table.columns[i] << " is listed twice";
    }
    return cells;
  }
  ADD_FAILURE() << "no row " << first << ", " << second;
  return {};
}

TEST(SuccessTable, IsByHand) {
  const Table table = MakeSuccessTable(Results(), {.with_quoted = false});
  EXPECT_THAT(table.columns,
              ElementsAre("method", "origin", "00", "xx", "all"));
  EXPECT_THAT(
      table.rows,
      ElementsAre(ElementsAre("a", "measured", "100.00", "0.00", "66.67"),
                  ElementsAre("b", "measured", "50.00", "", "50.00")));
}

TEST(SuccessTable, HasThePapersRowsBesideAndNotInThem) {
  const Table table = MakeSuccessTable(Results(), {});
  ASSERT_EQ(table.rows.size(), 5u);
  EXPECT_THAT(table.rows[2], ElementsAre("FGR", "quoted", "43.81", "", ""));
  EXPECT_THAT(table.rows[4], ElementsAre("Quatro", "quoted", "99.30", "", ""));
}

TEST(SuccessTable, OfOtherSetsHasNoQuotedRows) {
  const Table table =
      MakeSuccessTable({In(ResultOff("a", "1", 0.2, 1.0), "town")}, {});
  EXPECT_THAT(table.columns, ElementsAre("method", "origin", "town"));
  EXPECT_EQ(table.rows.size(), 1u);
  const Table lc = MakeSuccessTable(
      {In(ResultOff("a", "1", 0.2, 1.0), "all")}, {}, PublishedKittiLc());
  EXPECT_EQ(lc.rows.size(), 8u);
  EXPECT_THAT(lc.rows[3], ElementsAre("FPFH+Quatro", "quoted", "79.70"));
  const Table bins = MakeSuccessTable(
      {In(ResultOff("a", "1", 0.2, 1.0), "20-30 m")}, {}, PublishedKittiLc());
  EXPECT_EQ(bins.rows.size(), 6u);
  EXPECT_THAT(bins.rows[5], ElementsAre("G3Reg", "quoted", "71.80"));
}

TEST(SuccessTable, IntervalsAreWilsons) {
  const Table table = MakeSuccessTable(Results(), {.with_intervals = true});
  const auto a = RowOf(table, "a", "measured");
  EXPECT_EQ(a.at("00 low"), NumberCell(100.0 * WilsonInterval(2, 2).low, 2));
  EXPECT_EQ(a.at("00 high"), "100.00");
  EXPECT_EQ(a.at("all low"), NumberCell(100.0 * WilsonInterval(2, 3).low, 2));
  const auto b = RowOf(table, "b", "measured");
  EXPECT_EQ(b.at("xx"), "");
  EXPECT_EQ(b.at("xx low"), "");
  EXPECT_EQ(RowOf(table, "FGR", "quoted").at("00 high"), "");
}

// Table III's averages are over all answers.
TEST(ErrorTable, IsByHand) {
  const std::vector<PairResult> results = {
      In(ResultOff("a", "1", 0.2, 1.0), "06", "0-2 m"),
      In(ResultOff("a", "2", 5.0, 40.0), "06", "0-2 m"),
      In(ResultOff("a", "3", 0.5, 2.0), "06", "9-12 m"),
      In(ResultWithoutAnswer("b", "1"), "06", "0-2 m")};
  const Table table = MakeErrorTable(results, {});
  EXPECT_THAT(table.columns,
              ElementsAre("method",
                          "origin",
                          "0-2 m / t_avg m",
                          "0-2 m / r_avg deg",
                          "9-12 m / t_avg m",
                          "9-12 m / r_avg deg"));
  ASSERT_EQ(table.rows.size(), 7u);
  EXPECT_THAT(
      table.rows[0],
      ElementsAre("a", "measured", "2.600", "20.500", "0.500", "2.000"));
  EXPECT_THAT(table.rows[1], ElementsAre("b", "measured", "", "", "", ""));
  EXPECT_THAT(table.rows[6],
              ElementsAre("Quatro w/ INS", "quoted", "0.059", "0.207", "", ""));
  const auto wide =
      RowOf(MakeErrorTable(results, {.with_intervals = true}), "a", "measured");
  EXPECT_EQ(wide.at("0-2 m / t_avg m low"), "0.200");
  EXPECT_EQ(wide.at("0-2 m / t_avg m high"), "5.000");
  EXPECT_EQ(wide.at("0-2 m / r_avg deg high"), "40.000");
}

TEST(BinTable, HasARowAMethodAndBin) {
  const std::vector<PairResult> results = {
      In(ResultOff("a", "1", 0.2, 1.0), "06", "yaw 0 deg"),
      In(ResultOff("a", "2", 1.0, 3.0), "06", "yaw 0 deg"),
      In(ResultOff("a", "2", 9.0, 60.0), "06", "yaw 90 deg"),
      In(ResultOff("b", "1", 0.5, 2.0), "06", "yaw 0 deg")};
  const Table table = MakeBinTable(results, {});
  EXPECT_EQ(table.rows.size(), 3u);
  const auto row = RowOf(table, "a", "yaw 0 deg");
  EXPECT_EQ(row.at("pairs"), "2");
  EXPECT_EQ(row.at("success % / 2 m 10 deg"), "100.00");
  EXPECT_EQ(row.at("success % / 0.6 m 5 deg"), "50.00");
  EXPECT_EQ(row.at("successes / t_avg m"), "0.600");
  EXPECT_EQ(row.at("successes / t_avg as printed m2"), "0.5200");
  EXPECT_EQ(row.at("all answers / r median deg"), "2.000");
  EXPECT_EQ(row.at("all answers / yaw avg deg"), "1.000");
  const auto wrong = RowOf(table, "a", "yaw 90 deg");
  EXPECT_EQ(wrong.at("false registrations"), "1");
  EXPECT_EQ(wrong.at("successes / t_avg m"), "");
  EXPECT_EQ(wrong.at("all answers / t_avg m"), "9.000");
}

TEST(SummaryTable, HasARowAMethodAndSetAndOneOfAll) {
  auto results = Results();
  results.push_back(In(ResultApart("b", "4", "registered"), "xx"));
  const Table table = MakeSummaryTable(results, {.with_intervals = true});
  EXPECT_EQ(table.rows.size(), 6u);
  const auto all = RowOf(table, "b", "all");
  EXPECT_EQ(all.at("pairs"), "4");
  EXPECT_EQ(all.at("unreadable"), "1");
  EXPECT_EQ(all.at("apart"), "1");
  EXPECT_EQ(all.at("answers"), "1");
  EXPECT_EQ(all.at("registered"), "2");
  EXPECT_EQ(all.at("false registrations"), "1");
  EXPECT_EQ(all.at("success % / 2 m 5 deg"), "50.00");
  EXPECT_EQ(all.at("success % / 2 m 5 deg high"),
            NumberCell(100.0 * WilsonInterval(1, 2).high, 2));
  EXPECT_EQ(all.at("successes / t_avg m low"), "0.400");
}

TEST(SummaryTable, WithoutTruthThereIsNoWrong) {
  const Table table = MakeSummaryTable({ResultWithoutTruth("a", "1")}, {});
  const auto row = RowOf(table, "a", "00");
  EXPECT_EQ(row.at("apart"), "0");
  EXPECT_EQ(row.at("no truth"), "1");
  EXPECT_EQ(row.at("registered"), "1");
  EXPECT_EQ(row.at("false registrations"), "");
  EXPECT_EQ(row.at("success % / 2 m 5 deg"), "");
}

TEST(SignificanceTable, IsThatOfTheTests) {
  std::vector<PairResult> results;
  for (int i = 0; i < 12; ++i) {
    const std::string pair = std::to_string(i);
    results.push_back(ResultOff("ours", pair, 0.1, 1.0));
    results.push_back(ResultOff("other", pair, i < 11 ? 5.0 : 0.05, 2.0));
  }
  results.push_back(ResultWithoutAnswer("none", "0"));
  const Table table = MakeSignificanceTable(results, "ours", {});
  ASSERT_EQ(table.rows.size(), 2u);
  const auto row = RowOf(table, "ours", "other");
  EXPECT_EQ(row.at("pairs"), "12");
  EXPECT_EQ(row.at("only method correct"), "11");
  EXPECT_EQ(row.at("only other correct"), "0");
  EXPECT_EQ(row.at("success p"), "9.8e-04");  // 2 / 2^11
  EXPECT_EQ(row.at("r difference deg"), "-1.000");
  EXPECT_EQ(row.at("r p"), "4.9e-04");  // 2 / 2^12
  const auto none = RowOf(table, "ours", "none");
  EXPECT_EQ(none.at("both answer"), "0");
  EXPECT_EQ(none.at("t difference m"), "");
  EXPECT_EQ(none.at("success p"), "1.0000");
}

TEST(RecallTable, GrowsToTheShareOfAnswers) {
  const Table table = MakeRecallTable(Results());
  EXPECT_THAT(table.columns, ElementsAre("error", "at most", "a", "b"));
  const auto at = [&](const std::string& error, const std::string& x) {
    const auto row = RowOf(table, error, x);
    return std::pair(row.at("a"), row.at("b"));
  };
  EXPECT_THAT(at("translation m", "0.00"), ::testing::Pair("0.00", "0.00"));
  EXPECT_EQ(at("translation m", "0.20").first, "33.33");
  EXPECT_THAT(at("translation m", "3.00"), ::testing::Pair("66.67", "50.00"));
  EXPECT_EQ(at("rotation deg", "1.00").first, "33.33");
  EXPECT_THAT(at("rotation deg", "15.00"), ::testing::Pair("100.00", "50.00"));
}

TEST(TiltTable, CountsEachPairOnce) {
  auto results = Results();
  for (PairResult& result : results) {
    result.true_tilt = 0.6 * kDegree;
    result.true_yaw = -175.0 * kDegree;
  }
  results[1].true_tilt = 1.1 * kDegree;
  results[1].true_yaw = M_PI;
  results.push_back(ResultApart("a", "9", "ambiguous"));
  const Table table = MakeTiltTable(results);
  const auto count = [&](const std::string& angle, const std::string& from) {
    const auto row = RowOf(table, angle, from);
    return row.at("pairs");
  };
  EXPECT_EQ(count("tilt", "0.50"), "2");
  EXPECT_EQ(count("tilt", "1.00"), "1");
  EXPECT_EQ(count("tilt", "0.75"), "0");
  EXPECT_EQ(count("yaw", "170.00"), "3");
  long sum = 0;
  for (const auto& row : table.rows) sum += std::stol(row[3]);
  EXPECT_EQ(sum, 6);
  EXPECT_THAT(MakeTiltTable({}).rows, IsEmpty());
}

std::vector<PairResult> TimedResults() {
  auto results = Results();
  for (std::size_t i = 0; i < results.size(); ++i) {
    const double t = 0.001 * static_cast<double>(i + 1);
    results[i].stage_times = {
        {"voxels", t}, {"features", 2.0 * t}, {"matching", t}};
    if (results[i].method == "a") {
      results[i].stage_times.push_back({"rotation", 0.5 * t});
    }
    results[i].total_seconds = 5.0 * t;
  }
  return results;
}

TEST(TimingTable, IsByHand) {
  const Table table = MakeTimingTable(TimedResults(), {});
  EXPECT_THAT(table.columns,
              ElementsAre("method",
                          "pairs",
                          "stage ms / voxels",
                          "stage ms / features",
                          "stage ms / matching",
                          "stage ms / rotation",
                          "sum ms / front end",
                          "sum ms / rest",
                          "sum ms / total"));
  EXPECT_THAT(
      table.rows,
      ElementsAre(
          ElementsAre("a",
                      "3",
                      "2.00",
                      "4.00",
                      "2.00",
                      "1.00",
                      "8.00",
                      "1.00",
                      "10.00"),
          // The unreadable pair is not timed.
          ElementsAre(
              "b", "2", "4.50", "9.00", "4.50", "", "18.00", "", "22.50")));
}

TEST(TimingTable, ForPrintHasTheSumsAlone) {
  const Table table = MakeTimingTable(TimedResults(), {.with_details = false});
  EXPECT_THAT(table.columns,
              ElementsAre("method",
                          "pairs",
                          "sum ms / front end",
                          "sum ms / rest",
                          "sum ms / total"));
  EXPECT_THAT(table.rows[0], ElementsAre("a", "3", "8.00", "1.00", "10.00"));
  const auto wide = RowOf(
      MakeTimingTable(TimedResults(), {.with_intervals = true}), "a", "3");
  EXPECT_EQ(wide.at("sum ms / total low"), "5.00");
  EXPECT_EQ(wide.at("sum ms / total high"), "15.00");
}

TEST(TimingTable, StagesAreInTheOrderOfTheMethods) {
  auto results = Results();
  results[0].stage_times = {{"voxels", 1}, {"ransac", 1}, {"judge", 1}};
  results[3].stage_times = {
      {"voxels", 1}, {"graph", 1}, {"clique", 1}, {"judge", 1}, {"last", 1}};
  const Table table = MakeTimingTable(results, {});
  EXPECT_THAT(std::vector(table.columns.begin() + 2, table.columns.end() - 3),
              ElementsAre("stage ms / voxels",
                          "stage ms / ransac",
                          "stage ms / graph",
                          "stage ms / clique",
                          "stage ms / judge",
                          "stage ms / last"));
}

TEST(TimingTable, NoOtherTableHasTimes) {
  const auto all = [](const std::vector<PairResult>& results) {
    const TableOptions options{.with_intervals = true};
    return FormatCsv(MakeSuccessTable(results, options)) +
           FormatCsv(MakeErrorTable(results, options)) +
           FormatCsv(MakeBinTable(results, options)) +
           FormatCsv(MakeSummaryTable(results, options)) +
           FormatCsv(MakeSignificanceTable(results, "a", options)) +
           FormatCsv(MakeRecallTable(results)) +
           FormatCsv(MakeTiltTable(results));
  };
  EXPECT_EQ(all(Results()), all(TimedResults()));
  EXPECT_NE(FormatCsv(MakeTimingTable(Results(), {})),
            FormatCsv(MakeTimingTable(TimedResults(), {})));
}

TEST(ResultTables, OfNoResultsHaveNoRows) {
  EXPECT_THAT(MakeSuccessTable({}, {}).rows, IsEmpty());
  EXPECT_THAT(MakeErrorTable({}, {}).rows, IsEmpty());
  EXPECT_THAT(MakeBinTable({}, {}).rows, IsEmpty());
  EXPECT_THAT(MakeSummaryTable({}, {}).rows, IsEmpty());
  EXPECT_THAT(MakeSignificanceTable({}, "a", {}).rows, IsEmpty());
  EXPECT_THAT(MakeTimingTable({}, {}).rows, IsEmpty());
}

TEST(WithoutRepeats, KeepsOneOfOverlappingBinsAndAllOfAddedYaws) {
  auto turned = In(ResultOff("a", "1", 0.2, 1.0), "00", "yaw 90 deg");
  turned.true_yaw = 2.0;
  const std::vector<PairResult> results = {
      In(ResultOff("a", "1", 0.2, 1.0), "00", "9-12 m"),
      In(ResultOff("a", "1", 0.2, 1.0), "00", "8-10 m"),
      In(ResultOff("b", "1", 0.2, 1.0), "00", "9-12 m"),
      In(ResultOff("a", "1", 0.2, 1.0), "02", "9-12 m"),
      turned};
  const auto once = WithoutRepeats(results);
  ASSERT_EQ(once.size(), 4u);
  EXPECT_EQ(once[0].bin, "9-12 m");
  EXPECT_EQ(once[3].bin, "yaw 90 deg");
}

TEST(SelectDistance, HasTheLowerEndAlone) {
  auto results = Results();
  results[0].distance = 9.0;
  results[1].distance = 12.0;
  results[2].distance = 8.999;
  results[3].distance.reset();
  results.resize(4);
  const auto selected = SelectDistance(results, 9.0, 12.0);
  ASSERT_EQ(selected.size(), 1u);
  EXPECT_EQ(selected[0].pair, "1");
}

std::vector<std::string> NamesOf(const std::vector<TableFile>& files) {
  std::vector<std::string> names;
  for (const TableFile& file : files) names.push_back(file.name);
  return names;
}

TEST(RunTables, AreTheFilesOfARun) {
  auto results = TimedResults();
  // Table I is only for 9-12 m.
  for (PairResult& result : results) result.bin = "all";
  results[0].distance = 5.0;
  results[3].distance = 5.0;
  auto near = In(ResultOff("a", "7", 0.3, 1.0), "06", "4-6 m");
  near.distance = 5.0;
  results.push_back(near);
  const auto tables = MakeRunTables(results, {});
  EXPECT_THAT(NamesOf(FormatRunTables(tables)),
              ElementsAre("table_one.csv",
                          "table_one.tex",
                          "table_three.csv",
                          "table_three.tex",
                          "summary.csv",
                          "summary.tex",
                          "by_bin.csv",
                          "by_bin.tex",
                          "significance.csv",
                          "significance.tex",
                          "recall.csv",
                          "tilt.csv",
                          "timing.csv",
                          "timing.tex"));
  EXPECT_EQ(RowOf(tables[0].table, "a", "measured").at("00"), "100.00");
  EXPECT_EQ(RowOf(tables[0].table, "b", "measured").at("00"), "0.00");
  EXPECT_EQ(RowOf(tables[1].table, "a", "measured").at("4-6 m / t_avg m"),
            "0.300");
  // For print, the paper's averages; for CSV, all.
  EXPECT_EQ(tables[2].table.columns.size(), 2u + 7u + 3u + 4u);
  EXPECT_EQ(tables[2].with_intervals.columns.size(),
            2u + 7u + 3u * 3u + 2u * (4u * 3u + 2u));
  EXPECT_EQ(RowOf(tables[1].table, "FGR", "quoted").at("4-6 m / t_avg m"),
            "0.103");
}

const RunTable* Find(const std::vector<RunTable>& tables,
                     const std::string& name) {
  for (const RunTable& table : tables) {
    if (table.name == name) return &table;
  }
  return nullptr;
}

// Rows drawn for another bin do not count in Table I.
TEST(RunTables, TableOneIsOfItsBinIfThereIsOne) {
  std::vector<PairResult> results = {
      In(ResultOff("a", "1", 0.1, 1.0), "00", "9-12 m"),
      In(ResultOff("a", "2", 9.0, 1.0), "00", "8-10 m"),
      In(ResultOff("a", "3", 9.0, 1.0), "00", "8-10 m")};
  const auto rate = [&] {
    const auto tables = MakeRunTables(results, {});
    return RowOf(Find(tables, "table_one")->table, "a", "measured").at("00");
  };
  EXPECT_EQ(rate(), "100.00");
  results[0].bin = "10-12 m";
  EXPECT_EQ(rate(), "33.33");
}

TEST(RunTables, KittiLcIsByBinAndOfItsOwnLimit) {
  std::vector<PairResult> results = {
      In(ResultOff("a", "1", 0.1, 1.0), "00", "0-10 m"),
      In(ResultOff("a", "2", 0.1, 7.0), "02", "10-20 m"),
      In(ResultOff("a", "3", 1.9, 4.9), "02", "20-30 m")};
  const auto tables = MakeRunTables(results, {});
  const RunTable* const lc = Find(tables, "kitti_lc");
  ASSERT_NE(lc, nullptr);
  EXPECT_THAT(
      lc->table.rows.front(),
      ElementsAre("a", "measured", "100.00", "0.00", "100.00", "66.67"));
  EXPECT_THAT(
      lc->table.rows.back(),
      ElementsAre("G3Reg", "quoted", "98.60", "93.10", "71.80", "86.50"));
  const RunTable* const far = Find(tables, "kitti_lc_far");
  ASSERT_NE(far, nullptr);
  EXPECT_THAT(far->table.columns, ElementsAre("method", "origin", "02"));
  EXPECT_THAT(far->table.rows,
              ElementsAre(ElementsAre("a", "measured", "100.00")));
  results.pop_back();
  EXPECT_EQ(Find(MakeRunTables(results, {}), "kitti_lc"), nullptr);
}

TEST(RunTables, QuatroIsTheReferenceIfItIsThere) {
  const auto reference_of = [](const std::vector<PairResult>& results) {
    for (const RunTable& table : MakeRunTables(results, {})) {
      if (table.name == "significance") return table.table.rows.at(0).at(0);
    }
    return std::string("none");
  };
  EXPECT_EQ(reference_of({ResultOff("a", "1", 0.1, 1.0),
                          ResultOff("quatro", "1", 0.1, 1.0)}),
            "quatro");
  EXPECT_EQ(reference_of(Results()), "a");
  EXPECT_EQ(reference_of({ResultOff("quatro", "1", 0.1, 1.0)}), "none");
}

TEST(RunTables, OfNothingAreNone) {
  EXPECT_THAT(MakeRunTables({}, {}), IsEmpty());
}

TEST(FormatTable, ShowsEmptyCells) {
  EXPECT_EQ(FormatTable({{"a", "b"}, {{"x", ""}}}), "a  b\nx  -\n");
  EXPECT_EQ(FormatCsv({{"a", "b"}, {{"x", ""}}}), "a,b\nx,\n");
}

}  // namespace
}  // namespace quatro::result_tables_test
