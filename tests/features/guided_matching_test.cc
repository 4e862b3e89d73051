// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/guided_matching.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "tests/support/print_match.h"
#include "tests/support/random_problems.h"

namespace quatro::guided_matching_test {
namespace {

using ::testing::IsEmpty;

constexpr double kRadius = 1.5;  // [m]

// Random points, normals and descriptors. Every ninth point has no normal and
// every eleventh no descriptor.
DescribedCloud MakeCloud(Eigen::Index n, std::uint64_t seed) {
  DescribedCloud cloud;
  cloud.tree = std::make_shared<const KdTree>(RandomPoints(n, 3.0, seed));
  cloud.normals = RandomPoints(n, 1.0, seed + 1).colwise().normalized();
  Random random(seed + 2);
  Fpfh descriptors = Fpfh::NullaryExpr(
      kFpfhSize, n, [&] { return static_cast<float>(random.Uniform()); });
  for (Eigen::Index i = 0; i < n; i += 9) cloud.normals.col(i).setZero();
  for (Eigen::Index i = 0; i < n; i += 11) descriptors.col(i).setZero();
  cloud.descriptors = std::make_shared<const Fpfh>(std::move(descriptors));
  return cloud;
}

Rigid3 Pose() { return {RandomRotation(7), {0.3, -0.2, 0.1}}; }

bool MayMatch(const DescribedCloud& source,
              const DescribedCloud& target,
              const Rigid3& pose,
              Eigen::Index i,
              Eigen::Index j) {
  return !source.normals.col(i).isZero(0.0) &&
         !target.normals.col(j).isZero(0.0) &&
         !source.descriptors->col(i).isZero(0.0f) &&
         !target.descriptors->col(j).isZero(0.0f) &&
         (pose * source.points().col(i) - target.points().col(j)).norm() <=
             kRadius &&
         std::abs((pose.rotation * source.normals.col(i))
                      .dot(target.normals.col(j))) >= std::cos(M_PI / 4.0);
}

// From the definition.
std::vector<Match> BruteForce(const DescribedCloud& source,
                              const DescribedCloud& target,
                              const Rigid3& pose) {
  const Eigen::Index n = source.points().cols();
  const Eigen::Index m = target.points().cols();
  Eigen::MatrixXf distance(n, m);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < m; ++j) {
      distance(i, j) =
          MayMatch(source, target, pose, i, j)
              ? (source.descriptors->col(i) - target.descriptors->col(j))
                    .squaredNorm()
              : std::numeric_limits<float>::infinity();
    }
  }
  std::vector<Match> matches;
  for (Eigen::Index i = 0; i < n; ++i) {
    Eigen::Index j = 0;
    Eigen::Index back = 0;
    if (std::isinf(distance.row(i).minCoeff(&j))) continue;
    distance.col(j).minCoeff(&back);
    if (back == i) {
      matches.push_back(
          {static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
    }
  }
  return matches;
}

TEST(MatchGuided, IsBruteForce) {
  const DescribedCloud source = MakeCloud(400, 1);
  const DescribedCloud target = MakeCloud(300, 11);
  const std::vector<Match> expected = BruteForce(source, target, Pose());
  EXPECT_GT(expected.size(), 50u);
  EXPECT_EQ(MatchGuided(source, target, Pose(), kRadius, 1), expected);
  EXPECT_EQ(MatchGuided(source, target, Pose(), kRadius, 3), expected);
}

TEST(MatchGuided, SwappedCloudsMatchTheOtherWayRound) {
  const DescribedCloud source = MakeCloud(400, 1);
  const DescribedCloud target = MakeCloud(300, 11);
  std::vector<Match> swapped;
  for (const Match& match :
       MatchGuided(target, source, Inverse(Pose()), kRadius, 1)) {
    swapped.push_back({match.target, match.source});
  }
  std::sort(swapped.begin(), swapped.end(), [](const Match& a, const Match& b) {
    return a.source < b.source;
  });
  EXPECT_EQ(swapped, MatchGuided(source, target, Pose(), kRadius, 1));
}

TEST(MatchGuided, OfACloudWithItselfIsTheIdentity) {
  const DescribedCloud cloud = MakeCloud(300, 1);
  std::size_t num_described = 0;
  for (Eigen::Index i = 0; i < 300; ++i) {
    num_described += MayMatch(cloud, cloud, Rigid3(), i, i);
  }
  const std::vector<Match> matches =
      MatchGuided(cloud, cloud, Rigid3(), kRadius, 1);
  EXPECT_EQ(matches.size(), num_described);
  for (const Match& match : matches) EXPECT_EQ(match.source, match.target);
}

TEST(MatchGuided, WithoutDescriptorsHasNoMatches) {
  const DescribedCloud cloud = MakeCloud(100, 1);
  DescribedCloud bare = cloud;
  bare.descriptors.reset();
  EXPECT_THAT(MatchGuided(bare, cloud, Rigid3(), kRadius, 1), IsEmpty());
  EXPECT_THAT(MatchGuided(cloud, bare, Rigid3(), kRadius, 1), IsEmpty());
}

TEST(MatchGuided, FarApartOrEmptyHasNoMatches) {
  const DescribedCloud cloud = MakeCloud(100, 1);
  const Rigid3 far{Eigen::Matrix3d::Identity(), {100.0, 0.0, 0.0}};
  EXPECT_THAT(MatchGuided(cloud, cloud, far, kRadius, 1), IsEmpty());
  const DescribedCloud empty = MakeCloud(0, 1);
  EXPECT_THAT(MatchGuided(empty, cloud, Rigid3(), kRadius, 1), IsEmpty());
  EXPECT_THAT(MatchGuided(cloud, empty, Rigid3(), kRadius, 1), IsEmpty());
}

}  // namespace
}  // namespace quatro::guided_matching_test
