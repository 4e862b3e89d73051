// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/minimal_pose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>

#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::minimal_pose_test {
namespace {

using ::testing::HasSubstr;

using Columns3 = std::array<Eigen::Index, 3>;

constexpr MinimalSample kSamples[] = {MinimalSample::kThreePoints,
                                      MinimalSample::kTwoPoints,
                                      MinimalSample::kPointAndNormal};

// All matches are inliers, and the normals are rotated by the yaw.
struct ExactMatches {
  KnownProblem problem;
  MatchedNormals normals;
};

ExactMatches MakeExactMatches(std::uint64_t seed) {
  ExactMatches exact;
  exact.problem = MakeMatchedProblem(
      {.num_inliers = 6, .num_outliers = 0, .noise = 0.0}, seed);
  exact.normals.source = Points::Zero(3, 6);
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Eigen::Vector3d direction =
        RandomDirection(10 * seed + static_cast<std::uint64_t>(i));
    // No steeper than 45 deg.
    exact.normals.source.col(i) =
        Eigen::Vector3d(direction.x(), direction.y(), 0.0).normalized() +
        Eigen::Vector3d(0.0, 0.0, direction.z());
  }
  exact.normals.source.colwise().normalize();
  exact.normals.target =
      exact.problem.true_target_from_source.rotation * exact.normals.source;
  return exact;
}

Columns3 FirstColumns(MinimalSample sample) {
  Columns3 columns = {-1, -1, -1};
  for (int k = 0; k < SampleSize(sample); ++k) {
    columns[static_cast<std::size_t>(k)] = k;
  }
  return columns;
}

TEST(DrawSample, EveryOrderedSampleIsAsLikely) {
  for (const MinimalSample sample : kSamples) {
    constexpr int kNumDraws = 60'000;
    std::map<Columns3, int> counts;
    Random random(7);
    for (int k = 0; k < kNumDraws; ++k) {
      ++counts[DrawSample(sample, 5, &random)];
    }
    std::size_t num_samples = 1;
    for (int k = 0; k < SampleSize(sample); ++k) {
      num_samples *= static_cast<std::size_t>(5 - k);
    }
    ASSERT_EQ(counts.size(), num_samples);
    const double expected = kNumDraws / static_cast<double>(num_samples);
    for (const auto& [columns, count] : counts) {
      for (int k = 0; k < 3; ++k) {
        const Eigen::Index column = columns[static_cast<std::size_t>(k)];
        EXPECT_EQ(column >= 0, k < SampleSize(sample));
        EXPECT_LT(column, 5);
        for (int j = 0; j < k && column >= 0; ++j) {
          EXPECT_NE(column, columns[static_cast<std::size_t>(j)]);
        }
      }
      EXPECT_NEAR(count, expected, 5.0 * std::sqrt(expected));
    }
  }
}

TEST(EstimateMinimalPose, RightMatchesGiveTheirPose) {
  for (const MinimalSample sample : kSamples) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const ExactMatches exact = MakeExactMatches(seed);
      MinimalPoseOptions options;
      options.sample = sample;
      const auto pose = EstimateMinimalPose(exact.problem.source,
                                            exact.problem.target,
                                            &exact.normals,
                                            FirstColumns(sample),
                                            options);
      ASSERT_TRUE(pose.has_value()) << SampleSize(sample) << ", " << seed;
      EXPECT_LE(LargestDisplacement(*pose,
                                    exact.problem.true_target_from_source,
                                    exact.problem.source),
                1e-10)
          << SampleSize(sample) << ", " << seed;
    }
  }
}

// Each end has an error of at most the bound, in any direction: (1) accepts
// all.
TEST(EstimateMinimalPose, BoundDropsNoSampleWithinIt) {
  for (const MinimalSample sample :
       {MinimalSample::kThreePoints, MinimalSample::kTwoPoints}) {
    MinimalPoseOptions options;
    options.sample = sample;
    options.edge_test = EdgeTest::kBound;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
      ExactMatches exact = MakeExactMatches(seed);
      for (Eigen::Index i = 0; i < 3; ++i) {
        exact.problem.target.col(i) +=
            0.999 * options.noise_bound *
            RandomDirection(3 * seed + static_cast<std::uint64_t>(i));
      }
      EXPECT_TRUE(EstimateMinimalPose(exact.problem.source,
                                      exact.problem.target,
                                      nullptr,
                                      FirstColumns(sample),
                                      options)
                      .has_value())
          << seed;
    }
  }
}

class EdgeTestTest : public ::testing::Test {
 protected:
  // Whether a pair of sides `a` and `b` from the origin passes.
  bool Passes(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    Points source = Points::Zero(3, 3);
    Points target = Points::Zero(3, 3);
    source.col(1) = a;
    target.col(1) = b;
    // The third point is equally far from both, in either cloud.
    const Eigen::Vector3d across = 50.0 * Eigen::Vector3d::UnitY();
    source.col(2) = 0.5 * a + across;
    target.col(2) = 0.5 * b + across;
    return EstimateMinimalPose(
               source, target, nullptr, FirstColumns(options_.sample), options_)
        .has_value();
  }

  MinimalPoseOptions options_;
};

TEST_F(EdgeTestTest, BoundIsOfTheDifference) {
  options_.edge_test = EdgeTest::kBound;
  EXPECT_TRUE(Passes({40.0, 0.0, 0.0}, {40.59, 0.0, 0.0}));
  EXPECT_FALSE(Passes({40.0, 0.0, 0.0}, {40.61, 0.0, 0.0}));
  EXPECT_FALSE(Passes({40.61, 0.0, 0.0}, {40.0, 0.0, 0.0}));
  EXPECT_TRUE(Passes({1.0, 0.0, 0.0}, {1.59, 0.0, 0.0}));
}

