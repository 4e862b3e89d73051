// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/consensus_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/random_problems.h"

namespace quatro::consensus_search_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

double Uniform(double low, double high, Random* random) {
  return low + (high - low) * random->Uniform();
}

struct Problem {
  Points source;
  Points target;
};

// `num_true` matches of the pose with errors of at most 0.2 m on each axis, and
// others of random points within 40 m.
Problem MakeProblem(const Rigid3& pose,
                    Eigen::Index num_true,
                    Eigen::Index num_false,
                    std::uint64_t seed) {
  Random random(seed);
  const Eigen::Vector3d box(40.0, 40.0, 3.0);
  const Eigen::Index n = num_true + num_false;
  Problem problem{Points(3, n), Points(3, n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      problem.source(axis, i) = Uniform(-box[axis], box[axis], &random);
      problem.target(axis, i) = Uniform(-box[axis], box[axis], &random);
    }
    if (i >= num_true) continue;
    problem.target.col(i) = pose * Eigen::Vector3d(problem.source.col(i));
    for (int axis = 0; axis < 3; ++axis) {
      problem.target(axis, i) += Uniform(-0.2, 0.2, &random);
    }
  }
  return problem;
}

std::vector<Proposal> Search(const Problem& problem,
                             const ConsensusSearchOptions& options = {}) {
  return SearchConsensus(problem.source, problem.target, options);
}

double YawOf(const Proposal& proposal) {
  return Yaw(proposal.target_from_source.rotation);
}

bool IsNear(const Rigid3& a, const Rigid3& b) {
  return std::abs(std::remainder(Yaw(a.rotation) - Yaw(b.rotation),
                                 2.0 * M_PI)) < 0.03 &&
         (a.translation - b.translation).norm() < 0.5;
}

// A proposal's own ratio is that of its pose, if no tilt is allowed for.
TEST(ConsensusLogLikelihoodRatio, IsThatOfTheProposal) {
  const Problem problem =
      MakeProblem({RotationZ(1.0), {12.0, -7.0, 0.5}}, 40, 1000, 3);
  ConsensusSearchOptions options;
  options.max_tilt = 0.0;
  options.max_num_proposals = 20;
  const std::vector<Proposal> proposals = Search(problem, options);
  ASSERT_GT(proposals.size(), 5u);
  const auto ratio_of = [&](const Eigen::Matrix3d& turn_source,
                            const Proposal& proposal,
                            const ConsensusSearchOptions& by) {
    const Rigid3& pose = proposal.target_from_source;
    return ConsensusLogLikelihoodRatio(
        turn_source * problem.source,
        problem.target,
        {pose.rotation * turn_source.transpose(), pose.translation},
        by);
  };
  // The medians of rotated points are others.
  options.source_center = Eigen::Vector3d(1.0, 2.0, 0.0);
  options.target_center = Eigen::Vector3d(-1.0, 0.0, 1.0);
  for (const Proposal& proposal : Search(problem, options)) {
    EXPECT_GT(proposal.log_likelihood_ratio, 0.0);
    // Single precision may move a match across the bound.
    EXPECT_NEAR(ratio_of(Eigen::Matrix3d::Identity(), proposal, options),
                proposal.log_likelihood_ratio,
                2.0);
  }
  // A tilt of the source that the pose takes back changes nothing.
  const Eigen::Matrix3d tilt =
      Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()).toRotationMatrix();
  ConsensusSearchOptions tilted = options;
  tilted.source_center = tilt * *options.source_center;
  for (const Proposal& proposal : proposals) {
    EXPECT_NEAR(ratio_of(tilt, proposal, tilted),
                ratio_of(Eigen::Matrix3d::Identity(), proposal, options),
                1e-3 * proposal.log_likelihood_ratio);
  }
}

class ConsensusSearchSeed : public ::testing::TestWithParam<int> {};

TEST_P(ConsensusSearchSeed, FindsOnePercentOfTrueMatches) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  Random random(seed);
  const Rigid3 pose{RotationZ(Uniform(-M_PI, M_PI, &random)),
                    {Uniform(-50.0, 50.0, &random),
                     Uniform(-9.0, 9.0, &random),
                     Uniform(-2.0, 2.0, &random)}};
  const Problem problem = MakeProblem(pose, 25, 2475, seed + 100);
  const std::vector<Proposal> proposals = Search(problem);
  ASSERT_FALSE(proposals.empty());
  EXPECT_TRUE(IsNear(proposals.front().target_from_source, pose))
      << proposals.front().target_from_source.ToMatrix();
  // The true matches are inliers, and few others.
  const auto& inliers = proposals.front().inliers;
  EXPECT_TRUE(std::is_sorted(inliers.begin(), inliers.end()));
  for (Eigen::Index i = 0; i < 25; ++i) {
    EXPECT_TRUE(std::binary_search(inliers.begin(), inliers.end(), i)) << i;
  }
  EXPECT_LE(inliers.size(), 35u);
}

