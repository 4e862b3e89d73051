// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Tests whether two methods differ on the same pairs by more than chance. Some
// pairs are hard for both methods, so only pairs on which the methods differ
// count. If exactly one method solved each of n pairs, b of them the first
// method and c the second, then under chance each method solves a pair with
// probability 1/2 (exact McNemar test):
//
//   p = min(1, 2 sum_{k <= min(b, c)} C(n, k) / 2^n),   n = b + c.         (1)
//
// For errors, let d_i be the first method's error minus the second's. Under
// chance every d_i has either sign (sign-flip test). With signs s drawn
// uniformly,
//
//   p = P(|sum_i s_i d_i| >= |sum_i d_i|).                                 (2)
//
// Both tests are two-sided; p is 1 if the methods do not differ. p is not
// adjusted for the number of comparisons.
//
// The tables of quatro_experiment need these in C++; scripts use scipy.
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

// Equation (1); b, c >= 0.
double McNemarP(long b, long c);

struct SignFlipOptions {
  // Up to this many nonzero differences, all signs are enumerated. Beyond that,
  // `num_draws` random sign vectors are drawn, and the given signs count as one
  // of them, so that p is never 0.
  int max_enumerated = 14;
  int num_draws = 10000;
  std::uint64_t seed = 1;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Equation (2). Options must be valid, differences finite.
double SignFlipP(const std::vector<double>& differences,
                 const SignFlipOptions& options = {});

struct PairedComparison {
  long num_pairs = 0;  // Readable and with a true pose, in both methods.

  long num_only_first = 0;   // b
  long num_only_second = 0;  // c
  double success_p = 1.0;

  // Means over the pairs that both methods answer; first minus second.
  long num_both_answer = 0;
  double mean_translation_difference = 0.0;  // [m]
  double mean_rotation_difference = 0.0;     // [rad]
  double translation_p = 1.0;
  double rotation_p = 1.0;
};

// Compares the pairs that both methods ran on, matched by name, set and bin.
PairedComparison ComparePaired(const std::vector<PairResult>& results,
                               const std::string& first_method,
                               const std::string& second_method,
                               const SuccessLimit& limit,
                               const SignFlipOptions& options = {});

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_METRICS_PAIRED_TEST_H_
