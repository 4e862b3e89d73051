// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/surface_observability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <utility>

#include "features/normals.h"
#include "robust/registration/registration.h"
#include "tests/support/described_clouds.h"
#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::surface_observability_test {
namespace {

using ::testing::HasSubstr;

// A corridor: a floor and two walls, 40 m long along x, 4 m wide and 3 m high,
// with a wall across its end if it `has_end`.
Surface Corridor(bool has_end, std::uint64_t seed) {
  Random random(seed);
  constexpr Eigen::Index kNum = 9000;
  Surface corridor{Points(3, kNum), Points(3, kNum)};
  for (Eigen::Index i = 0; i < kNum; ++i) {
    const double part = random.Uniform();
    const double along = 40.0 * random.Uniform() - 20.0;
    const double across = 4.0 * random.Uniform() - 2.0;
    const double up = 3.0 * random.Uniform() - 1.5;
    auto point = corridor.points.col(i);
    auto normal = corridor.normals.col(i);
    if (has_end && part < 0.1) {
      point << 20.0, across, up;
      normal << -1.0, 0.0, 0.0;
    } else if (part < 0.4) {
      point << along, across, -1.5;
      normal << 0.0, 0.0, 1.0;
    } else {
      const double side = part < 0.7 ? 1.0 : -1.0;
      point << along, 2.0 * side, up;
      normal << 0.0, -side, 0.0;
    }
  }
  return corridor;
}

Surface Moved(const Rigid3& motion, const Surface& surface) {
  return {motion.Apply(surface.points), motion.rotation * surface.normals};
}

class SurfaceObservabilityTest : public ::testing::Test {
 protected:
  std::optional<SurfaceObservability> Measure(const Surface& source,
                                              const Surface& target,
                                              const Rigid3& pose,
                                              int num_threads = 1) const {
    const DescribedCloud a = MakeDescribedCloud(source.points, source.normals);
    const DescribedCloud b = MakeDescribedCloud(target.points, target.normals);
    return MeasureSurfaceObservability(
        a,
        b,
        pose,
        FindMutualContacts(a, b, pose, max_distance_, num_threads),
        options_,
        num_threads);
  }

