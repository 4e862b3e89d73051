// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/registration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "features/fpfh.h"
#include "features/kd_tree.h"
#include "solvers/closed_form/gravity.h"
#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::registration_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

PointCloud CloudOf(const Points& points) {
  PointCloud cloud;
  cloud.points = points;
  return cloud;
}

RegistrationOptions StreetOptions() {
  RegistrationOptions options;
  options.front_end.voxel_size = 0.3;
  options.front_end.normal_radius = 0.9;
  options.front_end.fpfh_radius = 1.5;
  return options;
}

// Two scans of one street corner, sampled anew and from different places.
class RegistrationTest : public ::testing::Test {
 protected:
  const Rigid3 true_target_from_source_{RotationZ(0.7), {1.0, -0.8, 0.1}};
  const PointCloud source_ =
      CloudOf(Inverse(true_target_from_source_)
                  .Apply(RandomStreet(12000, 0.01, /*seed=*/1)));
  const PointCloud target_ = CloudOf(RandomStreet(12000, 0.01, /*seed=*/2));
  RegistrationOptions options_ = StreetOptions();
};

void ExpectSameBits(const RegistrationSummary& a,
                    const RegistrationSummary& b) {
  ASSERT_TRUE(a.target_from_source().has_value());
  ASSERT_TRUE(b.target_from_source().has_value());
  EXPECT_EQ(a.target_from_source()->ToMatrix(),
            b.target_from_source()->ToMatrix());
  EXPECT_EQ(a.matched_source, b.matched_source);
  EXPECT_EQ(a.matched_target, b.matched_target);
  EXPECT_EQ(a.verdict.reason, b.verdict.reason);
  EXPECT_EQ(a.verdict.probability, b.verdict.probability);
  ASSERT_EQ(a.verdict.features.size(), b.verdict.features.size());
  for (std::size_t j = 0; j < a.verdict.features.size(); ++j) {
    EXPECT_EQ(a.verdict.features[j].value, b.verdict.features[j].value)
        << a.verdict.features[j].name;
  }
}

TEST_F(RegistrationTest, FindsTheMotionBetweenTwoScans) {
  const RegistrationSummary summary = Register(source_, target_, options_);
  ASSERT_THAT(summary.error, IsEmpty());
  ASSERT_TRUE(summary.target_from_source().has_value())
      << summary.solution.message;
  EXPECT_TRUE(summary.verdict.IsRegistered()) << summary.verdict.reason;
  EXPECT_LE(LargestDisplacement(*summary.target_from_source(),
                                true_target_from_source_,
                                source_.points),
            0.3)
      << summary.verdict.reason;
  ASSERT_TRUE(summary.verdict.geometry.has_value());
  // Both are scans from their origins.
  ASSERT_TRUE(
      summary.verdict.geometry->free_space.ContradictedShare().has_value());
  EXPECT_LE(*summary.verdict.geometry->free_space.ContradictedShare(), 0.05);
  EXPECT_GT(summary.num_source_voxels, 1000);
  EXPECT_GT(summary.num_target_voxels, 1000);
  EXPECT_EQ(summary.matched_source.cols(), summary.matched_target.cols());
  EXPECT_GE(summary.num_mutual_matches, summary.matched_source.cols());
}

TEST_F(RegistrationTest, FreeSpaceOfAMapIsNotKnown) {
  const Eigen::Vector3d origin(500.0, -800.0, 30.0);
  const PointCloud source = CloudOf(source_.points.colwise() + origin);
  const PointCloud target = CloudOf(target_.points.colwise() + origin);
  const RegistrationSummary summary = Register(source, target, options_);
  ASSERT_TRUE(summary.verdict.geometry.has_value()) << summary.verdict.reason;
  EXPECT_FALSE(
      summary.verdict.geometry->free_space.ContradictedShare().has_value());
}

TEST_F(RegistrationTest, NumberOfThreadsDoesNotMatterBitForBit) {
  const RegistrationSummary one = Register(source_, target_, options_);
  options_.num_threads = 2;
  ExpectSameBits(Register(source_, target_, options_), one);
}

