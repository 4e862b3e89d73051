// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "features/kd_tree.h"
#include "features/normals.h"
#include "tests/support/described_clouds.h"
#include "tests/support/random_problems.h"

namespace quatro::overlap_test {
namespace {

constexpr double kMaxDistance = 0.5;  // [m]

DescribedCloud MakeScan(const Points& points) {
  const KdTree tree(points);
  return MakeDescribedCloud(points,
                            EstimateNormals(points,
                                            FindNeighborhoods(tree, 1.0, 1),
                                            1.0,
                                            Eigen::Vector3d::Zero(),
                                            1));
}

// The smaller of the shares of the two scans.
std::optional<double> MeasureStructureOverlap(const DescribedCloud& source,
                                              const DescribedCloud& target,
                                              const Rigid3& target_from_source,
                                              double max_distance,
                                              int num_threads) {
  if (source.points().cols() == 0 || target.points().cols() == 0) {
    return std::nullopt;
  }
  const auto of_source = OverlapShare(FindStructure(
      source, target, target_from_source, max_distance, num_threads));
  const auto of_target = OverlapShare(FindStructure(
      target, source, Inverse(target_from_source), max_distance, num_threads));
  if (!of_source || !of_target) return std::nullopt;
  return std::min(*of_source, *of_target);
}

// Two scans of a street corner from different places.
class StructureOverlapTest : public ::testing::Test {
 protected:
  const Rigid3 target_from_source_{RotationZ(0.6), {1.0, -0.5, 0.1}};
  const DescribedCloud source_ = MakeScan(
      Inverse(target_from_source_).Apply(RandomStreet(4000, 0.02, /*seed=*/1)));
  const DescribedCloud target_ = MakeScan(RandomStreet(4000, 0.02, /*seed=*/2));

  double Overlap(const Rigid3& target_from_source) const {
    const auto overlap = MeasureStructureOverlap(
        source_, target_, target_from_source, kMaxDistance, 1);
    EXPECT_TRUE(overlap.has_value());
    return overlap.value_or(-1.0);
  }
};

TEST_F(StructureOverlapTest, OfAScanWithItselfIsAll) {
  EXPECT_EQ(
      MeasureStructureOverlap(target_, target_, Rigid3(), kMaxDistance, 1),
      1.0);
}

TEST_F(StructureOverlapTest, IsHighForTheRightPose) {
  EXPECT_GT(Overlap(target_from_source_), 0.8);
}

TEST_F(StructureOverlapTest, IsLowForAWrongPose) {
  const Rigid3 turned{RotationZ(0.7), Eigen::Vector3d::Zero()};
  EXPECT_LT(Overlap(turned * target_from_source_), 0.25);
  const Rigid3 moved{Eigen::Matrix3d::Identity(), {2.0, -2.0, 0.0}};
  EXPECT_LT(Overlap(moved * target_from_source_), 0.25);
}

TEST_F(StructureOverlapTest, FallsWithTheDistanceThatIsAllowed) {
  const auto strict =
      MeasureStructureOverlap(source_, target_, target_from_source_, 0.1, 1);
  EXPECT_LT(*strict, Overlap(target_from_source_));
}

TEST_F(StructureOverlapTest, SwappingSourceAndTargetKeepsIt) {
  for (const double yaw : {0.0, 0.1, 0.7}) {
    const Rigid3 pose =
        Rigid3{RotationZ(yaw), Eigen::Vector3d::Zero()} * target_from_source_;
    const auto swapped = MeasureStructureOverlap(
        target_, source_, Inverse(pose), kMaxDistance, 1);
    // Rounding may move one or two points across a limit.
    EXPECT_NEAR(*swapped, Overlap(pose), 2e-3) << "off by " << yaw << " rad";
  }
}

TEST_F(StructureOverlapTest, NumberOfThreadsDoesNotMatter) {
  for (const int num_threads : {0, 2, 3}) {
    EXPECT_EQ(
        MeasureStructureOverlap(
            source_, target_, target_from_source_, kMaxDistance, num_threads),
        Overlap(target_from_source_));
  }
}

TEST_F(StructureOverlapTest, GroundIsNoEvidence) {
  const DescribedCloud ground =
      MakeScan(RandomPlane(2000, 20.0, /*seed=*/3).points.colwise() -
               Eigen::Vector3d(0.0, 0.0, 2.0));
  EXPECT_FALSE(
      MeasureStructureOverlap(ground, ground, Rigid3(), kMaxDistance, 1)
          .has_value());
  EXPECT_FALSE(
      MeasureStructureOverlap(target_, ground, Rigid3(), kMaxDistance, 1)
          .has_value());
}

TEST_F(StructureOverlapTest, ScansThatAreFarApartSayNothing) {
  const Rigid3 away{Eigen::Matrix3d::Identity(), {1000.0, 0.0, 0.0}};
  EXPECT_FALSE(MeasureStructureOverlap(source_, target_, away, kMaxDistance, 1)
                   .has_value());
}

TEST_F(StructureOverlapTest, WithoutPointsThereIsNone) {
  const DescribedCloud empty = MakeScan(Points(3, 0));
  EXPECT_FALSE(
      MeasureStructureOverlap(empty, target_, Rigid3(), kMaxDistance, 1)
          .has_value());
  EXPECT_FALSE(
      MeasureStructureOverlap(target_, empty, Rigid3(), kMaxDistance, 1)
          .has_value());
}

TEST_F(StructureOverlapTest, SurfacesThatCrossAreNotMet) {
  // The same points with all normals rotated by 90 deg.
  const Points turned_normals = RotationZ(M_PI / 2) * target_.normals;
  const DescribedCloud turned =
      MakeDescribedCloud(target_.points(), turned_normals);
  EXPECT_LT(
      *MeasureStructureOverlap(turned, target_, Rigid3(), kMaxDistance, 1),
      0.1);
}

}  // namespace
}  // namespace quatro::overlap_test
