// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/geometric_score.h"

#include <gtest/gtest.h>

#include <cmath>

#include "features/neighborhoods.h"
#include "features/normals.h"
#include "tests/support/described_clouds.h"
#include "tests/support/random_problems.h"

namespace quatro::geometric_score_test {
namespace {

constexpr double kMaxDistance = 0.5;
constexpr double kVoxelSize = 0.3;

DescribedCloud Street(const Rigid3& cloud_from_street,
                      std::uint64_t seed,
                      bool is_scan = true) {
  const Points points = cloud_from_street.Apply(RandomStreet(6000, 0.02, seed));
  const DescribedCloud cloud = MakeDescribedCloud(points, Points());
  const Points normals = EstimateNormals(
      points, FindNeighborhoods(*cloud.tree, 0.9, 1), 0.9, {0, 0, 0}, 1);
  return MakeDescribedCloud(points, normals, {0, 0, 0}, is_scan);
}

GeometricScorer MakeScorer(const DescribedCloud& source,
                           const DescribedCloud& target) {
  return GeometricScorer(source, target, kMaxDistance, kVoxelSize, 1);
}

TEST(GeometricScore, IsTheProductOfItsParts) {
  GeometricScore score;
  score.overlap = 0.5;
  score.contradicted_share = 0.2;
  EXPECT_NEAR(score.value(), 0.5 * std::pow(0.8, 5.0), 1e-15);
}

TEST(GeometricScore, IsHighestAtTheTruePose) {
  const Rigid3 truth{RotationZ(0.3), {0.5, -0.4, 0.1}};
  const DescribedCloud source = Street(Inverse(truth), 1);
  const DescribedCloud target = Street(Rigid3(), 2);
  const GeometricScorer scorer = MakeScorer(source, target);
  const double at_truth = scorer.At(truth).value();
  EXPECT_GT(at_truth, 0.6);
  for (int k = 0; k < 12; ++k) {
    const double azimuth = k * M_PI / 6.0;
    Rigid3 shifted = truth;
    shifted.translation +=
        3.0 * Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0.0);
    EXPECT_LT(scorer.At(shifted).value(), 0.7 * at_truth) << azimuth;
    if (k == 0) continue;
    const Rigid3 turned = Rigid3{RotationZ(azimuth), {0, 0, 0}} * truth;
    EXPECT_LT(scorer.At(turned).value(), 0.7 * at_truth) << azimuth;
  }
}

TEST(GeometricScore, SwappedCloudsGiveTheSame) {
  const Rigid3 truth{RotationZ(0.3), {0.5, -0.4, 0.1}};
  const DescribedCloud source = Street(Inverse(truth), 1);
  const DescribedCloud target = Street(Rigid3(), 2);
  for (const double shift : {0.0, 0.3, 1.0, 2.5}) {
    Rigid3 pose = truth;
    pose.translation.x() += shift;
    const GeometricScore score = MakeScorer(source, target).At(pose);
    const GeometricScore swapped = MakeScorer(target, source).At(Inverse(pose));
    EXPECT_DOUBLE_EQ(swapped.overlap, score.overlap);
    EXPECT_DOUBLE_EQ(swapped.contradicted_share, score.contradicted_share);
  }
}

// A wall that stands where the other scan saw the wall behind it.
TEST(GeometricScore, StructureInFreeSpaceCostsTwice) {
  const DescribedCloud target = Street(Rigid3(), 2);
  const DescribedCloud scan = Street(Rigid3(), 1);
  const DescribedCloud no_scan = Street(Rigid3(), 1, /*is_scan=*/false);
  Rigid3 pose;
  pose.translation.x() = 3.0;
  const GeometricScore seen = MakeScorer(scan, target).At(pose);
  EXPECT_GT(seen.contradicted_share, 0.1);
  EXPECT_LT(seen.value(), 0.9 * seen.overlap);
  // Neither is a scan: nothing is known to be free.
  const DescribedCloud no_target = Street(Rigid3(), 2, /*is_scan=*/false);
  const GeometricScore unseen = MakeScorer(no_scan, no_target).At(pose);
  EXPECT_EQ(unseen.contradicted_share, 0.0);
  EXPECT_EQ(unseen.value(), unseen.overlap);
  EXPECT_EQ(unseen.overlap, seen.overlap);
}

TEST(GeometricScore, NothingInRangeScoresNothing) {
  const DescribedCloud cloud = Street(Rigid3(), 1);
  Rigid3 pose;
  pose.translation.x() = 500.0;
  EXPECT_EQ(MakeScorer(cloud, cloud).At(pose).value(), 0.0);
  // Ground alone is no structure.
  Points ground(3, 500), up(3, 500);
  Random random(3);
  for (Eigen::Index i = 0; i < 500; ++i) {
    ground.col(i) << 20.0 * random.Uniform() - 10.0,
        20.0 * random.Uniform() - 10.0, -2.0;
    up.col(i) = Eigen::Vector3d::UnitZ();
  }
  const DescribedCloud flat = MakeDescribedCloud(ground, up);
  EXPECT_EQ(MakeScorer(flat, flat).At(Rigid3()).value(), 0.0);
}

}  // namespace
}  // namespace quatro::geometric_score_test