  const Rigid3 pose_{RotationZ(0.35), {3.0, 4.0, 0.5}};
  double max_distance_ = 0.5;  // [m]
  SurfaceObservabilityOptions options_;
};

TEST_F(SurfaceObservabilityTest, PositionAlongACorridorIsNamed) {
  const Surface source = Corridor(false, 1);
  const auto hold = Measure(source, Moved(pose_, Corridor(false, 2)), pose_);
  ASSERT_TRUE(hold.has_value());
  const Eigen::Vector3d along = pose_.rotation.col(0);
  ASSERT_EQ(hold->unobservable.size(), 1u);
  EXPECT_EQ(hold->unobservable[0].freedom, Freedom::kTranslation);
  EXPECT_NEAR(std::abs(hold->unobservable[0].axis.dot(along)), 1.0, 1e-9);
  EXPECT_EQ(hold->unobservable[0].Describe(),
            "position along the axis (0.94, 0.34, 0.00): no surface "
            "constrains it");
  EXPECT_NEAR(std::abs(hold->weakest_level_axis.dot(along)), 1.0, 1e-9);
  EXPECT_NEAR(hold->weakest_level_share, 0.0, 1e-9);
  EXPECT_GT(hold->num_structure, 5000);
  EXPECT_LT(hold->num_structure, hold->num_overlapping);
}

TEST_F(SurfaceObservabilityTest, AWallAtTheEndHoldsIt) {
  const auto hold =
      Measure(Corridor(true, 1), Moved(pose_, Corridor(true, 2)), pose_);
  ASSERT_TRUE(hold.has_value());
  EXPECT_TRUE(hold->unobservable.empty()) << hold->unobservable[0].Describe();
  // A tenth of all points; seven tenths are structure.
  EXPECT_NEAR(hold->weakest_level_share, 1.0 / 7.0, 0.02);
}

TEST_F(SurfaceObservabilityTest, BareGroundHoldsNoHeading) {
  const auto hold = Measure(RandomPlane(4000, 20.0, 1),
                            Moved(pose_, RandomPlane(4000, 20.0, 2)),
                            pose_);
  ASSERT_TRUE(hold.has_value());
  ASSERT_EQ(hold->unobservable.size(), 3u);
  EXPECT_EQ(hold->unobservable[2].freedom, Freedom::kRotation);
  EXPECT_NEAR(hold->unobservable[2].axis.z(), 1.0, 1e-9);
  EXPECT_EQ(hold->num_structure, 0);
  EXPECT_EQ(hold->weakest_level_share, 0.0);
}

TEST_F(SurfaceObservabilityTest, InformationIsOfThePointsThatAreMet) {
  const Surface target = Corridor(true, 3);
  const auto hold = Measure(target, target, Rigid3());
  ASSERT_TRUE(hold.has_value());
  EXPECT_EQ(hold->num_overlapping, 2 * target.points.cols());
  EXPECT_LT((hold->center - target.points.rowwise().mean()).norm(), 1e-9);
  Matrix6 expected = Matrix6::Zero();
  for (Eigen::Index i = 0; i < target.points.cols(); ++i) {
    const Eigen::Vector3d n = target.normals.col(i);
    Vector6 a;
    a << (Eigen::Vector3d(target.points.col(i)) - hold->center).cross(n), n;
    expected += a * a.transpose();
  }
  expected /= static_cast<double>(target.points.cols());
  EXPECT_LT((hold->information - expected).norm(), 1e-9 * expected.norm());
}

// Half of the source has no counterpart in the target, or its normals are not
// aligned.
TEST_F(SurfaceObservabilityTest, WhatIsNotMetDoesNotCount) {
  const Surface target = Corridor(true, 3);
  Surface source = target;
  source.points.leftCols(1000).colwise() += Eigen::Vector3d(0.0, 0.0, 50.0);
  source.normals.middleCols(1000, 1000).setConstant(1.0 / std::sqrt(3.0));
  source.normals.middleCols(2000, 1000).setZero();
  max_distance_ = 1e-6;
  const auto hold = Measure(source, target, Rigid3());
  ASSERT_TRUE(hold.has_value());
  EXPECT_EQ(hold->num_overlapping, 2 * (target.points.cols() - 3000));
}

TEST_F(SurfaceObservabilityTest, SwappingSourceAndTargetMovesIt) {
  const Surface source = Corridor(true, 1);
  const Surface target = Moved(pose_, Corridor(true, 2));
  const auto forward = Measure(source, target, pose_);
  const auto backward = Measure(target, source, Inverse(pose_));
  ASSERT_TRUE(forward.has_value());
  ASSERT_TRUE(backward.has_value());
  EXPECT_EQ(forward->num_overlapping, backward->num_overlapping);
  EXPECT_NEAR(
      forward->weakest_level_share, backward->weakest_level_share, 1e-9);
  EXPECT_LT((forward->center - pose_ * backward->center).norm(), 1e-9);
  Matrix6 turn = Matrix6::Zero();
  turn.topLeftCorner<3, 3>() = pose_.rotation;
  turn.bottomRightCorner<3, 3>() = pose_.rotation;
  EXPECT_LT(
      (forward->information - turn * backward->information * turn.transpose())
          .norm(),
      1e-9 * forward->information.norm());
}

TEST_F(SurfaceObservabilityTest, NumberOfThreadsDoesNotMatterBitForBit) {
  const Surface source = Corridor(true, 1);
  const Surface target = Moved(pose_, Corridor(true, 2));
  const auto one = Measure(source, target, pose_, 1);
  const auto three = Measure(source, target, pose_, 3);
  EXPECT_EQ(one->information, three->information);
  EXPECT_EQ(one->center, three->center);
  EXPECT_EQ(one->weakest_level_share, three->weakest_level_share);
}

TEST_F(SurfaceObservabilityTest, FewPointsThatAreMetHaveNone) {
  const Surface target = Corridor(true, 1);
  Rigid3 far = pose_;
  far.translation.z() = 100.0;
  EXPECT_FALSE(Measure(target, target, far).has_value());
  const Surface none{Points(3, 0), Points(3, 0)};
  EXPECT_FALSE(Measure(none, target, Rigid3()).has_value());
  EXPECT_FALSE(Measure(target, none, Rigid3()).has_value());
}

TEST_F(SurfaceObservabilityTest, FarFromTheOriginItIsTheSame) {
  const Surface source = Corridor(true, 1);
  const Surface target = Corridor(true, 2);
  const Rigid3 away{Eigen::Matrix3d::Identity(), {1e7, -1e7, 1e6}};
  const auto near = Measure(source, target, Rigid3());
  const auto far = Measure(source, Moved(away, target), away);
  ASSERT_TRUE(far.has_value());
  EXPECT_LT((far->information - near->information).norm(),
            1e-6 * near->information.norm());
}

TEST(SurfaceObservabilityOptions, ErrorNamesTheField) {
  std::string error;
  SurfaceObservabilityOptions options;
  EXPECT_TRUE(options.IsValid(&error)) << error;
  options.min_part = 1.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("min_part = 1"));
}

// Through Register(): two scans of a corridor with estimated normals and
// matches, and the true pose in place of a solver.
TEST(RegisterInACorridor, NamesThePositionAlongIt) {
  const Rigid3 truth{RotationZ(0.35), {1.0, 0.5, 0.0}};
  const auto scan = [&](bool has_end, std::uint64_t seed) {
    PointCloud cloud;
    cloud.points = Corridor(has_end, seed).points;
    cloud.points += RandomPoints(cloud.points.cols(), 0.01, seed + 10);
    return cloud;
  };
  RegistrationOptions options;
  options.solver = [&](const PointsRef& source, const PointsRef&) {
    PoseSummary summary;
    summary.termination = PoseTermination::kSolved;
    summary.target_from_source = truth;
    for (Eigen::Index i = 0; i < source.cols(); ++i) {
      summary.translation_inliers.push_back(i);
    }
    return summary;
  };
  for (const bool has_end : {false, true}) {
    PointCloud target = scan(has_end, 2);
    target.points = truth.Apply(target.points);
    const auto summary = Register(scan(has_end, 1), target, options);
    ASSERT_TRUE(summary.solution.covariance.has_value()) << summary.error;
    ASSERT_TRUE(summary.surface_observability.has_value());
    bool is_named = false;
    for (const auto& direction : summary.solution.covariance->unobservable) {
      is_named |= direction.reason == UnobservableReason::kNoSurface &&
                  direction.freedom == Freedom::kTranslation &&
                  std::abs(direction.axis.dot(truth.rotation.col(0))) > 0.999;
    }
    EXPECT_EQ(is_named, !has_end)
        << summary.surface_observability->weakest_level_share;
  }
}

}  // namespace
}  // namespace quatro::surface_observability_test