TEST_F(EdgeTestTest, RatioIsOfTheLengths) {
  options_.edge_test = EdgeTest::kRatio;
  EXPECT_TRUE(Passes({40.0, 0.0, 0.0}, {44.0, 0.0, 0.0}));
  EXPECT_FALSE(Passes({40.0, 0.0, 0.0}, {44.5, 0.0, 0.0}));
  EXPECT_FALSE(Passes({44.5, 0.0, 0.0}, {40.0, 0.0, 0.0}));
  EXPECT_FALSE(Passes({1.0, 0.0, 0.0}, {1.2, 0.0, 0.0}));
  options_.edge_similarity = 0.8;
  EXPECT_TRUE(Passes({1.0, 0.0, 0.0}, {1.2, 0.0, 0.0}));
}

TEST_F(EdgeTestTest, NoneKeepsAll) {
  options_.edge_test = EdgeTest::kNone;
  EXPECT_TRUE(Passes({40.0, 0.0, 0.0}, {4.0, 0.0, 0.0}));
}

TEST_F(EdgeTestTest, HeightsOfYawSamplesAgreeUpToTheTilt) {
  for (const EdgeTest test : {EdgeTest::kBound, EdgeTest::kRatio}) {
    options_.edge_test = test;
    options_.sample = MinimalSample::kThreePoints;
    // Of equal length, but rotated out of the plane by 0.1 rad.
    const Eigen::Vector3d flat(20.0, 0.0, 0.0);
    const Eigen::Vector3d steep(
        20.0 * std::cos(0.1), 0.0, 20.0 * std::sin(0.1));
    EXPECT_TRUE(Passes(flat, steep));
    options_.sample = MinimalSample::kTwoPoints;
    EXPECT_FALSE(Passes(flat, steep));
    options_.max_tilt = 0.1;
    EXPECT_TRUE(Passes(flat, steep));
    options_.max_tilt = MinimalPoseOptions().max_tilt;
  }
}

TEST_F(EdgeTestTest, PlanarLengthsOfYawSamplesAgree) {
  options_.edge_test = EdgeTest::kBound;
  options_.sample = MinimalSample::kTwoPoints;
  options_.max_tilt = M_PI / 2;  // Any height difference passes.
  const Eigen::Vector3d flat(20.0, 0.0, 0.0);
  EXPECT_FALSE(Passes(flat, {16.0, 0.0, 12.0}));
  EXPECT_TRUE(Passes(flat, {19.5, 0.0, 4.4}));
}

TEST(EstimateMinimalPose, SamplesThatHoldNothingGiveNothing) {
  MinimalPoseOptions options;
  const Points line{{0.0, 1.0, 3.0}, {0.0, 1.0, 3.0}, {0.0, 2.0, 6.0}};
  EXPECT_FALSE(
      EstimateMinimalPose(line, line, nullptr, {0, 1, 2}, options).has_value());
  options.sample = MinimalSample::kTwoPoints;
  const Points vertical{{1.0, 1.0}, {2.0, 2.0}, {0.0, 5.0}};
  EXPECT_FALSE(
      EstimateMinimalPose(vertical, vertical, nullptr, {0, 1, -1}, options)
          .has_value());
}

TEST(EstimateMinimalPose, NormalsMustHaveAHeadingAndTheSameSlope) {
  MinimalPoseOptions options;
  options.sample = MinimalSample::kPointAndNormal;
  const Points point = Points::Ones(3, 1);
  const auto passes = [&](double source_slope, double target_slope) {
    const MatchedNormals normals{
        Eigen::Vector3d(std::cos(source_slope), 0.0, std::sin(source_slope)),
        Eigen::Vector3d(0.0, std::cos(target_slope), std::sin(target_slope))};
    return EstimateMinimalPose(point, point, &normals, {0, -1, -1}, options)
        .has_value();
  };
  EXPECT_TRUE(passes(0.0, 0.0));
  EXPECT_TRUE(passes(0.0, 0.19));
  EXPECT_FALSE(passes(0.0, 0.21));
  EXPECT_FALSE(passes(0.21, 0.0));
  EXPECT_TRUE(passes(1.0, 1.0));   // cos = 0.54
  EXPECT_FALSE(passes(1.1, 1.1));  // cos = 0.45
}

TEST(MinimalPoseOptions, ErrorNamesTheField) {
  std::string error;
  EXPECT_TRUE(MinimalPoseOptions().IsValid(&error)) << error;
  const auto expect_error =
      [](double MinimalPoseOptions::*field, double value, const char* text) {
        MinimalPoseOptions options;
        options.*field = value;
        std::string message;
        EXPECT_FALSE(options.IsValid(&message)) << text;
        EXPECT_THAT(message, HasSubstr(text));
      };
  using O = MinimalPoseOptions;
  expect_error(&O::noise_bound, 0.0, "noise_bound = 0");
  expect_error(&O::noise_bound,
               std::numeric_limits<double>::infinity(),
               "noise_bound = inf");
  expect_error(&O::edge_similarity, 1.5, "edge_similarity = 1.5");
  expect_error(&O::max_tilt, -1.0, "max_tilt = -1");
  expect_error(&O::min_normal_xy, 0.0, "min_normal_xy = 0");
  expect_error(
      &O::max_normal_z_difference, -0.1, "max_normal_z_difference = -0.1");
}

}  // namespace
}  // namespace quatro::minimal_pose_test