TEST_F(RegistrationTest, OrderOfPointsDoesNotMatterBitForBit) {
  const RegistrationSummary expected = Register(source_, target_, options_);
  const Eigen::Index n = source_.points.cols();
  const PointCloud source =
      CloudOf(Reordered(source_.points, RandomPermutation(n, 1)));
  const PointCloud target =
      CloudOf(Reordered(target_.points, RandomPermutation(n, 2)));
  ExpectSameBits(Register(source, target, options_), expected);
}

TEST_F(RegistrationTest, SwappingSourceAndTargetInvertsThePose) {
  const RegistrationSummary forward = Register(source_, target_, options_);
  const RegistrationSummary backward = Register(target_, source_, options_);
  ASSERT_TRUE(forward.target_from_source().has_value());
  ASSERT_TRUE(backward.target_from_source().has_value());
  EXPECT_LE(LargestDisplacement(Inverse(*backward.target_from_source()),
                                *forward.target_from_source(),
                                source_.points),
            options_.noise_bound);
}

TEST_F(RegistrationTest, StagesAreReportedAsTheyEnd) {
  std::vector<std::string> stages;
  options_.progress = [&](const StageTime& time) {
    EXPECT_GE(time.seconds, 0.0) << time.stage;
    stages.emplace_back(time.stage);
  };
  const RegistrationSummary summary = Register(source_, target_, options_);
  ASSERT_EQ(stages.size(), summary.stage_times.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    EXPECT_EQ(stages[i], summary.stage_times[i].stage);
    sum += summary.stage_times[i].seconds;
  }
  stages.resize(3);
  EXPECT_THAT(stages, ElementsAre("voxels", "features", "matching"));
  EXPECT_LE(sum, summary.total_seconds + 1e-3);
}

TEST_F(RegistrationTest, TupleTestCanBeLeftOut) {
  options_.front_end.tuple_test = false;
  const RegistrationSummary all = Register(source_, target_, options_);
  EXPECT_EQ(all.matched_source.cols(), all.num_mutual_matches);
  options_.front_end.tuple_test = true;
  const RegistrationSummary tested = Register(source_, target_, options_);
  EXPECT_EQ(tested.num_mutual_matches, all.num_mutual_matches);
  EXPECT_LT(tested.matched_source.cols(), all.matched_source.cols());
}

TEST_F(RegistrationTest, AnotherSolverTakesThePlaceOfQuatro) {
  options_.solver = [](const PointsRef& source, const PointsRef&) {
    PoseSummary summary;
    summary.termination = PoseTermination::kInsufficient;
    summary.message = "not today";
    summary.num_matches = source.cols();
    return summary;
  };
  const RegistrationSummary summary = Register(source_, target_, options_);
  EXPECT_FALSE(summary.target_from_source().has_value());
  EXPECT_EQ(summary.verdict.status, Status::kInsufficient);
  EXPECT_EQ(summary.verdict.reason, "not today");
  EXPECT_EQ(summary.verdict.num_matches, summary.matched_source.cols());
}

TEST_F(RegistrationTest, AnotherDescriptorTakesThePlaceOfFpfh) {
  const RegistrationSummary expected = Register(source_, target_, options_);
  int num_calls = 0;
  options_.front_end.describe = [&](const Points& points,
                                    const Points& normals,
                                    double radius) {
    ++num_calls;
    EXPECT_EQ(radius, options_.front_end.fpfh_radius);
    const KdTree tree(points);
    return ComputeFpfh(points, normals, FindNeighborhoods(tree, radius, 1), 1);
  };
  ExpectSameBits(Register(source_, target_, options_), expected);
  EXPECT_EQ(num_calls, 2);

  options_.front_end.describe =
      [](const Points& points, const Points&, double) -> Fpfh {
    return Fpfh::Zero(kFpfhSize, points.cols());
  };
  const RegistrationSummary none = Register(source_, target_, options_);
  EXPECT_EQ(none.num_mutual_matches, 0);
  EXPECT_EQ(none.verdict.status, Status::kInsufficient);
}

