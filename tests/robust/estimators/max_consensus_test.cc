// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/max_consensus.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "features/base/rigid3.h"
#include "robust/estimators/consensus_search.h"
#include "tests/support/matched_problems.h"

namespace quatro::max_consensus_test {
namespace {

using ::testing::HasSubstr;

Eigen::Index CountInliers(const KnownProblem& problem,
                          double yaw,
                          const Eigen::Vector2d& translation,
                          double bound) {
  Eigen::Index num = 0;
  const Points turned = RotationZ(yaw) * problem.source;
  for (Eigen::Index i = 0; i < turned.cols(); ++i) {
    const Eigen::Vector2d error =
        problem.target.col(i).head<2>() - turned.col(i).head<2>() - translation;
    num += error.cwiseAbs().maxCoeff() <= bound;
  }
  return num;
}

class MaxConsensusSeed : public ::testing::TestWithParam<int> {
 protected:
  KnownProblem Problem(Eigen::Index num_inliers,
                       Eigen::Index num_outliers) const {
    return MakeMatchedProblem(
        {.num_inliers = num_inliers, .num_outliers = num_outliers},
        static_cast<std::uint64_t>(GetParam()));
  }
};

TEST_P(MaxConsensusSeed, CountsAreThoseOfItsPose) {
  const KnownProblem problem = Problem(10, 60);
  const MaxConsensus found =
      FindMaxConsensus(problem.source, problem.target, {});
  EXPECT_TRUE(found.IsOptimal());
  // The point is a corner of the squares that share it.
  EXPECT_EQ(CountInliers(problem, found.yaw, found.translation, 0.3 + 1e-9),
            found.num_inliers);
}

// A dense grid of yaws, and for each yaw the corners of all squares.
TEST_P(MaxConsensusSeed, NoPoseOfAGridHasMore) {
  const KnownProblem problem = Problem(4, 12);
  const MaxConsensus found =
      FindMaxConsensus(problem.source, problem.target, {});
  ASSERT_TRUE(found.IsOptimal());
  EXPECT_GE(found.num_inliers, 4);
  Eigen::Index most = 0;
  for (int k = 0; k < 1000; ++k) {
    const double yaw = k * 2.0 * M_PI / 1000.0;
    const Points turned = RotationZ(yaw) * problem.source;
    for (Eigen::Index i = 0; i < turned.cols(); ++i) {
      for (Eigen::Index j = 0; j < turned.cols(); ++j) {
        const Eigen::Vector2d corner(problem.target(0, i) - turned(0, i) - 0.3,
                                     problem.target(1, j) - turned(1, j) - 0.3);
        most = std::max(most, CountInliers(problem, yaw, corner, 0.3 + 1e-12));
      }
    }
  }
  EXPECT_GE(found.num_inliers, most);
}

TEST_P(MaxConsensusSeed, FindsThePlantedPose) {
  const KnownProblem problem = Problem(20, 300);
  const MaxConsensus found =
      FindMaxConsensus(problem.source, problem.target, {});
  EXPECT_TRUE(found.IsOptimal());
  EXPECT_GE(found.num_inliers, 20);
  EXPECT_NEAR(
      std::remainder(found.yaw - Yaw(problem.true_target_from_source.rotation),
                     2.0 * M_PI),
      0.0,
      0.03);
}

// A disk of radius r contains the square of half width r / sqrt(2), so its
// consensus is no smaller than the square's; and it is within that of r.
TEST_P(MaxConsensusSeed, BoundsTheConsensusSearch) {
  KnownProblem problem = Problem(12, 500);
  problem.source.row(2).setZero();
  problem.target.row(2).setZero();
  ConsensusSearchOptions search;
  search.noise_bound = 0.5;
  const auto proposals =
      SearchConsensus(problem.source, problem.target, search);
  ASSERT_FALSE(proposals.empty());
  std::size_t most = 0;
  for (const Proposal& proposal : proposals) {
    most = std::max(most, proposal.inliers.size());
  }
  MaxConsensusOptions options;
  options.noise_bound = search.noise_bound;
  const MaxConsensus outer =
      FindMaxConsensus(problem.source, problem.target, options);
  options.noise_bound = search.noise_bound / std::sqrt(2.0);
  const MaxConsensus inner =
      FindMaxConsensus(problem.source, problem.target, options);
  EXPECT_TRUE(outer.IsOptimal() && inner.IsOptimal());
  EXPECT_LE(static_cast<Eigen::Index>(most), outer.num_inliers);
  EXPECT_GE(static_cast<Eigen::Index>(most), inner.num_inliers);
}

INSTANTIATE_TEST_SUITE_P(Seeds, MaxConsensusSeed, ::testing::Range(0, 5));

TEST(MaxConsensus, NothingFromNothing) {
  const MaxConsensus none = FindMaxConsensus(Points(3, 0), Points(3, 0), {});
  EXPECT_EQ(none.num_inliers, 0);
  EXPECT_TRUE(none.IsOptimal());
  const MaxConsensus one =
      FindMaxConsensus(Points::Ones(3, 1), Points::Zero(3, 1), {});
  EXPECT_EQ(one.num_inliers, 1);
  EXPECT_TRUE(one.IsOptimal());
}

TEST(MaxConsensus, SaysWhenItStoppedEarly) {
  const KnownProblem problem =
      MakeMatchedProblem({.num_inliers = 3, .num_outliers = 400}, 7);
  MaxConsensusOptions options;
  options.max_num_intervals = 64;
  const MaxConsensus found =
      FindMaxConsensus(problem.source, problem.target, options);
  EXPECT_FALSE(found.IsOptimal());
  EXPECT_GE(found.upper_bound,
            FindMaxConsensus(problem.source, problem.target, {}).num_inliers);
}

TEST(MaxConsensusOptions, ErrorsNameTheField) {
  MaxConsensusOptions options;
  std::string error;
  EXPECT_TRUE(options.IsValid(&error)) << error;
  options.noise_bound = -1.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("noise_bound = -1"));
  options = {};
  options.min_width = 0.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("min_width = 0"));
  options = {};
  options.max_num_intervals = 0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("max_num_intervals = 0"));
}

}  // namespace
}  // namespace quatro::max_consensus_test
