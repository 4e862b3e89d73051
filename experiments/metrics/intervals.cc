// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/metrics/intervals.h"

#include <glog/logging.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "features/base/random.h"

namespace quatro {
namespace {

// Changes the order of `values`.
double QuantileInPlace(std::vector<double>* values, double share) {
  const double place = share * static_cast<double>(values->size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(place);
  const auto at = values->begin() + below;
  std::nth_element(values->begin(), at, values->end());
  const double rest = place - static_cast<double>(below);
  if (rest == 0.0) return *at;
  const double above = *std::min_element(at + 1, values->end());
  return *at + rest * (above - *at);
}

// `statistic` may change the order of its argument.
template <typename Statistic>
std::optional<Interval> Bootstrap(const std::vector<double>& values,
                                  const BootstrapOptions& options,
                                  const Statistic& statistic) {
  std::string error;
  CHECK(options.IsValid(&error)) << error;
  if (values.empty()) return std::nullopt;
  Random random(options.seed);
  std::vector<double> drawn(values.size());
  std::vector<double> outcomes;
  for (int i = 0; i < options.num_samples; ++i) {
    for (double& value : drawn) value = values[random.Below(values.size())];
    outcomes.push_back(statistic(&drawn));
  }
  const double tail = 0.5 * (1.0 - options.confidence);
  return Interval{*Quantile(outcomes, tail), *Quantile(outcomes, 1.0 - tail)};
}

}  // namespace

double NormalQuantile(double probability) {
  CHECK(probability > 0.0 && probability < 1.0) << probability;
  return boost::math::quantile(boost::math::normal(), probability);
}

Interval WilsonInterval(long k, long n, double confidence) {
  CHECK(k >= 0 && k <= n) << k << " of " << n;
  if (n == 0) return {0.0, 1.0};
  const auto count = static_cast<double>(n);
  const double p = static_cast<double>(k) / count;
  const double z = NormalQuantile(0.5 * (1.0 + confidence));
  const double z2 = z * z / count;
  // The roots of (1 + z2) q^2 - (2 p + z2) q + p^2, by (1).
  const double center = (p + 0.5 * z2) / (1.0 + z2);
  const double half = std::sqrt(z2 * (p * (1.0 - p) + 0.25 * z2)) / (1.0 + z2);
  return {k == 0 ? 0.0 : center - half, k == n ? 1.0 : center + half};
}

bool BootstrapOptions::IsValid(std::string* error) const {
  error->clear();
  if (!(confidence > 0.0 && confidence < 1.0)) {
    *error =
        "confidence = " + std::to_string(confidence) + ", must be in (0, 1)";
  } else if (num_samples < 1) {
    *error = "num_samples = " + std::to_string(num_samples) + ", must be >= 1";
  }
  return error->empty();
}

std::optional<double> Mean(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return std::accumulate(values.begin(), values.end(), 0.0) /
         static_cast<double>(values.size());
}

std::optional<double> Median(std::vector<double> values) {
  return Quantile(std::move(values), 0.5);
}

std::optional<double> Quantile(std::vector<double> values, double share) {
  CHECK(share >= 0.0 && share <= 1.0) << share;
  if (values.empty()) return std::nullopt;
  return QuantileInPlace(&values, share);
}

std::optional<Interval> BootstrapMean(const std::vector<double>& values,
                                      const BootstrapOptions& options) {
  return Bootstrap(values, options, [](std::vector<double>* drawn) {
    return *Mean(*drawn);
  });
}

std::optional<Interval> BootstrapMedian(const std::vector<double>& values,
                                        const BootstrapOptions& options) {
  return Bootstrap(values, options, [](std::vector<double>* drawn) {
    return QuantileInPlace(drawn, 0.5);
  });
}

}  // namespace quatro