// The source is rolled by 12 deg and pitched by -5 deg, the target by -3 deg.
class TiltedRegistrationTest : public RegistrationTest {
 protected:
  TiltedRegistrationTest() {
    options_.quatro.polish = false;
    options_.ins.source_attitude = {0.21, -0.09, 0.0};
    options_.ins.target_attitude = {-0.05, 0.0, -0.7};
  }

  RegistrationSummary RegisterTilted(InsMode mode) {
    options_.ins.mode = mode;
    return Register(tilted_source_, tilted_target_, options_);
  }

  const Rigid3 level_from_source_{LevelFromBody(0.21, -0.09),
                                  Eigen::Vector3d::Zero()};
  const Rigid3 level_from_target_{LevelFromBody(-0.05, 0.0),
                                  Eigen::Vector3d::Zero()};
  const Rigid3 true_tilted_ = Inverse(level_from_target_) *
                              true_target_from_source_ * level_from_source_;
  const PointCloud tilted_source_ =
      CloudOf(Inverse(level_from_source_).Apply(source_.points));
  const PointCloud tilted_target_ =
      CloudOf(Inverse(level_from_target_).Apply(target_.points));
};

TEST_F(TiltedRegistrationTest, RollAndPitchOfAnInsAreTaken) {
  for (const InsMode mode :
       {InsMode::kRelative, InsMode::kLeveled, InsMode::kFused}) {
    const RegistrationSummary summary = RegisterTilted(mode);
    ASSERT_THAT(summary.error, IsEmpty());
    ASSERT_TRUE(summary.target_from_source().has_value());
    EXPECT_TRUE(summary.verdict.IsRegistered()) << summary.verdict.reason;
    EXPECT_LE(
        LargestDisplacement(
            *summary.target_from_source(), true_tilted_, tilted_source_.points),
        0.3)
        << static_cast<int>(mode);
  }
}

// The INS comes after the matches, which several estimators may share.
TEST_F(TiltedRegistrationTest, ScansMatchedWithoutTheInsGiveTheSame) {
  const RegistrationOptions without = options_;
  const MatchedClouds matched =
      MatchClouds(tilted_source_, tilted_target_, without);
  for (const InsMode mode : {InsMode::kLeveled, InsMode::kFused}) {
    const RegistrationSummary expected = RegisterTilted(mode);
    ExpectSameBits(RegisterMatched(matched, options_), expected);
  }
}

TEST_F(TiltedRegistrationTest, WithoutAnInsAYawAloneIsOff) {
  options_.method = "quatro_single";
  const RegistrationSummary summary = RegisterTilted(InsMode::kNone);
  ASSERT_TRUE(summary.target_from_source());
  EXPECT_GT(AngleBetween(summary.target_from_source()->rotation,
                         true_tilted_.rotation),
            0.2);
}

TEST_F(TiltedRegistrationTest, WithoutAnInsTheSearchFindsTheTilt) {
  const RegistrationSummary summary = RegisterTilted(InsMode::kNone);
  EXPECT_TRUE(summary.verdict.IsRegistered()) << summary.verdict.reason;
  EXPECT_GE(summary.rung, 1);
  EXPECT_LT(AngleBetween(summary.target_from_source()->rotation,
                         true_tilted_.rotation),
            0.02);
}

TEST_F(TiltedRegistrationTest, AnotherSolverIsGivenTheLevelMatches) {
  const RegistrationSummary expected = RegisterTilted(InsMode::kLeveled);
  options_.solver = [&](const PointsRef& source, const PointsRef& target) {
    EXPECT_LE((source - level_from_source_.Apply(expected.matched_source))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-9);
    EXPECT_LE((target - level_from_target_.Apply(expected.matched_target))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-9);
    return SolveQuatro(source, target, options_.quatro);
  };
  ExpectSameBits(RegisterTilted(InsMode::kLeveled), expected);
}

void ExpectWithin(double share, double value, double expected) {
  EXPECT_NEAR(value, expected, share * std::abs(expected));
}