TEST_P(ConsensusSearchSeed, InliersAreThoseOfEquationOne) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const Problem problem =
      MakeProblem({RotationZ(1.0), {20.0, 3.0, 1.0}}, 30, 500, seed);
  ConsensusSearchOptions options;
  options.max_tilt = 0.05;
  int num_clear = 0;
  for (const Proposal& proposal : Search(problem, options)) {
    std::vector<Eigen::Index> expected;
    // Ranges are those from the middle of the source.
    Eigen::Vector3d middle;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> values(problem.source.row(axis).begin(),
                                 problem.source.row(axis).end());
      std::nth_element(
          values.begin(),
          values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
          values.end());
      middle[axis] = values[values.size() / 2];
    }
    const double r = options.noise_bound;
    bool is_close_call = false;
    for (Eigen::Index i = 0; i < problem.source.cols(); ++i) {
      const Eigen::Vector3d p = problem.source.col(i);
      const Eigen::Vector3d error =
          problem.target.col(i) - proposal.target_from_source * p;
      const double planar = error.head<2>().norm() - r;
      const double height =
          std::abs(error.z()) -
          (r + (p - middle).head<2>().norm() * std::tan(options.max_tilt));
      is_close_call |= std::abs(planar) < 1e-3 || std::abs(height) < 1e-3;
      if (planar <= 0.0 && height <= 0.0) expected.push_back(i);
    }
    if (is_close_call) continue;
    ++num_clear;
    EXPECT_EQ(proposal.inliers, expected);
  }
  EXPECT_GE(num_clear, 3);
}

