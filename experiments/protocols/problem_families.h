// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Families of matched points (experiments/simulator/synthetic.h) as tasks for
// the protocol `synthetic`. Each family varies one parameter, with one bin per
// step. With the noise bound c, the noise is sigma = c / 3 unless it is varied:
//
//   outliers       50, 80, 90, 95, 98 and 99 % outliers in 1000 matches
//   noise          sigma = c/12, c/6, c/3, 2c/3; 95 % outliers in 1000 matches
//   matches        100, 300, 1000, 3000 and 10000 matches, 95 % outliers
//   degeneracy     1, 2, 3, 5 and 10 inliers of 50 matches; no outlier is
//                  consistent with another match
//   quasi_inliers  20, 60 and 180 quasi-inliers and 20 inliers of 500 matches

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
  int num_problems = 20;     // Per bin.
  double noise_bound = 0.3;  // c [m]
  std::uint64_t seed = 1;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Tasks such as "outliers/95 % outliers/7", of the set "outliers" and the bin
// "95 % outliers". Returns nullopt with *error set if the options are invalid.
std::optional<PairSelection> SelectProblems(const FamilyOptions& options,
                                            std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_PROBLEM_FAMILIES_H_