// The numbers of a summary of clouds in other axes, x_in_axes = R x.
void ExpectSameNumbers(const RegistrationSummary& in_axes,
                       const RegistrationSummary& expected,
                       const Eigen::Matrix3d& axes) {
  const auto expect_axis = [&](const Eigen::Vector3d& direction,
                               const Eigen::Vector3d& expected_direction) {
    EXPECT_GT(std::abs(direction.dot(axes * expected_direction)), 0.99);
  };
  const auto count = [](Eigen::Index n) { return static_cast<double>(n); };
  ASSERT_TRUE(in_axes.surface_observability && expected.surface_observability);
  const SurfaceObservability& a = *in_axes.surface_observability;
  const SurfaceObservability& b = *expected.surface_observability;
  ExpectWithin(0.02, count(a.num_overlapping), count(b.num_overlapping));
  ExpectWithin(0.02, count(a.num_structure), count(b.num_structure));
  EXPECT_NEAR(a.weakest_level_share, b.weakest_level_share, 0.01);
  expect_axis(a.weakest_level_axis, b.weakest_level_axis);
  ASSERT_TRUE(in_axes.verdict.geometry && expected.verdict.geometry);
  const GeometricEvidence& g = *in_axes.verdict.geometry;
  const GeometricEvidence& h = *expected.verdict.geometry;
  EXPECT_NEAR(g.structure_overlap, h.structure_overlap, 0.01);
  EXPECT_NEAR(g.median_residual, h.median_residual, 0.02);
  EXPECT_NEAR(g.weakest_share, h.weakest_share, 0.01);
  expect_axis(g.weakest_direction, h.weakest_direction);
  EXPECT_NEAR(g.free_space.ContradictedShare().value_or(0.0),
              h.free_space.ContradictedShare().value_or(0.0),
              0.01);
  EXPECT_NEAR(g.rival.overlap, h.rival.overlap, 0.05);
  EXPECT_NEAR(g.rival.rival_overlap, h.rival.rival_overlap, 0.1);
  ASSERT_TRUE(in_axes.solution.covariance && expected.solution.covariance);
  const auto& c = in_axes.solution.covariance->covariance_at_center;
  const auto& d = expected.solution.covariance->covariance_at_center;
  ASSERT_TRUE(c && d);
  Matrix6 turn = Matrix6::Zero();
  turn.topLeftCorner<3, 3>() = axes;
  turn.bottomRightCorner<3, 3>() = axes;
  // Voxels depend on the axes, and with them the residuals of the surfaces.
  EXPECT_LT((turn.transpose() * *c * turn - *d).norm(), 0.5 * d->norm());
  EXPECT_NEAR(in_axes.verdict.probability, expected.verdict.probability, 0.05);
}

TEST_F(RegistrationTest, AnyAxisMayBeUp) {
  options_.quatro.polish = false;
  options_.search.max_rung = 0;  // VG-ICP's voxels depend on the axes.
  const Rigid3 axes{
      RotationBetween(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX()),
      Eigen::Vector3d::Zero()};
  // In the coordinates of a map, too, where the sensor must be guessed. A
  // multiple of the voxels, which are then the same in all axes.
  for (const double offset : {0.0, 99.0}) {
    const auto register_in = [&](const Rigid3& axes_from_cloud,
                                 const Eigen::Vector3d& up) {
      options_.ins.up = up;
      return Register(CloudOf(axes_from_cloud.Apply(source_.points)),
                      CloudOf(axes_from_cloud.Apply(target_.points)),
                      options_);
    };
    const Eigen::Vector3d shift = Eigen::Vector3d::Constant(offset);
    const Rigid3 turned{axes.rotation, shift};
    const RegistrationSummary expected = register_in(
        {Eigen::Matrix3d::Identity(), shift}, Eigen::Vector3d::UnitZ());
    const RegistrationSummary summary =
        register_in(turned, Eigen::Vector3d::UnitX());
    ASSERT_TRUE(summary.target_from_source().has_value());
    EXPECT_TRUE(summary.verdict.IsRegistered()) << summary.verdict.reason;
    EXPECT_LE(LargestDisplacement(
                  Inverse(turned) * *summary.target_from_source() * turned,
                  true_target_from_source_,
                  source_.points),
              0.3);
    EXPECT_NEAR(static_cast<double>(summary.num_mutual_matches),
                static_cast<double>(expected.num_mutual_matches),
                0.02 * static_cast<double>(expected.num_mutual_matches));
    ExpectSameNumbers(summary, expected, axes.rotation);
  }
}

