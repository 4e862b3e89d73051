// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/tables/result_groups.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <tuple>

namespace quatro {
namespace {

std::vector<std::string> NamesOf(const std::vector<PairResult>& results,
                                 std::string PairResult::*name) {
  std::vector<std::string> names;
  for (const PairResult& result : results) {
    if (std::find(names.begin(), names.end(), result.*name) == names.end()) {
      names.push_back(result.*name);
    }
  }
  return names;
}

}  // namespace

std::vector<std::string> MethodsOf(const std::vector<PairResult>& results) {
  return NamesOf(results, &PairResult::method);
}

std::vector<std::string> SetsOf(const std::vector<PairResult>& results) {
  return NamesOf(results, &PairResult::set);
}

std::vector<std::string> BinsOf(const std::vector<PairResult>& results) {
  return NamesOf(results, &PairResult::bin);
}

std::vector<PairResult> SelectResults(const std::vector<PairResult>& results,
                                      const std::optional<std::string>& method,
                                      const std::optional<std::string>& set,
                                      const std::optional<std::string>& bin) {
  std::vector<PairResult> selected;
  for (const PairResult& result : results) {
    if ((!method || result.method == *method) && (!set || result.set == *set) &&
        (!bin || result.bin == *bin)) {
      selected.push_back(result);
    }
  }
  return selected;
}

std::vector<PairResult> SelectDistance(const std::vector<PairResult>& results,
                                       double min,
                                       double max) {
  std::vector<PairResult> selected;
  for (const PairResult& result : results) {
    if (result.distance && *result.distance >= min && *result.distance < max) {
      selected.push_back(result);
    }
  }
  return selected;
}

std::vector<PairResult> WithoutRepeats(const std::vector<PairResult>& results) {
  std::set<
      std::tuple<std::string, std::string, std::string, std::optional<double>>>
      seen;
  std::vector<PairResult> once;
  for (const PairResult& result : results) {
    if (seen.emplace(result.method, result.set, result.pair, result.true_yaw)
            .second) {
      once.push_back(result);
    }
  }
  return once;
}

std::string NumberCell(const std::optional<double>& value, int digits) {
  if (!value || !std::isfinite(*value)) return "";
  char text[400];
  std::snprintf(text, sizeof(text), "%.*f", digits, *value);
  return text;
}

void AddCells(const std::optional<double>& value,
              const std::optional<Interval>& interval,
              double scale,
              int digits,
              const TableOptions& options,
              std::vector<std::string>* row) {
  const auto add = [&](const std::optional<double>& number) {
    row->push_back(number ? NumberCell(scale * *number, digits) : "");
  };
  add(value);
  if (!options.with_intervals) return;
  const bool has_ends = value && interval;
  add(has_ends ? std::optional(interval->low) : std::nullopt);
  add(has_ends ? std::optional(interval->high) : std::nullopt);
}

void AddColumns(const std::string& name,
                const TableOptions& options,
                std::vector<std::string>* columns) {
  columns->push_back(name);
  if (!options.with_intervals) return;
  columns->push_back(name + " low");
  columns->push_back(name + " high");
}

}  // namespace quatro
