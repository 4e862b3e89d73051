// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Whether two methods differ on the same pairs, or chance alone would do. Pairs
// are hard or easy for both, so only those that tell the methods apart count.
// Of n pairs that exactly one of the methods solved, b by the first and c by
// the second, chance would give each with 1/2 (exact McNemar test),
//
//   p = min(1, 2 sum_{k <= min(b, c)} C(n, k) / 2^n),   n = b + c.         (1)
//
// Of errors, with d_i the first's less the second's: chance would give every
// d_i either sign (sign-flip test), so with signs s drawn evenly
//
//   p = P(|sum_i s_i d_i| >= |sum_i d_i|).                                 (2)
//
// Two-sided both; 1 where nothing tells the methods apart. Not adjusted for the
// number of comparisons.
//
// Sources: McNemar, "Note on the Sampling Error of the Difference between
// Correlated Proportions", Psychometrika 1947. Fisher, "The Design of
// Experiments", 1935, section 21, for (2).

#ifndef QUATRO_EXPERIMENTS_METRICS_PAIRED_TEST_H_
#define QUATRO_EXPERIMENTS_METRICS_PAIRED_TEST_H_

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/metrics/pair_result.h"
#include "experiments/metrics/registration_metrics.h"

namespace quatro {

// (1); b, c >= 0.
double McNemarP(long b, long c);

struct SignFlipOptions {
  // Up to so many differences other than 0 all signs are tried; for more of
  // them, `num_draws` random ones, and the given signs counted as one of them,
  // so that p is never 0.
  int max_enumerated = 14;
  int num_draws = 10000;
  std::uint64_t seed = 1;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// (2). Options must be valid, differences finite.
double SignFlipP(const std::vector<double>& differences,
                 const SignFlipOptions& options = {});

struct PairedComparison {
  long num_pairs = 0;  // Of both methods, with truth and readable.

  long num_only_first = 0;   // b
  long num_only_second = 0;  // c
  double success_p = 1.0;

  // Over the pairs of which both have an answer; first less second.
  long num_both_answer = 0;
  double mean_translation_difference = 0.0;  // [m]
  double mean_rotation_difference = 0.0;     // [rad]
  double translation_p = 1.0;
  double rotation_p = 1.0;
};

// On the pairs that both methods were run on: of the same name, set and bin.
PairedComparison ComparePaired(const std::vector<PairResult>& results,
                               const std::string& first_method,
                               const std::string& second_method,
                               const SuccessLimit& limit,
                               const SignFlipOptions& options = {});

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_METRICS_PAIRED_TEST_H_
