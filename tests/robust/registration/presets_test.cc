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

double AutoVoxelSize(const Points& source, const Points& target) {
  return MakeAutoOptions(CloudOf(source), CloudOf(target)).front_end.voxel_size;
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
  const Points sparse_ = dense_.leftCols(1500);
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

TEST_F(AutoOptionsTest, ScaleWithTheCloud) {
  const double base = AutoVoxelSize(dense_, dense_);
  EXPECT_GT(base, 0.02);
  for (const double scale : {1e-3, 0.5, 3.0, 10.0, 1e3}) {
    const double scaled = AutoVoxelSize(scale * dense_, scale * dense_);
    // Found to 3 % and rounded to two digits, each of them, and enlarged in
    // steps of 15 % for the surfaces.
    EXPECT_NEAR(scaled / (scale * base), 1.0, 0.2)
        << "scale " << scale << ", voxels " << scaled << " m for " << base;
  }
}

// Of many points, every k-th is enough.
TEST_F(AutoOptionsTest, ManyPointsGiveTheSizeOfFewer) {
  const Points many = RandomStreet(900'000, 0.01, /*seed=*/2);
  const Points fewer = many(Eigen::all, Eigen::seq(0, Eigen::last, 3));
  EXPECT_NEAR(
      AutoVoxelSize(many, many) / AutoVoxelSize(fewer, fewer), 1.0, 0.07);
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

TEST_F(AutoOptionsTest, AreTheSameWithCloudsSwapped) {
  EXPECT_EQ(AutoVoxelSize(dense_, sparse_), AutoVoxelSize(sparse_, dense_));
}

TEST_F(AutoOptionsTest, VoxelsAreNoSmallerThanTheSpacingOfTheSparserCloud) {
  // 1500 points on some 500 m^2 are about 0.3 m apart.
  EXPECT_GT(AutoVoxelSize(sparse_, sparse_), 0.15);
  EXPECT_GT(AutoVoxelSize(dense_, sparse_), 0.15);
  EXPECT_LT(AutoVoxelSize(dense_, dense_), 0.25);
}

TEST_F(AutoOptionsTest, NormalsReachFromOneRingToTheNext) {
  // Two walls in rows of points 0.02 m apart.
  for (const double gap : {0.4, 0.8}) {
    Points rows(3, 20000);
    for (int i = 0; i < 20000; ++i) {
      const double along = 0.02 * (i % 500);
      const double up = gap * (i / 1000);
      if (i % 1000 < 500) {
        rows.col(i) << 10.0, along, up;
      } else {
        rows.col(i) << along, -5.0, up;
      }
    }
    const double normal_radius = 3.0 * AutoVoxelSize(rows, rows);
    EXPECT_GT(normal_radius, gap) << gap;
    EXPECT_LT(normal_radius, 2.0 * gap) << gap;
    EXPECT_EQ(AutoVoxelSize(dense_, rows), AutoVoxelSize(rows, dense_));
    EXPECT_GT(3.0 * AutoVoxelSize(dense_, rows), gap);
  }
}

TEST_F(AutoOptionsTest, ALineStaysAsItIs) {
  Points line = Points::Zero(3, 2000);
  line.row(0).setLinSpaced(0.0, 20.0);
  const double size = AutoVoxelSize(line, line);
  EXPECT_LT(size, 0.02);
}

TEST_F(AutoOptionsTest, HaveTwoDigits) {
  const double size = AutoVoxelSize(dense_, dense_);
  const double thousandths = 1000.0 * size;  // Sizes here are 0.10-0.99 m.
  ASSERT_GT(size, 0.1);
  EXPECT_NEAR(thousandths / 10.0, std::round(thousandths / 10.0), 1e-9);
}

TEST_F(AutoOptionsTest, WithoutPointsAreKitti) {
  const Points none(3, 0);
  const double kitti = MakePreset("kitti")->front_end.voxel_size;
  EXPECT_EQ(AutoVoxelSize(none, dense_), kitti);
  EXPECT_EQ(AutoVoxelSize(dense_, none), kitti);
}

// The squares of such distances are zero: every point would be a neighbor of
// every other, and the search would be quadratic.
TEST_F(AutoOptionsTest, DistancesThatCannotBeSquaredAreNotUsed) {
  const Points tiny = 1e-300 * dense_;
  EXPECT_EQ(AutoVoxelSize(tiny, dense_), AutoVoxelSize(Points(3, 0), dense_));
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
