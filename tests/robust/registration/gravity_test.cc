// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A vertical that nobody stated: the pose does not depend on the frame of the
// clouds or on their unit.

#include "robust/registration/gravity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "experiments/simulator/pair_sets.h"
#include "features/base/degree.h"
#include "robust/registration/presets.h"
#include "robust/registration/registration.h"
#include "tests/support/random_problems.h"

namespace quatro::gravity_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Normals within 5 deg of each direction, in these numbers.
DescribedCloud CloudWithNormals(const std::vector<Eigen::Vector3d>& directions,
                                const std::vector<int>& numbers) {
  Random random(3);
  std::vector<Eigen::Vector3d> normals;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    for (int i = 0; i < numbers[k]; ++i) {
      const Eigen::Vector3d noise(
          random.Normal(), random.Normal(), random.Normal());
      normals.push_back((directions[k] + 0.02 * noise).normalized());
    }
  }
  DescribedCloud cloud;
  cloud.normals.resize(3, static_cast<Eigen::Index>(normals.size()));
  for (std::size_t i = 0; i < normals.size(); ++i) {
    cloud.normals.col(static_cast<Eigen::Index>(i)) = normals[i];
  }
  cloud.tree = std::make_shared<const KdTree>(cloud.normals);
  return cloud;
}

TEST(FindCommonNormal, IsThatOfMostPoints) {
  const Eigen::Vector3d ground = Eigen::Vector3d(0.1, -0.2, 0.9).normalized();
  const DescribedCloud cloud = CloudWithNormals(
      {Eigen::Vector3d::UnitX(), ground, -ground}, {300, 500, 400});
  const auto normal = FindCommonNormal(cloud);
  ASSERT_TRUE(normal);
  EXPECT_NEAR(normal->norm(), 1.0, 1e-12);
  EXPECT_GT(normal->dot(ground), std::cos(0.5 * kDegree));
}

TEST(FindCommonNormal, NeedsNormals) {
  EXPECT_FALSE(FindCommonNormal(CloudWithNormals({{0, 0, 1}}, {49})));
  EXPECT_TRUE(FindCommonNormal(CloudWithNormals({{0, 0, 1}}, {50})));
  DescribedCloud unknown = CloudWithNormals({{0, 0, 1}}, {500});
  unknown.normals.setZero();
  EXPECT_FALSE(FindCommonNormal(unknown));
}

class GravityTest : public ::testing::Test {
 protected:
  static SetPair Simulate(int index) {
    PairSetOptions options;
    options.min_distance = 2.0;
    options.max_distance = 10.0;
    options.seed = 5;
    std::string error;
    auto pair = SimulateSetPair(options, index, &error);
    EXPECT_TRUE(pair) << error;
    return pair.value_or(SetPair());
  }

  // Both clouds in another frame and unit.
  static PointCloud Moved(const PointCloud& cloud,
                          const Rigid3& frame,
                          double unit) {
    PointCloud moved;
    moved.points = unit * frame.Apply(cloud.points);
    return moved;
  }

  // Whether `pose`, between clouds that were Moved(), is the true one.
  static bool IsTrue(const Rigid3& pose,
                     const Rigid3& frame,
                     double unit,
                     const SetPair& pair) {
    const Rigid3 in_meters{pose.rotation, pose.translation / unit};
    const Rigid3 back = Inverse(frame) * in_meters * frame;
    const Rigid3& truth = *pair.true_target_from_source;
    return (back.translation - truth.translation).norm() < 0.3 &&
           AngleBetween(back.rotation, truth.rotation) < 1.0 * kDegree;
  }
};

TEST_F(GravityTest, AutoFindsThePoseInAnyFrameAndUnit) {
  int num_true = 0;
  constexpr int kNumPairs = 4;
  Random random(7);
  for (int index = 0; index < kNumPairs; ++index) {
    const SetPair pair = Simulate(index);
    Eigen::Quaterniond q(
        random.Normal(), random.Normal(), random.Normal(), random.Normal());
    const Rigid3 frame{q.normalized().toRotationMatrix(),
                       Eigen::Vector3d(300.0, -200.0, 50.0)};
    const double unit = index % 2 == 0 ? 1000.0 : 0.001;
    const PointCloud source = Moved(pair.source, frame, unit);
    const PointCloud target = Moved(pair.target, frame, unit);
    const RegistrationSummary summary =
        Register(source, target, MakeAutoOptions(source, target));
    ASSERT_TRUE(summary.target_from_source()) << summary.error;
    const bool is_true =
        IsTrue(*summary.target_from_source(), frame, unit, pair);
    num_true += is_true;
    EXPECT_TRUE(is_true || !summary.verdict.IsRegistered());
  }
  EXPECT_GE(num_true, kNumPairs - 1);
}

TEST_F(GravityTest, NoneUsesNoStatedVertical) {
  const SetPair pair = Simulate(0);
  const Rigid3 on_its_side{
      Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitX())
          .toRotationMatrix(),
      Eigen::Vector3d::Zero()};
  const PointCloud source = Moved(pair.source, on_its_side, 1.0);
  const PointCloud target = Moved(pair.target, on_its_side, 1.0);
  RegistrationOptions options;
  options.ins.gravity = Gravity::kNone;
  const RegistrationSummary none = Register(source, target, options);
  ASSERT_TRUE(none.target_from_source()) << none.error;
  EXPECT_TRUE(none.verdict.IsRegistered()) << none.verdict.reason;
  EXPECT_NE(none.leveled_by, "given");
  EXPECT_TRUE(IsTrue(*none.target_from_source(), on_its_side, 1.0, pair));
  // As stated, z is not up.
  options.ins.gravity = Gravity::kGiven;
  const RegistrationSummary given = Register(source, target, options);
  EXPECT_EQ(given.leveled_by, "given");
  // Cliques in SO(3) may find the pose nevertheless.
  if (given.verdict.IsRegistered()) {
    EXPECT_TRUE(IsTrue(*given.target_from_source(), on_its_side, 1.0, pair));
  }
  // For an upright pair, the scans change nothing.
  options.ins.gravity = Gravity::kGiven;
  const RegistrationSummary upright =
      Register(pair.source, pair.target, options);
  options.ins.gravity = Gravity::kScans;
  const RegistrationSummary by_scans =
      Register(pair.source, pair.target, options);
  EXPECT_TRUE(upright.verdict.IsRegistered());
  EXPECT_EQ(by_scans.leveled_by, "given");
  EXPECT_EQ(by_scans.target_from_source()->ToMatrix(),
            upright.target_from_source()->ToMatrix());
}

TEST_F(GravityTest, NoneIsRefusedWhereItCannotBe) {
  const SetPair pair = Simulate(0);
  RegistrationOptions options;
  options.ins.gravity = Gravity::kNone;
  RegistrationOptions with_bounds = options;
  with_bounds.bounds.max_translation = 20.0;
  RegistrationOptions with_ins = options;
  with_ins.ins.mode = InsMode::kLeveled;
  RegistrationOptions single = options;
  single.method = "quatro_single";
  for (const RegistrationOptions& refused : {with_bounds, with_ins, single}) {
    EXPECT_THAT(Register(pair.source, pair.target, refused).error,
                HasSubstr("gravity is none, which method"));
  }
  const Points points = Points::Random(3, 10);
  EXPECT_THAT(RegisterMatches({points, points}, options).error,
              HasSubstr("needs clouds"));
  options.ins.gravity = Gravity::kScans;
  EXPECT_THAT(RegisterMatches({points, points}, options).error, IsEmpty());
}

}  // namespace
}  // namespace quatro::gravity_test
