// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/pose_bounds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "features/base/degree.h"
#include "features/base/random.h"
#include "solvers/closed_form/gravity.h"
#include "tests/support/random_problems.h"

namespace quatro::pose_bounds_test {
namespace {

using ::testing::HasSubstr;

constexpr double kNoiseBound = 0.3;  // [m]

PoseBounds RandomBounds(std::uint64_t seed) {
  Random random(seed);
  PoseBounds bounds;
  bounds.guess = {RandomRotation(seed), RandomPoints(1, 20.0, seed + 1)};
  bounds.max_translation = 3.0 * random.Uniform();
  bounds.max_yaw = M_PI * random.Uniform();
  bounds.max_tilt = 0.3 * random.Uniform();
  bounds.up = RandomRotation(seed + 2).col(2);
  return bounds;
}

// About `up`, then about an axis across it.
Eigen::Matrix3d Turn(const Eigen::Vector3d& up,
                     double yaw,
                     double tilt,
                     double heading) {
  const Eigen::Vector3d any = up.unitOrthogonal();
  const Eigen::Vector3d axis = Eigen::AngleAxisd(heading, up) * any;
  return (Eigen::AngleAxisd(yaw, up) * Eigen::AngleAxisd(tilt, axis))
      .toRotationMatrix();
}

TEST(PoseBounds, TurnsAreDecomposed) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    const Eigen::Vector3d up = RandomRotation(seed).col(2);
    const double yaw = M_PI * (2.0 * random.Uniform() - 1.0);
    const double tilt = 3.0 * random.Uniform();
    const YawAndTilt found =
        Decompose(Turn(up, yaw, tilt, 6.0 * random.Uniform()), up);
    EXPECT_NEAR(found.yaw, yaw, 1e-9);
    EXPECT_NEAR(found.tilt, tilt, 1e-9);
  }
}

// The oracle: the arc, point by point.
TEST(PoseBounds, DistanceToTheArcIsThatToItsNearestPoint) {
  constexpr int kNumSteps = 4'000;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const PoseBounds bounds = RandomBounds(seed);
    const Eigen::Vector3d p = RandomPoints(1, 10.0, seed + 3);
    const Eigen::Vector3d q = RandomPoints(1, 10.0, seed + 4);
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kNumSteps; ++i) {
      const double angle = bounds.max_yaw * (2.0 * i / kNumSteps - 1.0);
      const Eigen::Vector3d on_arc =
          Eigen::AngleAxisd(angle, bounds.up) * (bounds.guess.rotation * p) +
          bounds.guess.translation;
      least = std::min(least, (on_arc - q).norm());
    }
    EXPECT_LE(bounds.DistanceToArc(p, q), least + 1e-9) << seed;
    // No point is farther than 45 m, so that half a step is less than 0.04 m.
    EXPECT_GE(bounds.DistanceToArc(p, q), least - 0.04) << seed;
  }
}

// (2) is necessary: an inlier of a pose within the bounds is never removed.
TEST(PoseBounds, InliersWithinTheBoundsPass) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const PoseBounds bounds = RandomBounds(seed);
    Random random(seed + 9);
    const Eigen::Vector3d p = RandomPoints(1, 50.0, seed + 3);
    const double yaw = bounds.max_yaw * (seed % 2 == 0 ? 1.0 : -1.0);
    const Rigid3 pose{
        Turn(bounds.up, yaw, bounds.max_tilt, 6.0 * random.Uniform()) *
            bounds.guess.rotation,
        bounds.guess.translation +
            bounds.max_translation * RandomRotation(seed).col(0)};
    ASSERT_TRUE(bounds.Contain(pose, 1e-9));
    const Eigen::Vector3d noise =
        kNoiseBound * RandomPoints(1, 1.0, seed + 5).cwiseSign();
    EXPECT_TRUE(bounds.CanBeInlier(p, pose * p + noise, kNoiseBound)) << seed;
  }
}