// The true pose is within the error radius, which is centimeters here.
TEST_F(RegistrationTest, ErrorRadiusContainsTheTruePose) {
  const RegistrationSummary summary = Register(source_, target_, options_);
  ASSERT_TRUE(summary.error_radius);
  const ErrorRadius& radius = *summary.error_radius;
  const Rigid3& pose = *summary.target_from_source();
  EXPECT_LT((pose.translation - true_target_from_source_.translation).norm(),
            radius.translation);
  EXPECT_LT(AngleBetween(pose.rotation, true_target_from_source_.rotation),
            radius.rotation);
  EXPECT_LT(radius.translation, 0.3);
  EXPECT_LT(radius.rotation, 0.05);
}

// One way from matches to a verdict: without clouds it is the same but for the
// geometry, and the covariance is that of the inliers.
TEST_F(RegistrationTest, MatchesAloneGiveTheSamePose) {
  const RegistrationSummary clouds = Register(source_, target_, options_);
  const RegistrationSummary matches =
      RegisterMatches({clouds.matched_source, clouds.matched_target}, options_);
  ASSERT_THAT(matches.error, IsEmpty());
  ASSERT_TRUE(matches.target_from_source().has_value());
  EXPECT_EQ(matches.target_from_source()->ToMatrix(),
            clouds.target_from_source()->ToMatrix());
  ASSERT_TRUE(matches.solution.covariance->covariance);
  EXPECT_NE(matches.solution.covariance->center,
            clouds.solution.covariance->center);
  EXPECT_FALSE(matches.error_radius);
  EXPECT_EQ(matches.verdict.num_inliers, clouds.verdict.num_inliers);
  EXPECT_FALSE(matches.verdict.geometry.has_value());
}

TEST(RegisterMatches, DegenerateMatchesAreCalledSo) {
  // On one pole the heading is not constrained, however many inliers there are.
  Random random(1);
  Points source(3, 60);
  for (Eigen::Index i = 0; i < source.cols(); ++i) {
    source.col(i) << 5.0 + 0.02 * RandomNormal(random),
        3.0 + 0.02 * RandomNormal(random), 6.0 * random.Uniform();
  }
  const Points target = source.colwise() + Eigen::Vector3d(1.0, 0.5, 0.1);
  const RegistrationSummary summary = RegisterMatches({source, target}, {});
  ASSERT_THAT(summary.error, IsEmpty());
  EXPECT_EQ(summary.verdict.status, Status::kDegenerate)
      << summary.verdict.reason;
}

TEST(RegisterMatches, RefusesWhatNeedsClouds) {
  const Points points = RandomPoints(20, 5.0, 1);
  RegistrationOptions options;
  for (const char* method : {"icp", "quatro_c2f"}) {
    options.method = method;
    EXPECT_THAT(RegisterMatches({points, points}, options).error,
                HasSubstr("works on clouds, not on matches"));
  }
  options = {};
  options.refinement.method = RefinementMethod::kGicp;
  EXPECT_THAT(RegisterMatches({points, points}, options).error,
              HasSubstr("refinement needs clouds"));
  options = {};
  options.method = "nothing";
  EXPECT_THAT(RegisterMatches({points, points}, options).error,
              HasSubstr("must be one of"));
}

TEST_F(RegistrationTest, TargetIsRegisteredLikeItsCloud) {
  ExpectSameBits(Target(target_, options_).Register(source_),
                 Register(source_, target_, options_));
}

TEST_F(RegistrationTest, BareGroundIsNotRegistered) {
  const auto ground = [](std::uint64_t seed) {
    return CloudOf(RandomPlane(6000, 20.0, seed).points.colwise() -
                   Eigen::Vector3d(0.0, 0.0, 2.0));
  };
  const RegistrationSummary summary = Register(ground(1), ground(2), options_);
  EXPECT_THAT(summary.error, IsEmpty());
  EXPECT_FALSE(summary.verdict.IsRegistered()) << summary.verdict.reason;
}

