// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/segment_consensus.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "features/base/degree.h"
#include "tests/support/random_problems.h"

namespace quatro::segment_consensus_test {
namespace {

using ::testing::IsEmpty;

constexpr double kBound = 0.6;  // [m]

// A random wall within 40 m, of two directions of a street turned by 20 deg and
// of others.
Wall RandomWall(Random& random) {
  Wall wall;
  const double azimuth =
      random.Uniform() < 0.5
          ? 20.0 * kDegree + 0.5 * M_PI * static_cast<double>(random.Below(4))
          : 2.0 * M_PI * random.Uniform();
  wall.normal = {std::cos(azimuth), std::sin(azimuth)};
  wall.offset = 40.0 * (random.Uniform() - 0.5);
  wall.begin = 40.0 * (random.Uniform() - 0.5);
  wall.end = wall.begin + 5.0 + 15.0 * random.Uniform();
  wall.bottom = -1.5;
  wall.top = 3.0 + random.Uniform();
  return wall;
}

Post RandomPost(Random& random) {
  Post post;
  post.center = {60.0 * (random.Uniform() - 0.5),
                 60.0 * (random.Uniform() - 0.5)};
  post.width = 0.3;
  post.bottom = -1.5;
  post.top = 2.0 + 2.0 * random.Uniform();
  post.is_pole = random.Uniform() < 0.5;
  return post;
}

Wall Moved(const Wall& wall, const Rigid3& pose) {
  Wall moved = wall;
  const Eigen::Vector2d shift = pose.translation.head<2>();
  moved.normal = pose.rotation.topLeftCorner<2, 2>() * wall.normal;
  moved.offset += moved.normal.dot(shift);
  const double along =
      Eigen::Vector2d(-moved.normal.y(), moved.normal.x()).dot(shift);
  moved.begin += along;
  moved.end += along;
  moved.bottom += pose.translation.z();
  moved.top += pose.translation.z();
  return moved;
}

Post Moved(const Post& post, const Rigid3& pose) {
  Post moved = post;
  moved.center = pose.rotation.topLeftCorner<2, 2>() * post.center +
                 pose.translation.head<2>();
  moved.bottom += pose.translation.z();
  moved.top += pose.translation.z();
  return moved;
}

struct SegmentProblem {
  Segments source;
  Segments target;
  Rigid3 truth;
};

// `num_shared` walls and twice as many posts are in both scans; as many others
// are in one of them.
SegmentProblem MakeProblem(int num_shared, std::uint64_t seed) {
  Random random(seed);
  SegmentProblem problem;
  problem.truth.rotation = RotationZ(2.0 * M_PI * random.Uniform());
  problem.truth.translation = {30.0 * (random.Uniform() - 0.5),
                               30.0 * (random.Uniform() - 0.5),
                               random.Uniform() - 0.5};
  for (int k = 0; k < num_shared; ++k) {
    problem.source.walls.push_back(RandomWall(random));
    problem.target.walls.push_back(
        Moved(problem.source.walls.back(), problem.truth));
    problem.source.walls.push_back(RandomWall(random));
    problem.target.walls.push_back(RandomWall(random));
    for (int twice = 0; twice < 2; ++twice) {
      problem.source.posts.push_back(RandomPost(random));
      problem.target.posts.push_back(
          Moved(problem.source.posts.back(), problem.truth));
      problem.source.posts.push_back(RandomPost(random));
      problem.target.posts.push_back(RandomPost(random));
    }
  }
  return problem;
}

void ExpectSame(const Rigid3& pose, const Rigid3& truth, double tolerance) {
  EXPECT_LT(AngleBetween(pose.rotation, truth.rotation), tolerance);
  EXPECT_LT((pose.translation - truth.translation).norm(), tolerance);
}

TEST(SegmentConsensus, TheFirstProposalIsThePose) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const SegmentProblem problem = MakeProblem(6, seed);
    const SegmentConsensus consensus(problem.source, problem.target, kBound);
    const std::vector<Rigid3> proposed = consensus.Propose(5);
    ASSERT_FALSE(proposed.empty()) << seed;
    // Segments of chance may agree, too.
    ExpectSame(proposed[0], problem.truth, 0.05);
  }
}

