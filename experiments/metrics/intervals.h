// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Confidence intervals for the numbers of a table, because the number of pairs
// is limited. For k successes of n, with p = k / n and z the normal quantile of
// the confidence, Wilson's interval contains every rate q that is consistent
// with p,
//
//   (p - q)^2 <= z^2 q (1 - q) / n,                                        (1)
//
// It stays within [0, 1] and has a positive width at p = 0 and p = 1 as well.
// For means and medians, the percentile bootstrap draws n of the n values with
// replacement, B times. The interval runs from the (1 - confidence) / 2 to the
// (1 + confidence) / 2 quantile of the B statistics. It is too narrow for n
// below about ten; for one value it has no width.
//
// The tables of quatro_experiment need these in C++; scripts use scipy.
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

// Returns x with P(X <= x) = probability for a normal X with mean 0 and
// variance 1; 0 < probability < 1.
double NormalQuantile(double probability);

// Equation (1); [0, 1] for n = 0. 0 <= k <= n, 0 < confidence < 1.
Interval WilsonInterval(long k, long n, double confidence = 0.95);

struct BootstrapOptions {
  double confidence = 0.95;
  int num_samples = 1000;  // B
  std::uint64_t seed = 1;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Both return nullopt for no values. The median of an even number of values is
// the mean of the middle two.
std::optional<double> Mean(const std::vector<double>& values);
std::optional<double> Median(std::vector<double> values);

// The value at `share` (0 .. 1) of the way from the smallest to the largest,
// interpolated linearly between values. Nullopt for no values.
std::optional<double> Quantile(std::vector<double> values, double share);

// Both return nullopt for no values. Options must be valid. The result depends
// only on the values, their order, and the seed.
std::optional<Interval> BootstrapMean(const std::vector<double>& values,
                                      const BootstrapOptions& options = {});
std::optional<Interval> BootstrapMedian(const std::vector<double>& values,
                                        const BootstrapOptions& options = {});

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_METRICS_INTERVALS_H_
