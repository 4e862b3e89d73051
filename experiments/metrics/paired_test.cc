// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/metrics/paired_test.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "experiments/metrics/intervals.h"
#include "features/base/random.h"

namespace quatro {
namespace {

// Summing the same numbers in another order changes the rounding.
bool IsAsLarge(double sum, double reference, double scale) {
  return std::abs(sum) >= reference - 1e-12 * scale;
}

using PairKey = std::tuple<std::string, std::string, std::string>;

std::map<PairKey, const PairResult*> PairsOf(
    const std::vector<PairResult>& results, const std::string& method) {
  std::map<PairKey, const PairResult*> pairs;
  for (const PairResult& result : results) {
    if (result.method == method && IsReadable(result) && HasTruth(result)) {
      pairs[{result.set, result.bin, result.pair}] = &result;
    }
  }
  return pairs;
}

}  // namespace

double McNemarP(long b, long c) {
  CHECK(b >= 0 && c >= 0) << b << ", " << c;
  const auto n = static_cast<double>(b + c);
  const long least = std::min(b, c);
  // Uses logarithms because 2^n overflows.
  double sum = 0.0;
  double log_term = -n * std::log(2.0);
  for (long k = 0; k <= least; ++k) {
    sum += std::exp(log_term);
    log_term +=
        std::log((n - static_cast<double>(k)) / static_cast<double>(k + 1));
  }
  return std::min(1.0, 2.0 * sum);
}

bool SignFlipOptions::IsValid(std::string* error) const {
  error->clear();
  if (max_enumerated < 0 || max_enumerated > 24) {
    *error = "max_enumerated = " + std::to_string(max_enumerated) +
             ", must be in 0 .. 24";
  } else if (num_draws < 1) {
    *error = "num_draws = " + std::to_string(num_draws) + ", must be >= 1";
  }
  return error->empty();
}

double SignFlipP(const std::vector<double>& differences,
                 const SignFlipOptions& options) {
  std::string error;
  CHECK(options.IsValid(&error)) << error;
  std::vector<double> d;
  double sum = 0.0;
  double scale = 0.0;
  for (const double difference : differences) {
    if (difference == 0.0) continue;
    d.push_back(difference);
    sum += difference;
    scale += std::abs(difference);
  }
  const double reference = std::abs(sum);
  const bool is_enumerated =
      d.size() <= static_cast<std::size_t>(options.max_enumerated);
  const std::uint64_t num_rounds =
      is_enumerated ? std::uint64_t{1} << d.size()
                    : static_cast<std::uint64_t>(options.num_draws);
  Random random(options.seed);
  std::uint64_t num_as_large = 0;
  for (std::uint64_t round = 0; round < num_rounds; ++round) {
    double flipped = 0.0;
    std::uint64_t signs = round;
    for (std::size_t i = 0; i < d.size(); ++i) {
      if (!is_enumerated && i % 64 == 0) signs = random.Next();
      flipped += (signs & 1) != 0 ? -d[i] : d[i];
      signs >>= 1;
    }
    num_as_large += IsAsLarge(flipped, reference, scale);
  }
  const std::uint64_t given = is_enumerated ? 0 : 1;
  return static_cast<double>(num_as_large + given) /
         static_cast<double>(num_rounds + given);
}

PairedComparison ComparePaired(const std::vector<PairResult>& results,
                               const std::string& first_method,
                               const std::string& second_method,
                               const SuccessLimit& limit,
                               const SignFlipOptions& options) {
  const auto first = PairsOf(results, first_method);
  const auto second = PairsOf(results, second_method);
  PairedComparison comparison;
  std::vector<double> translation, rotation;
  for (const auto& [key, a] : first) {
    const auto found = second.find(key);
    if (found == second.end()) continue;
    const PairResult* const b = found->second;
    ++comparison.num_pairs;
    const bool a_succeeds = a->IsWithin(limit.translation, limit.rotation);
    const bool b_succeeds = b->IsWithin(limit.translation, limit.rotation);
    comparison.num_only_first += a_succeeds && !b_succeeds;
    comparison.num_only_second += b_succeeds && !a_succeeds;
    if (a->error && b->error) {
      translation.push_back(a->error->translation - b->error->translation);
      rotation.push_back(a->error->rotation - b->error->rotation);
    }
  }
  comparison.success_p =
      McNemarP(comparison.num_only_first, comparison.num_only_second);
  comparison.num_both_answer = static_cast<long>(translation.size());
  comparison.mean_translation_difference = Mean(translation).value_or(0.0);
  comparison.mean_rotation_difference = Mean(rotation).value_or(0.0);
  comparison.translation_p = SignFlipP(translation, options);
  comparison.rotation_p = SignFlipP(rotation, options);
  return comparison;
}

}  // namespace quatro