// Without others, the fit is exact.
TEST(SegmentConsensus, TheFitIsOfLeastSquares) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SegmentProblem problem;
    Random random(seed);
    problem.truth = {RotationZ(6.0 * random.Uniform()), {9.0, -4.0, 0.3}};
    for (int k = 0; k < 4; ++k) {
      problem.source.posts.push_back(RandomPost(random));
      problem.source.posts.back().is_pole = k % 2 == 0;
      problem.target.posts.push_back(
          Moved(problem.source.posts.back(), problem.truth));
    }
    Wall wall = RandomWall(random);
    problem.source.walls.push_back(wall);
    problem.target.walls.push_back(Moved(wall, problem.truth));
    const std::vector<Rigid3> proposed =
        SegmentConsensus(problem.source, problem.target, kBound).Propose(1);
    ASSERT_FALSE(proposed.empty()) << seed;
    ExpectSame(proposed[0], problem.truth, 1e-4);
  }
}

TEST(SegmentConsensus, TheTruthIsSupportedMoreThanOtherPoses) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const SegmentProblem problem = MakeProblem(5, seed);
    const SegmentConsensus consensus(problem.source, problem.target, kBound);
    const double ratio = consensus.LogLikelihoodRatio(problem.truth);
    EXPECT_GT(ratio, 5.0) << seed;
    Rigid3 other = problem.truth;
    other.translation.x() += 3.0;
    EXPECT_LT(consensus.LogLikelihoodRatio(other), ratio) << seed;
    other = problem.truth;
    other.rotation = other.rotation * RotationZ(20.0 * kDegree);
    EXPECT_LT(consensus.LogLikelihoodRatio(other), ratio) << seed;
    // Height and tilt are not compared.
    other = problem.truth;
    other.translation.z() += 5.0;
    EXPECT_EQ(consensus.LogLikelihoodRatio(other), ratio) << seed;
  }
}

TEST(SegmentConsensus, SwappedScansGiveTheInverse) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const SegmentProblem problem = MakeProblem(6, seed);
    const std::vector<Rigid3> proposed =
        SegmentConsensus(problem.target, problem.source, kBound).Propose(1);
    ASSERT_FALSE(proposed.empty()) << seed;
    ExpectSame(Inverse(proposed[0]), problem.truth, 0.1);
  }
}

// Parallel walls alone leave a translation free.
TEST(SegmentConsensus, ParallelWallsProposeNothing) {
  SegmentProblem problem;
  Random random(3);
  for (int k = 0; k < 6; ++k) {
    Wall wall = RandomWall(random);
    wall.normal = {1.0, 0.0};
    wall.offset = 5.0 * k;
    problem.source.walls.push_back(wall);
  }
  problem.target = problem.source;
  EXPECT_THAT(
      SegmentConsensus(problem.source, problem.target, kBound).Propose(9),
      IsEmpty());
}

TEST(SegmentConsensus, WithoutSegmentsThereIsNoSupport) {
  const SegmentProblem problem = MakeProblem(3, 1);
  for (const SegmentConsensus& consensus :
       {SegmentConsensus({}, {}, kBound),
        SegmentConsensus(problem.source, {}, kBound),
        SegmentConsensus({}, problem.target, kBound)}) {
    EXPECT_THAT(consensus.Propose(9), IsEmpty());
    EXPECT_EQ(consensus.LogLikelihoodRatio(problem.truth), 0.0);
  }
}

// The memory of the cells is bounded; far segments give no votes.
TEST(SegmentConsensus, FarSegmentsAreNotFound) {
  SegmentProblem problem = MakeProblem(4, 2);
  for (Post& post : problem.target.posts) {
    post.center += Eigen::Vector2d(1e9, std::numeric_limits<double>::max());
  }
  for (Wall& wall : problem.target.walls) wall.offset += 1e12;
  EXPECT_THAT(
      SegmentConsensus(problem.source, problem.target, kBound).Propose(9),
      IsEmpty());
}

// So is the time: a bound far below the length of a wall does not make it vote
// for billions of cells.
TEST(SegmentConsensus, ATinyNoiseBoundEnds) {
  const SegmentProblem problem = MakeProblem(4, 2);
  const SegmentConsensus consensus(problem.source, problem.target, 1e-9);
  for (const auto& pose : consensus.Propose(9)) {
    EXPECT_TRUE(pose.ToMatrix().allFinite());
  }
}

}  // namespace
}  // namespace quatro::segment_consensus_test
