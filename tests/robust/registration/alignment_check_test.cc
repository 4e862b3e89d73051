// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/alignment_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "features/base/random.h"

namespace quatro::alignment_check_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A hall of 30 x 20 x 6 m, open at both ends without `has_ends`.
PointCloud MakeHall(bool has_ends, std::uint64_t seed) {
  Random random(seed);
  constexpr Eigen::Index kNum = 40000;
  PointCloud cloud;
  cloud.points.resize(3, kNum);
  const Eigen::Array3d half_size(15.0, 10.0, 3.0);
  for (Eigen::Index i = 0; i < kNum; ++i) {
    const int axis = static_cast<int>(i % 3);
    const int wall = has_ends || axis > 0 ? axis : 1;
    Eigen::Array3d point;
    for (double& x : point) x = 2.0 * random.Uniform() - 1.0;
    point *= half_size;
    point[wall] =
        std::copysign(half_size[wall], point[wall]) + 0.02 * random.Normal();
    cloud.points.col(i) = point.matrix();
  }
  return cloud;
}

PointCloud Moved(const Rigid3& motion, const PointCloud& cloud) {
  PointCloud moved = cloud;
  moved.points = motion.Apply(cloud.points);
  return moved;
}

class AlignmentCheckTest : public ::testing::Test {
 protected:
  AlignmentCheck Check(const Rigid3& error) const {
    return CheckAlignment(source_, target_, error * motion_, options_);
  }

  const Rigid3 motion_{RotationZ(0.4), {3.0, -2.0, 0.5}};
  PointCloud source_ = MakeHall(true, 1);
  PointCloud target_ = Moved(motion_, MakeHall(true, 2));
  AlignmentCheckOptions options_;
};

TEST_F(AlignmentCheckTest, TellsTheTruePoseFromOnesThatAreOffByTheTolerance) {
  EXPECT_TRUE(Check(Rigid3()).is_aligned) << Check(Rigid3()).message;
  for (const double yaw : {-0.01, 0.01}) {
    const Rigid3 off{RotationZ(yaw), {0.06, 0.08, 0.0}};
    const AlignmentCheck check = Check(off);
    EXPECT_FALSE(check.is_aligned) << check.message;
    EXPECT_NEAR(check.moved_rotation, 0.01, 0.003);
    EXPECT_THAT(check.message, HasSubstr("not aligned"));
    // The nearest pose is the true one.
    EXPECT_LT((check.nearest.translation - motion_.translation).norm(), 0.03);
  }
}

TEST_F(AlignmentCheckTest, ToleranceDecides) {
  const Rigid3 off{RotationZ(0.01), {0.1, 0.0, 0.0}};
  options_.translation = 0.5;
  options_.rotation = 0.05;
  EXPECT_TRUE(Check(off).is_aligned);
}

TEST_F(AlignmentCheckTest, IsTheSameForTheSwappedPairAndScalesWithLengths) {
  const Rigid3 pose = Rigid3{RotationZ(0.004), {0.05, 0.0, 0.0}} * motion_;
  const AlignmentCheck check = CheckAlignment(source_, target_, pose, options_);
  const AlignmentCheck swapped =
      CheckAlignment(target_, source_, Inverse(pose), options_);
  EXPECT_EQ(check.is_aligned, swapped.is_aligned);
  EXPECT_NEAR(check.ratio, swapped.ratio, 0.1);

  source_.points *= 0.1;
  target_.points *= 0.1;
  options_.translation *= 0.1;
  options_.voxel_size *= 0.1;
  const AlignmentCheck small = CheckAlignment(
      source_, target_, {pose.rotation, 0.1 * pose.translation}, options_);
  EXPECT_NEAR(small.ratio, check.ratio, 0.1);
}

TEST_F(AlignmentCheckTest, MotionAlongTheSurfacesDoesNotCount) {
  source_ = MakeHall(false, 1);
  target_ = Moved(motion_, MakeHall(false, 2));
  const AlignmentCheck check = CheckAlignment(
      source_,
      target_,
      motion_ * Rigid3{Eigen::Matrix3d::Identity(), {0.3, 0.0, 0.0}},
      options_);
  EXPECT_TRUE(check.is_aligned) << check.message;
}

TEST_F(AlignmentCheckTest, CloudsThatDoNotTouchAreNotAligned) {
  const AlignmentCheck check =
      Check({Eigen::Matrix3d::Identity(), {200.0, 0.0, 0.0}});
  EXPECT_THAT(check.error, IsEmpty());
  EXPECT_FALSE(check.is_aligned);
  EXPECT_THAT(check.message, HasSubstr("do not overlap"));
}

TEST_F(AlignmentCheckTest, BadInputIsAnError) {
  Rigid3 pose = motion_;
  pose.translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(CheckAlignment(source_, target_, pose, options_).error,
              HasSubstr("not a finite"));
  EXPECT_THAT(CheckAlignment({}, target_, motion_, options_).error,
              HasSubstr("the source has no points"));
  options_.rotation = 0.0;
  EXPECT_THAT(CheckAlignment(source_, target_, motion_, options_).error,
              HasSubstr("rotation = 0, must be > 0"));
}

}  // namespace
}  // namespace quatro::alignment_check_test
