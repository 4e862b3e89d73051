// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Matched points that follow two poses: most of them one, the others another.

#ifndef QUATRO_TESTS_SUPPORT_TWO_POSES_H_
#define QUATRO_TESTS_SUPPORT_TWO_POSES_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "tests/support/matched_problems.h"

namespace quatro {

struct TwoPoses {
  Points source;
  Points target;
  Rigid3 few;                        // Of 60 matches,
  Rigid3 many;                       // and of the other 90.
  std::vector<Eigen::Index> of_few;  // Columns, ascending.
};

inline TwoPoses MakeTwoPoses(std::uint64_t seed) {
  constexpr Eigen::Index kNumFew = 60;
  constexpr Eigen::Index kNumAll = 150;
  Random random(seed);
  TwoPoses problem;
  problem.few = {RotationZ(0.3), {2.0, 1.0, 0.2}};
  problem.many = {RotationZ(2.5), {-20.0, 15.0, -0.3}};
  problem.source = RandomPointsInBox(kNumAll, {40.0, 40.0, 4.0}, &random);
  problem.target.resize(3, kNumAll);
  const auto order = RandomPermutation(kNumAll, Mix(seed));
  for (Eigen::Index i = 0; i < kNumAll; ++i) {
    const bool is_of_few = order[static_cast<std::size_t>(i)] < kNumFew;
    const Eigen::Vector3d noise =
        RandomPointsInBox(1, Eigen::Vector3d::Constant(0.05), &random);
    problem.target.col(i) = (is_of_few ? problem.few : problem.many) *
                                Eigen::Vector3d(problem.source.col(i)) +
                            noise;
    if (is_of_few) problem.of_few.push_back(i);
  }
  return problem;
}

}  // namespace quatro

#endif  // QUATRO_TESTS_SUPPORT_TWO_POSES_H_