TEST_P(ConsensusSearchSeed, ProposalsAreOrderedAndApart) {
  const Problem problem = MakeProblem({RotationZ(2.0), {10.0, -20.0, 0.0}},
                                      20,
                                      800,
                                      static_cast<std::uint64_t>(GetParam()));
  ConsensusSearchOptions options;
  options.max_num_proposals = 40;
  const std::vector<Proposal> proposals = Search(problem, options);
  EXPECT_EQ(proposals.size(), 40u);
  for (std::size_t i = 0; i < proposals.size(); ++i) {
    if (i > 0) {
      EXPECT_LE(proposals[i].log_likelihood_ratio,
                proposals[i - 1].log_likelihood_ratio);
    }
    for (std::size_t j = 0; j < i; ++j) {
      const double yaw = std::abs(
          std::remainder(YawOf(proposals[i]) - YawOf(proposals[j]), 2 * M_PI));
      const Eigen::Vector3d middle = Eigen::Vector3d::Zero();
      const double shift = (proposals[i].target_from_source * middle -
                            proposals[j].target_from_source * middle)
                               .norm();
      // The middle of the source is within a few metres of zero.
      EXPECT_TRUE(yaw > options.min_yaw_difference ||
                  shift >
                      options.min_shift_in_bounds * options.noise_bound - 0.5)
          << yaw << " " << shift;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ConsensusSearchSeed, ::testing::Range(0, 8));

TEST(ConsensusSearch, MovesWithTheClouds) {
  const Rigid3 pose{RotationZ(-0.7), {15.0, 4.0, 0.5}};
  const Problem problem = MakeProblem(pose, 30, 1000, 3);
  const Rigid3 a{RotationZ(0.9), {1000.0, -500.0, 70.0}};
  const Rigid3 b{RotationZ(-2.1), {-300.0, 20.0, 9.0}};
  const Problem moved{a.Apply(problem.source), b.Apply(problem.target)};
  const Rigid3 found = Search(problem).front().target_from_source;
  const Rigid3 moved_found = Search(moved).front().target_from_source;
  EXPECT_TRUE(IsNear(moved_found, b * found * Inverse(a)));
}

TEST(ConsensusSearch, ScalesWithTheBound) {
  const Rigid3 pose{RotationZ(0.7), {25.0, 4.0, 0.5}};
  Problem problem = MakeProblem(pose, 30, 1000, 3);
  const Rigid3 found = Search(problem).front().target_from_source;
  ConsensusSearchOptions options;
  options.noise_bound /= 256.0;
  problem.source /= 256.0;
  problem.target /= 256.0;
  const Rigid3 scaled = Search(problem, options).front().target_from_source;
  EXPECT_NEAR(Yaw(scaled.rotation), Yaw(found.rotation), 1e-12);
  EXPECT_LT((256.0 * scaled.translation - found.translation).norm(), 1e-9);
}

TEST(ConsensusSearch, SwappedCloudsGiveTheInverse) {
  const Rigid3 pose{RotationZ(2.7), {18.0, -14.0, 0.5}};
  const Problem problem = MakeProblem(pose, 30, 1000, 4);
  const Problem swapped{problem.target, problem.source};
  EXPECT_TRUE(IsNear(Search(swapped).front().target_from_source,
                     Inverse(Search(problem).front().target_from_source)));
}

TEST(ConsensusSearch, OrderDoesNotMatter) {
  const Problem problem =
      MakeProblem({RotationZ(2.7), {18.0, -14.0, 0.5}}, 30, 700, 5);
  const std::vector<Eigen::Index> order = RandomPermutation(730, 9);
  Problem shuffled = problem;
  for (Eigen::Index i = 0; i < 730; ++i) {
    const Eigen::Index from = order[static_cast<std::size_t>(i)];
    shuffled.source.col(i) = problem.source.col(from);
    shuffled.target.col(i) = problem.target.col(from);
  }
  const Proposal best = Search(problem).front();
  const Proposal same = Search(shuffled).front();
  std::set<Eigen::Index> inliers;
  for (const Eigen::Index i : same.inliers) {
    inliers.insert(order[static_cast<std::size_t>(i)]);
  }
  EXPECT_EQ(inliers,
            std::set<Eigen::Index>(best.inliers.begin(), best.inliers.end()));
  EXPECT_TRUE(IsNear(best.target_from_source, same.target_from_source));
}

TEST(ConsensusSearch, ThreadsChangeNoBit) {
  const Problem problem =
      MakeProblem({RotationZ(2.7), {18.0, -14.0, 0.5}}, 30, 700, 6);
  const std::vector<Proposal> one = Search(problem);
  for (const int num_threads : {0, 2, 3, 7}) {
    ConsensusSearchOptions options;
    options.num_threads = num_threads;
    const std::vector<Proposal> several = Search(problem, options);
    ASSERT_EQ(several.size(), one.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_EQ(several[k].target_from_source.ToMatrix(),
                one[k].target_from_source.ToMatrix());
      EXPECT_EQ(several[k].inliers, one[k].inliers);
    }
  }
}

// Rings of the ground: equal ranges in both clouds, azimuths at random.
TEST(ConsensusSearch, RingsAroundTheSensorAreNoConsensus) {
  const Rigid3 pose{RotationZ(0.4), {22.0, 3.0, 0.0}};
  Problem problem = MakeProblem(pose, 20, 1200, 7);
  Random random(8);
  for (Eigen::Index i = 20; i < problem.source.cols(); ++i) {
    const double range = 4.0 + 3.0 * static_cast<double>(i % 5);
    for (Points* points : {&problem.source, &problem.target}) {
      const double azimuth = Uniform(-M_PI, M_PI, &random);
      points->col(i) << range * std::cos(azimuth), range * std::sin(azimuth),
          -1.7;
    }
  }
  ConsensusSearchOptions options;
  options.source_center = Eigen::Vector3d::Zero();
  options.target_center = Eigen::Vector3d::Zero();
  const std::vector<Proposal> proposals = Search(problem, options);
  ASSERT_FALSE(proposals.empty());
  EXPECT_TRUE(IsNear(proposals.front().target_from_source, pose));
  // Though more matches coincide without any motion.
  std::size_t most = 0;
  for (double yaw = 0.0; yaw < 6.28; yaw += 0.02) {
    std::size_t num = 0;
    for (Eigen::Index i = 0; i < problem.source.cols(); ++i) {
      num += (problem.target.col(i) - RotationZ(yaw) * problem.source.col(i))
                 .norm() <= 0.6;
    }
    most = std::max(most, num);
  }
  EXPECT_GT(most, proposals.front().inliers.size());
}

TEST(ConsensusSearch, NothingFromNothing) {
  EXPECT_THAT(Search({Points(3, 0), Points(3, 0)}), IsEmpty());
  EXPECT_THAT(Search({Points::Zero(3, 1), Points::Zero(3, 1)}), IsEmpty());
  // Copies of one match determine no yaw.
  EXPECT_THAT(Search({Points::Ones(3, 9), Points::Ones(3, 9)}), IsEmpty());
}

TEST(ConsensusSearch, FarPointsAreLeftOut) {
  const Rigid3 pose{RotationZ(0.4), {12.0, 3.0, 0.0}};
  Problem problem = MakeProblem(pose, 30, 500, 8);
  for (Eigen::Index i = 500; i < 530; ++i) problem.target.col(i) *= 1e300;
  const std::vector<Proposal> proposals = Search(problem);
  ASSERT_FALSE(proposals.empty());
  EXPECT_TRUE(IsNear(proposals.front().target_from_source, pose));
}

TEST(ConsensusSearchOptions, ErrorsNameTheField) {
  const auto error_of = [](const auto& change) {
    ConsensusSearchOptions options;
    change(&options);
    std::string error;
    EXPECT_FALSE(options.IsValid(&error));
    return error;
  };
  EXPECT_THAT(error_of([](auto* o) { o->noise_bound = 0.0; }),
              HasSubstr("noise_bound = 0"));
  EXPECT_THAT(error_of([](auto* o) { o->max_tilt = 1.0; }),
              HasSubstr("max_tilt = 1"));
  EXPECT_THAT(error_of([](auto* o) { o->max_num_proposals = 0; }),
              HasSubstr("max_num_proposals = 0"));
  EXPECT_THAT(error_of([](auto* o) { o->min_yaw_difference = -1.0; }),
              HasSubstr("min_yaw_difference"));
  EXPECT_THAT(error_of([](auto* o) { o->num_threads = -1; }),
              HasSubstr("num_threads = -1"));
  std::string error;
  EXPECT_TRUE(ConsensusSearchOptions().IsValid(&error)) << error;
}

}  // namespace
}  // namespace quatro::consensus_search_test