// And as narrow as stated: the farthest inlier passes, one slightly farther
// does not.
TEST(PoseBounds, WhatIsBeyondTheBoundsDoesNotPass) {
  PoseBounds bounds;
  bounds.max_translation = 2.0;
  bounds.max_yaw = 30.0 * kDegree;
  bounds.max_tilt = 0.0;
  const double reach = 2.0 + std::sqrt(3.0) * kNoiseBound;
  const Eigen::Vector3d p(10.0, 0.0, 1.0);
  const Eigen::Vector3d end = RotationZ(30.0 * kDegree) * p;
  const Eigen::Vector3d along = RotationZ(120.0 * kDegree).col(0);
  EXPECT_TRUE(bounds.CanBeInlier(p, end + 0.99 * reach * along, kNoiseBound));
  EXPECT_FALSE(bounds.CanBeInlier(p, end + 1.01 * reach * along, kNoiseBound));
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(bounds.CanBeInlier(p, p + 0.99 * reach * up, kNoiseBound));
  EXPECT_FALSE(bounds.CanBeInlier(p, p + 1.01 * reach * up, kNoiseBound));
}

TEST(PoseBounds, PosesBeyondAreNotContained) {
  PoseBounds bounds;
  bounds.guess = {RotationZ(1.0), {5.0, 0.0, 0.0}};
  bounds.max_translation = 2.0;
  bounds.max_yaw = 0.2;
  bounds.max_tilt = 0.1;
  const auto contains = [&](double yaw, double tilt, double x) {
    return bounds.Contain(
        {Turn(bounds.up, yaw, tilt, 0.3) * RotationZ(1.0), {5.0 + x, 0.0, 0.0}},
        0.1);
  };
  EXPECT_TRUE(contains(0.2, 0.1, 2.05));
  EXPECT_FALSE(contains(0.2, 0.1, 2.15));
  EXPECT_FALSE(contains(0.22, 0.0, 0.0));
  EXPECT_FALSE(contains(-0.22, 0.0, 0.0));
  EXPECT_FALSE(contains(0.0, 0.12, 0.0));
}

TEST(PoseBounds, WithoutBoundsAllIsContained) {
  PoseBounds bounds;
  bounds.guess.translation.x() = 7.0;
  EXPECT_FALSE(bounds.IsActive());
  EXPECT_TRUE(bounds.Contain({RandomRotation(1), {1e6, 0.0, 0.0}}, 0.0));
  EXPECT_TRUE(bounds.CanBeInlier({1e6, 0.0, 0.0}, {0.0, 0.0, 1.0}, 0.0));
}

TEST(PoseBounds, WhatIsOutOfRangeIsToldByName) {
  const auto problem = [](auto set) {
    PoseBounds bounds;
    set(&bounds);
    std::string error;
    EXPECT_FALSE(bounds.IsValid(&error));
    return error;
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(problem([](PoseBounds* b) { b->max_translation = -1.0; }),
              HasSubstr("bounds.max_translation = -1, must be >= 0"));
  EXPECT_THAT(problem([](PoseBounds* b) { b->max_translation = kNan; }),
              HasSubstr("bounds.max_translation"));
  EXPECT_THAT(problem([](PoseBounds* b) { b->max_yaw = 4.0; }),
              HasSubstr("bounds.max_yaw = 4, must be in [0, pi]"));
  EXPECT_THAT(problem([](PoseBounds* b) { b->max_tilt = -0.1; }),
              HasSubstr("bounds.max_tilt"));
  EXPECT_THAT(problem([](PoseBounds* b) { b->up.z() = 2.0; }),
              HasSubstr("bounds.up"));
  EXPECT_THAT(problem([](PoseBounds* b) { b->guess.rotation *= 2.0; }),
              HasSubstr("bounds.guess has no rotation in its first three"));
  EXPECT_THAT(problem([](PoseBounds* b) { b->guess.translation.x() = kNan; }),
              HasSubstr("bounds.guess has a number that is not finite"));
  std::string error;
  EXPECT_TRUE(PoseBounds().IsValid(&error)) << error;
}

}  // namespace
}  // namespace quatro::pose_bounds_test
