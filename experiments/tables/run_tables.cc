// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/tables/run_tables.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/tables/curve_tables.h"
#include "experiments/tables/error_table.h"
#include "experiments/tables/latex.h"
#include "experiments/tables/success_table.h"
#include "experiments/tables/summary_table.h"
#include "experiments/tables/timing_table.h"

namespace quatro {
namespace {

std::vector<PairResult> OfTableThree(const std::vector<PairResult>& results) {
  std::vector<PairResult> chosen;
  for (const char* const bin : {"0-2 m", "4-6 m", "8-10 m"}) {
    const auto of_bin = SelectResults(results, std::nullopt, "06", bin);
    chosen.insert(chosen.end(), of_bin.begin(), of_bin.end());
  }
  return chosen;
}

// Pairs 9-12 m apart: the bin of this name, from which pairs are drawn evenly,
// or else the pairs of all bins at these distances.
std::vector<PairResult> OfTableOne(const std::vector<PairResult>& results) {
  const auto of_bin =
      SelectResults(results, std::nullopt, std::nullopt, "9-12 m");
  return of_bin.empty() ? SelectDistance(WithoutRepeats(results), 9.0, 12.0)
                        : of_bin;
}

// The results with bins as sets; none if the bins are not those of kitti_lc.
std::vector<PairResult> OfKittiLc(const std::vector<PairResult>& results) {
  auto bins = BinsOf(results);
  std::sort(bins.begin(), bins.end());
  std::vector<PairResult> by_bin;
  if (bins != std::vector<std::string>{"0-10 m", "10-20 m", "20-30 m"}) {
    return by_bin;
  }
  for (PairResult result : results) {
    result.set = result.bin;
    by_bin.push_back(std::move(result));
  }
  return by_bin;
}

bool IsOfAFigure(const std::string& name) {
  return name == "recall" || name == "tilt";
}

}  // namespace

std::vector<RunTable> MakeRunTables(const std::vector<PairResult>& results,
                                    const TableOptions& options) {
  TableOptions plain = options;
  plain.with_intervals = false;
  plain.with_details = false;
  TableOptions wide = options;
  wide.with_intervals = true;
  wide.with_details = true;
  std::vector<RunTable> tables;
  const auto add = [&](const std::string& name,
                       const std::string& caption,
                       const auto& make) {
    RunTable table{name, caption, make(plain), make(wide)};
    if (!table.table.rows.empty()) tables.push_back(std::move(table));
  };

  const auto once = WithoutRepeats(results);
  const auto near =
      options.are_scans ? OfTableOne(results) : std::vector<PairResult>();
  add("table_one",
      "Success [%], pairs 9-12 m apart, within " + options.limits[0].Name() +
          ".",
      [&](TableOptions o) {
        // The paper's values use the paper's limit.
        o.with_quoted =
            o.with_quoted && o.limits[0].Name() == UsualLimits()[0].Name();
        return MakeSuccessTable(near, o);
      });
  const auto lc = OfKittiLc(results);
  const SuccessLimit lc_limit{2.0, 5.0 * M_PI / 180.0};
  add("kitti_lc",
      "Success [%] in the bins of kitti_lc, within " + lc_limit.Name() +
          "; published rows are on real scans.",
      [&](TableOptions o) {
        o.limits = {lc_limit};
        return MakeSuccessTable(lc, o, PublishedKittiLc());
      });
  const auto far =
      lc.empty()
          ? lc
          : SelectResults(results, std::nullopt, std::nullopt, "20-30 m");
  add("kitti_lc_far",
      "Success [%] on pairs 20-30 m apart, within " + lc_limit.Name() + ".",
      [&](TableOptions o) {
        o.limits = {lc_limit};
        return MakeSuccessTable(far, o, {});
      });
  const auto three = OfTableThree(results);
  add("table_three",
      "Mean errors over all answers on sequence 06.",
      [&](const TableOptions& o) { return MakeErrorTable(three, o); });
  add("summary", "All methods on all pairs.", [&](const TableOptions& o) {
    return MakeSummaryTable(once, o);
  });
  add("by_bin", "All methods by bin.", [&](const TableOptions& o) {
    return MakeBinTable(results, o);
  });
  const auto methods = MethodsOf(once);
  const bool has_quatro =
      std::find(methods.begin(), methods.end(), "quatro") != methods.end();
  const std::string reference =
      has_quatro || methods.empty() ? "quatro" : methods[0];
  add("significance",
      "Paired tests; p-values are not adjusted for their number.",
      [&](const TableOptions& o) {
        return MakeSignificanceTable(once, reference, o);
      });
  add("recall", "Recall [%] over the allowed error.", [&](const auto&) {
    return once.empty() ? Table{} : MakeRecallTable(once);
  });
  add("tilt", "Relative roll-pitch and yaw of the pairs.", [&](const auto&) {
    return MakeTiltTable(once);
  });
  add("timing", "Median time by stage.", [&](const TableOptions& o) {
    return MakeTimingTable(once, o);
  });
  return tables;
}

std::vector<TableFile> FormatRunTables(const std::vector<RunTable>& tables) {
  std::vector<TableFile> files;
  for (const RunTable& table : tables) {
    files.push_back({table.name + ".csv", FormatCsv(table.with_intervals)});
    if (IsOfAFigure(table.name)) continue;
    files.push_back({table.name + ".tex",
                     FormatLatex(table.table,
                                 {.caption = table.caption,
                                  .label = "tab:" + table.name})});
  }
  return files;
}

}  // namespace quatro
