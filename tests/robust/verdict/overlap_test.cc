// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/overlap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "features/kd_tree.h"
#include "features/normals.h"
#include "solvers/closed_form/gravity.h"
#include "tests/support/random_problems.h"

namespace quatro {
namespace {

constexpr double kMaxDistance = 0.5;  // [m]

struct Scan {
  explicit Scan(const Points& points)
      : tree(points),
        normals(EstimateNormals(points,
                                FindNeighborhoods(tree, 1.0, 1),
                                1.0,
                                Eigen::Vector3d::Zero(),
                                1)) {}
  operator DescribedCloud() const {
    return {Eigen::Vector3d::Zero(), tree, normals};
  }

  KdTree tree;
  Points normals;
};

// Two scans of a street corner from different places.
class StructureOverlapTest : public ::testing::Test {
 protected:
  const Rigid3 target_from_source_{RotationZ(0.6), {1.0, -0.5, 0.1}};
  const Scan source_{
      Inverse(target_from_source_).Apply(RandomStreet(4000, 0.02, /*seed=*/1))};
  const Scan target_{RandomStreet(4000, 0.02, /*seed=*/2)};

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
  const Scan ground(RandomPlane(2000, 20.0, /*seed=*/3).points.colwise() -
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
  const Scan empty(Points(3, 0));
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
  const DescribedCloud turned{
      Eigen::Vector3d::Zero(), target_.tree, turned_normals};
  EXPECT_LT(
      *MeasureStructureOverlap(turned, target_, Rigid3(), kMaxDistance, 1),
      0.1);
}

TEST_F(StructureOverlapTest, AnyAxisMayBeUp) {
  // The same scans in a frame with x up.
  const Rigid3 axes{
      RotationBetween(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX()),
      Eigen::Vector3d::Zero()};
  const KdTree source_tree(axes.Apply(source_.tree.points()));
  const KdTree target_tree(axes.Apply(target_.tree.points()));
  const Points source_normals = axes.Apply(source_.normals);
  const Points target_normals = axes.Apply(target_.normals);
  const auto overlap = [&](const Eigen::Vector3d& up) {
    return MeasureStructureOverlap(
        {Eigen::Vector3d::Zero(), source_tree, source_normals, true, up},
        {Eigen::Vector3d::Zero(), target_tree, target_normals, true, up},
        axes * target_from_source_ * Inverse(axes),
        kMaxDistance,
        1);
  };
  ASSERT_TRUE(overlap(Eigen::Vector3d::UnitX()).has_value());
  EXPECT_NEAR(
      *overlap(Eigen::Vector3d::UnitX()), Overlap(target_from_source_), 0.002);
  EXPECT_GT(std::abs(*overlap(Eigen::Vector3d::UnitZ()) -
                     Overlap(target_from_source_)),
            0.004);
}

}  // namespace
}  // namespace quatro
