// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// How far a figure of a table may be off for want of pairs. For k successes of
// n, with p = k / n and z the normal quantile of the confidence, Wilson's
// interval holds every rate q that p does not contradict,
//
//   (p - q)^2 <= z^2 q (1 - q) / n,                                        (1)
//
// which stays within [0, 1] and has a width at p = 0 and 1 as well. For means
// and medians, the percentile bootstrap: draw n of the n values with
// replacement, B times; the interval runs from the (1 - confidence) / 2 to the
// (1 + confidence) / 2 quantile of what comes out. It is too narrow for n below
// ten or so, and for one value it is that value.
//
// Sources: Wilson, "Probable Inference, the Law of Succession, and Statistical
// Inference", JASA 1927. Efron and Tibshirani, "An Introduction to the
// Bootstrap", 1993, section 13.3.

#ifndef QUATRO_EXPERIMENTS_METRICS_INTERVALS_H_
#define QUATRO_EXPERIMENTS_METRICS_INTERVALS_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace quatro {

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

// x with P(X <= x) = probability for a normal X, of mean 0 and variance 1;
// 0 < probability < 1.
double NormalQuantile(double probability);

// (1); all of [0, 1] for n = 0. 0 <= k <= n, 0 < confidence < 1.
Interval WilsonInterval(long k, long n, double confidence = 0.95);

struct BootstrapOptions {
  double confidence = 0.95;
  int num_samples = 1000;  // B
  std::uint64_t seed = 1;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Nullopt for no values. Half way between the middle two of an even number.
std::optional<double> Mean(const std::vector<double>& values);
std::optional<double> Median(std::vector<double> values);

// `share` of the way from the least to the greatest, 0 .. 1, linear between
// values. Nullopt for no values.
std::optional<double> Quantile(std::vector<double> values, double share);

// Nullopt for no values. Options must be valid. Depend on the values' order,
// the seed and nothing else.
std::optional<Interval> BootstrapMean(const std::vector<double>& values,
                                      const BootstrapOptions& options = {});
std::optional<Interval> BootstrapMedian(const std::vector<double>& values,
                                        const BootstrapOptions& options = {});

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_METRICS_INTERVALS_H_
