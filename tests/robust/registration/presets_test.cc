// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "experiments/simulator/pair_sets.h"
#include "robust/registration/registration.h"
#include "tests/support/random_problems.h"

namespace quatro::presets_test {
namespace {

PointCloud CloudOf(const Points& points) {
  PointCloud cloud;
  cloud.points = points;
  return cloud;
}

TEST(MakePreset, EveryNameGivesValidOptions) {
  const std::vector<std::string> names = PresetNames();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(),
            names.size());
  for (const std::string& name : names) {
    const auto options = MakePreset(name);
    ASSERT_TRUE(options.has_value()) << name;
    std::string error;
    EXPECT_TRUE(options->IsValid(&error)) << name << ": " << error;
  }
}

TEST(MakePreset, NamesAreThoseTheHeaderLists) {
  EXPECT_THAT(PresetNames(),
              ::testing::IsSupersetOf(
                  {"kitti", "paper", "kitti_paper", "reference", "indoor"}));
}

TEST(MakePreset, UnknownNameGivesNone) {
  for (const char* name : {"", "Kitti", "kitti ", "nuscenes"}) {
    EXPECT_FALSE(MakePreset(name).has_value()) << "'" << name << "'";
  }
}

TEST(MakePreset, PaperHasThePapersNumbers) {
  const auto paper = MakePreset("paper");
  EXPECT_EQ(paper->front_end.voxel_size, 0.3);
  EXPECT_EQ(paper->front_end.normal_radius, 0.5);
  EXPECT_EQ(paper->front_end.fpfh_radius, 0.65);
  EXPECT_EQ(paper->noise_bound, 0.15);
  EXPECT_EQ(paper->quatro.tim_bound_factor, 1.0);
  EXPECT_EQ(paper->quatro.gnc.start, GncStart::kIdentity);
  EXPECT_EQ(paper->quatro.gnc.mu_step, 1.4);
  EXPECT_EQ(paper->quatro.pruning, Pruning::kCliqueHeuristic);
  EXPECT_EQ(paper->quatro.tim_layout, TimLayout::kRing);
  EXPECT_EQ(paper->quatro.consistency_test, ConsistencyTest::kLength);
  EXPECT_FALSE(paper->quatro.replace_missed_optimum);
  EXPECT_FALSE(paper->quatro.recover_translation);
  EXPECT_FALSE(paper->quatro.polish);
}

TEST(MakePreset, ReferenceHasTheNumbersOfTheAuthorsCode) {
  const auto reference = MakePreset("reference");
  EXPECT_EQ(reference->front_end.fpfh_radius, 0.75);
  EXPECT_EQ(reference->noise_bound, 0.3);
  EXPECT_EQ(reference->quatro.tim_bound_factor, 2.0);
  EXPECT_EQ(reference->quatro.gnc.start, GncStart::kPlainFit);
  EXPECT_FALSE(reference->quatro.polish);
}

TEST(MakePreset, IndoorIsKittiAtAThird) {
  const auto kitti = MakePreset("kitti");
  const auto indoor = MakePreset("indoor");
  EXPECT_EQ(kitti->front_end.voxel_size, 0.3);
  EXPECT_EQ(indoor->front_end.voxel_size, 0.1);
  EXPECT_NEAR(indoor->front_end.normal_radius,
              kitti->front_end.normal_radius / 3.0,
              1e-12);
  EXPECT_NEAR(
      indoor->front_end.fpfh_radius, kitti->front_end.fpfh_radius / 3.0, 1e-12);
  EXPECT_NEAR(indoor->noise_bound, kitti->noise_bound / 3.0, 1e-12);
}

// A street corner of 16 m.
class AutoOptionsTest : public ::testing::Test {
 protected:
  const Points dense_ = RandomStreet(60000, 0.01, /*seed=*/1);
};

TEST_F(AutoOptionsTest, AreValidAndInProportion) {
  const RegistrationOptions options =
      MakeAutoOptions(CloudOf(dense_), CloudOf(dense_));
  std::string error;
  EXPECT_TRUE(options.IsValid(&error)) << error;
  const double voxel_size = options.front_end.voxel_size;
  EXPECT_NEAR(options.front_end.normal_radius, 3.0 * voxel_size, 1e-12);
  EXPECT_NEAR(options.front_end.fpfh_radius, 5.0 * voxel_size, 1e-12);
  EXPECT_NEAR(options.noise_bound, voxel_size, 1e-12);
}

// The lengths of every part, so that nothing but the unit changes.
TEST_F(AutoOptionsTest, AllLengthsAreInProportion) {
  const RegistrationOptions one = MakeAutoOptions(0.3);
  const RegistrationOptions ten = MakeAutoOptions(3.0);
  const RegistrationOptions scaled = ScaledBy(10.0, one);
  const auto lengths = [](const RegistrationOptions& o) {
    return std::vector<double>{
        o.front_end.voxel_size,
        o.front_end.normal_radius,
        o.front_end.fpfh_radius,
        o.noise_bound,
        o.covariance.max_translation_std,
        o.refinement.voxel_size,
        o.refinement.max_translation,
        o.refinement.alignment.max_correspondence_distance,
        o.refinement.alignment.translation_tolerance};
  };
  for (std::size_t k = 0; k < lengths(one).size(); ++k) {
    EXPECT_NEAR(lengths(ten)[k], 10.0 * lengths(one)[k], 1e-12) << k;
    EXPECT_NEAR(lengths(scaled)[k], 10.0 * lengths(one)[k], 1e-12) << k;
  }
  EXPECT_EQ(one.refinement.method, RefinementMethod::kVgicp);
  EXPECT_EQ(one.search.scale_factors.size(), 3u);
}

// Scans in millimeters or kilometers give the pose in that unit.
TEST(AutoOptions, TheUnitOfTheCloudsDoesNotMatter) {
  PairSetOptions pairs;
  pairs.max_distance = 10.0;
  std::string error;
  int num_registered = 0;
  for (int index = 0; index < 2; ++index) {
    const auto pair = SimulateSetPair(pairs, index, &error);
    ASSERT_TRUE(pair) << error;
    const Rigid3& truth = *pair->true_target_from_source;
    for (const double unit : {1e-3, 1e3}) {
      PointCloud source, target;
      source.points = unit * pair->source.points;
      target.points = unit * pair->target.points;
      const RegistrationSummary summary =
          Register(source, target, MakeAutoOptions(source, target));
      ASSERT_TRUE(summary.target_from_source()) << summary.error;
      const Rigid3& pose = *summary.target_from_source();
      EXPECT_LT((pose.translation / unit - truth.translation).norm(), 0.3);
      EXPECT_LT(AngleBetween(pose.rotation, truth.rotation), 0.02);
      num_registered += summary.verdict.IsRegistered();
    }
  }
  EXPECT_EQ(num_registered, 4);
}

TEST_F(AutoOptionsTest, WithoutPointsAreKitti) {
  const PointCloud none = CloudOf(Points(3, 0));
  const PointCloud dense = CloudOf(dense_);
  const double kitti = MakePreset("kitti")->front_end.voxel_size;
  EXPECT_EQ(MakeAutoOptions(none, dense).front_end.voxel_size, kitti);
  EXPECT_EQ(MakeAutoOptions(dense, none).front_end.voxel_size, kitti);
}

TEST_F(AutoOptionsTest, OnePointOrCopiesOfItGiveValidOptions) {
  for (const Eigen::Index n : {1, 2, 100}) {
    const PointCloud cloud = CloudOf(Points::Ones(3, n));
    std::string error;
    EXPECT_TRUE(MakeAutoOptions(cloud, cloud).IsValid(&error))
        << n << " points: " << error;
  }
}

}  // namespace
}  // namespace quatro::presets_test
