// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Families of matched points (experiments/simulator/synthetic.h) as tasks, for
// the protocol `synthetic`: each family turns one screw, a bin a step. With c
// the noise bound, noise is of sigma = c / 3 but where it is what is turned:
//
//   outliers       50, 80, 90, 95, 98 and 99 % wrong of 1000 matches
//   noise          sigma = c/12, c/6, c/3, 2c/3; 95 % wrong of 1000
//   matches        100, 300, 1000, 3000 and 10000 of them, 95 % wrong
//   degeneracy     1, 2, 3, 5 and 10 true of 50, no wrong two consistent
//   quasi_inliers  20, 60 and 180 right in x and y alone, beside 20 true of 500

#ifndef QUATRO_EXPERIMENTS_PROTOCOLS_PROBLEM_FAMILIES_H_
#define QUATRO_EXPERIMENTS_PROTOCOLS_PROBLEM_FAMILIES_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/pair_selection.h"

namespace quatro {

std::vector<std::string> FamilyNames();

struct FamilyOptions {
  std::vector<std::string> families = FamilyNames();
  int num_problems = 20;     // Of each bin.
  double noise_bound = 0.3;  // c [m]
  std::uint64_t seed = 1;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Tasks "outliers/95 % outliers/7", of the set "outliers" and the bin
// "95 % outliers". Nullopt with *error set if the options are invalid.
std::optional<PairSelection> SelectProblems(const FamilyOptions& options,
                                            std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_PROBLEM_FAMILIES_H_