TEST_F(RegistrationTest, OnePointIsInsufficient) {
  const PointCloud point = CloudOf(Points::Ones(3, 1));
  const RegistrationSummary summary = Register(point, target_, options_);
  EXPECT_THAT(summary.error, IsEmpty());
  EXPECT_EQ(summary.verdict.status, Status::kInsufficient)
      << summary.verdict.reason;
  EXPECT_FALSE(summary.target_from_source().has_value());
}

TEST_F(RegistrationTest, CloudWithoutPointsIsAnErrorThatSaysWhich) {
  const PointCloud empty = CloudOf(Points(3, 0));
  EXPECT_THAT(Register(empty, target_, options_).error,
              HasSubstr("source has no points"));
  const RegistrationSummary summary = Register(source_, empty, options_);
  EXPECT_THAT(summary.error, HasSubstr("target has no points"));
  EXPECT_FALSE(summary.target_from_source().has_value());
  EXPECT_FALSE(summary.verdict.IsRegistered());
}

TEST_F(RegistrationTest, CloudThatIsTooWideIsAnError) {
  PointCloud wide = source_;
  wide.points.col(0).setConstant(1e9);
  const RegistrationSummary summary = Register(wide, target_, options_);
  EXPECT_THAT(summary.error, HasSubstr("voxel"));
  EXPECT_FALSE(summary.target_from_source().has_value());
}

TEST(RegistrationOptionsCheck, DefaultsAreValid) {
  std::string error;
  EXPECT_TRUE(RegistrationOptions().IsValid(&error)) << error;
  EXPECT_TRUE(error.empty());
}

TEST(RegistrationOptionsCheck, ErrorNamesTheFieldAndNothingIsTried) {
  const auto expect_error = [](const auto& change, const char* field) {
    RegistrationOptions options;
    change(&options);
    std::string error;
    EXPECT_FALSE(options.IsValid(&error)) << field;
    EXPECT_THAT(error, HasSubstr(field));
    const PointCloud street = CloudOf(RandomStreet(100, 0.0, 1));
    const RegistrationSummary summary = Register(street, street, options);
    EXPECT_EQ(summary.error, error);
    EXPECT_FALSE(summary.target_from_source().has_value());
    EXPECT_THAT(summary.stage_times, IsEmpty());
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  using Options = RegistrationOptions*;
  expect_error([](Options o) { o->front_end.voxel_size = 0.0; },
               "voxel_size = 0");
  expect_error([](Options o) { o->front_end.voxel_size = kInfinity; },
               "voxel_size = inf");
  expect_error([](Options o) { o->front_end.normal_radius = -1.0; },
               "normal_radius = -1");
  expect_error([](Options o) { o->front_end.fpfh_radius = 0.1; },
               "fpfh_radius = 0.1");
  expect_error([](Options o) { o->front_end.fpfh_radius = 30.1; },
               "fpfh_radius = 30.1, must be <= 100 voxel_size = 30");
  expect_error([](Options o) { o->front_end.fpfh_radius = kInfinity; },
               "fpfh_radius = inf, must be <= 100 voxel_size = 30");
  expect_error([](Options o) { o->front_end.tuple.scale = 1.0; }, "scale = 1");
  expect_error([](Options o) { o->noise_bound = 0.0; }, "noise_bound = 0");
  expect_error([](Options o) { o->quatro.gnc.max_num_iterations = 0; },
               "max_num_iterations = 0");
  expect_error([](Options o) { o->verdict.min_probability = 2.0; },
               "min_probability = 2");
  expect_error([](Options o) { o->ins.attitude_std = 0.0; },
               "ins.attitude_std = 0");
  expect_error([](Options o) { o->ins.up.setZero(); }, "ins.up = (0 0 0)");
  expect_error([](Options o) { o->num_threads = -2; }, "num_threads = -2");
}

}  // namespace
}  // namespace quatro::registration_test
