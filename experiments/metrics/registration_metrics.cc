// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/metrics/registration_metrics.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "experiments/base/number_text.h"
#include "features/base/cloud_text.h"
#include "features/base/degree.h"

namespace quatro {
namespace {

ErrorAverages Average(const std::vector<PairError>& errors,
                      const std::optional<BootstrapOptions>& bootstrap) {
  std::vector<double> translation, squared, rotation, yaw;
  for (const PairError& error : errors) {
    translation.push_back(error.translation);
    squared.push_back(error.translation * error.translation);
    rotation.push_back(error.rotation);
    yaw.push_back(error.yaw);
  }
  ErrorAverages averages;
  averages.num_pairs = static_cast<long>(errors.size());
  averages.translation = Mean(translation);  // Equation (2)
  averages.rotation = Mean(rotation);
  averages.yaw = Mean(yaw);
  averages.translation_as_printed = Mean(squared);  // Equation (3)
  averages.median_translation = Median(translation);
  averages.median_rotation = Median(rotation);
  if (!bootstrap) return averages;
  averages.translation_interval = BootstrapMean(translation, *bootstrap);
  averages.rotation_interval = BootstrapMean(rotation, *bootstrap);
  averages.median_translation_interval =
      BootstrapMedian(translation, *bootstrap);
  averages.median_rotation_interval = BootstrapMedian(rotation, *bootstrap);
  return averages;
}

template <typename ErrorOf>
std::vector<double> Recall(const std::vector<PairResult>& results,
                           const std::vector<double>& grid,
                           const ErrorOf& error_of) {
  std::vector<double> errors;
  long num_posed = 0;
  for (const PairResult& result : results) {
    if (!IsReadable(result) || !HasTruth(result)) continue;
    ++num_posed;
    if (result.error) errors.push_back(error_of(*result.error));
  }
  std::sort(errors.begin(), errors.end());
  std::vector<double> recall;
  for (const double x : grid) {
    const auto num_below =
        std::upper_bound(errors.begin(), errors.end(), x) - errors.begin();
    recall.push_back(num_posed == 0 ? 0.0
                                    : static_cast<double>(num_below) /
                                          static_cast<double>(num_posed));
  }
  return recall;
}

}  // namespace

std::string SuccessLimit::Name() const {
  char text[64];
  std::snprintf(
      text, sizeof(text), "%g m %g deg", translation, rotation / kDegree);
  return text;
}

std::vector<SuccessLimit> UsualLimits() {
  return {{2.0, 10.0 * kDegree}, {2.0, 5.0 * kDegree}, {0.6, 5.0 * kDegree}};
}

std::optional<std::vector<SuccessLimit>> ParseLimits(const std::string& text,
                                                     std::string* error) {
  std::vector<SuccessLimit> limits;
  for (const std::string_view field : SplitFields(text, ",")) {
    const auto parts = SplitFields(field, "/");
    const auto translation =
        parts.size() == 2 ? ParseFiniteNumber(parts[0]) : std::nullopt;
    const auto degrees =
        parts.size() == 2 ? ParseFiniteNumber(parts[1]) : std::nullopt;
    if (!translation || !degrees || *translation < 0.0 || *degrees < 0.0) {
      *error = Quoted(field) + " is not a limit, must be like 2/10 [m/deg]";
      return std::nullopt;
    }
    limits.push_back({*translation, *degrees * kDegree});
  }
  if (!limits.empty()) return limits;
  *error = "there is no limit, must be like 2/10,0.6/5 [m/deg]";
  return std::nullopt;
}

bool IsReadable(const PairResult& result) {
  return result.status != "unreadable";
}

bool HasTruth(const PairResult& result) { return result.distance.has_value(); }

std::optional<double> RegistrationMetrics::SuccessRate(
    std::size_t limit) const {
  if (num_posed == 0) return std::nullopt;
  return static_cast<double>(num_successes[limit]) /
         static_cast<double>(num_posed);
}

RegistrationMetrics ComputeMetrics(
    const std::vector<PairResult>& results,
    const std::vector<SuccessLimit>& limits,
    const std::optional<BootstrapOptions>& bootstrap) {
  CHECK(!limits.empty());
  RegistrationMetrics metrics;
  metrics.num_successes.resize(limits.size());
  std::vector<PairError> all, successes;
  for (const PairResult& result : results) {
    ++metrics.num_pairs;
    if (!IsReadable(result)) {
      ++metrics.num_unreadable;
      continue;
    }
    ++(HasTruth(result)        ? metrics.num_posed
       : result.is_truth_known ? metrics.num_apart
                               : metrics.num_unknown);
    const bool succeeds =
        result.IsWithin(limits[0].translation, limits[0].rotation);
    if (result.status == "registered") {
      ++metrics.num_registered;
      metrics.num_wrong_registered += !succeeds && result.is_truth_known;
    }
    if (!result.error) continue;
    ++metrics.num_answers;
    all.push_back(*result.error);
    if (succeeds) successes.push_back(*result.error);
    for (std::size_t i = 0; i < limits.size(); ++i) {
      metrics.num_successes[i] +=
          result.IsWithin(limits[i].translation, limits[i].rotation);
    }
  }
  const double confidence = bootstrap.value_or(BootstrapOptions()).confidence;
  for (const long num : metrics.num_successes) {
    metrics.success_intervals.push_back(
        WilsonInterval(num, metrics.num_posed, confidence));
  }
  metrics.of_successes = Average(successes, bootstrap);
  metrics.of_all = Average(all, bootstrap);
  return metrics;
}

std::vector<double> TranslationRecall(const std::vector<PairResult>& results,
                                      const std::vector<double>& grid) {
  return Recall(
      results, grid, [](const PairError& e) { return e.translation; });
}

std::vector<double> RotationRecall(const std::vector<PairResult>& results,
                                   const std::vector<double>& grid) {
  return Recall(results, grid, [](const PairError& e) { return e.rotation; });
}

}  // namespace quatro
