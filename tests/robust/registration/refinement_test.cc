// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/refinement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "robust/registration/registration.h"
#include "tests/support/alignment_problems.h"
#include "tests/support/described_clouds.h"
#include "tests/support/random_problems.h"

namespace quatro::refinement_test {
namespace {

using ::testing::HasSubstr;

constexpr RefinementMethod kMethods[] = {
    RefinementMethod::kIcp, RefinementMethod::kGicp, RefinementMethod::kVgicp};

struct Prepared {
  explicit Prepared(const Points& points)
      : tree(points),
        normals(EstimateNearestNormals(tree, 20, 1)),
        described(MakeDescribedCloud(points, normals)) {}
  const DescribedCloud& cloud() const { return described; }

  KdTree tree;
  Points normals;
  DescribedCloud described;
};

class RefinementTest : public ::testing::Test {
 protected:
  const Rigid3 truth_{RotationZ(0.4), {2.0, -1.0, 0.3}};
  const Prepared source_{Inverse(truth_).Apply(RandomStreet(4000, 0.01, 1))};
  const Prepared target_{RandomStreet(4000, 0.01, 2)};
  const Points matched_source_ = source_.tree.points().leftCols(40);
  const Points matched_target_ =
      truth_.Apply(matched_source_) + RandomPoints(40, 0.05, 3);
  RefinementOptions options_;

  Rigid3 Off(double angle, double distance) const {
    Vector6 delta;
    delta << angle * RandomDirection(5), distance * RandomDirection(6);
    return Perturbed({}, delta) * truth_;
  }
  RefinementSummary Refine(const Rigid3& pose) const {
    return quatro::Refine(source_.cloud(),
                          target_.cloud(),
                          matched_source_,
                          matched_target_,
                          0.3,
                          pose,
                          options_);
  }
  static void ExpectKept(const RefinementSummary& summary,
                         const Rigid3& pose,
                         const char* why) {
    EXPECT_FALSE(summary.is_accepted);
    EXPECT_THAT(summary.message, HasSubstr(why));
    EXPECT_EQ(summary.target_from_source.ToMatrix(), pose.ToMatrix());
    EXPECT_EQ(summary.unrefined_target_from_source.ToMatrix(), pose.ToMatrix());
  }
  double Error(const Rigid3& pose) const {
    return (pose.Apply(source_.tree.points()) -
            truth_.Apply(source_.tree.points()))
        .colwise()
        .norm()
        .maxCoeff();
  }
};

TEST_F(RefinementTest, BringsANearlyRightPoseHome) {
  const Rigid3 pose = Off(0.03, 0.2);
  for (const RefinementMethod method : kMethods) {
    options_.method = method;
    const RefinementSummary summary = Refine(pose);
    EXPECT_TRUE(summary.is_accepted) << summary.message;
    EXPECT_EQ(summary.method, method);
    EXPECT_EQ(summary.message, "refined");
    EXPECT_LE(Error(summary.target_from_source), 0.1);
    EXPECT_GT(Error(summary.unrefined_target_from_source), 0.2);
    EXPECT_EQ(summary.target_from_source.ToMatrix(),
              summary.alignment.target_from_source->ToMatrix());
    const Eigen::Vector3d middle = source_.tree.points().rowwise().mean();
    EXPECT_NEAR(summary.moved_translation,
                (summary.target_from_source * middle - pose * middle).norm(),
                1e-12);
    EXPECT_NEAR(summary.moved_rotation, 0.03, 0.005);
  }
}

TEST_F(RefinementTest, NoneIsNoAnswer) {
  ExpectKept(Refine(truth_), truth_, "the alignment was not run");
}

// A right pose, and clouds of which one was carried off: what is found there is
// not what the matches say.
TEST_F(RefinementTest, APoseThatContradictsTheMatchesIsRefused) {
  options_.method = RefinementMethod::kGicp;
  const Rigid3 shift{Eigen::Matrix3d::Identity(), {0.8, 0.7, 0.3}};
  const Prepared carried(shift.Apply(target_.tree.points()));
  const auto refine = [&] {
    return quatro::Refine(source_.cloud(),
                          carried.cloud(),
                          matched_source_,
                          matched_target_,
                          0.3,
                          truth_,
                          options_);
  };
  options_.alignment.max_correspondence_distance = 2.0;
  const RefinementSummary refused = refine();
  ExpectKept(refused, truth_, "contradicts the matches");
  EXPECT_GT(refused.moved_translation, 0.6);
  options_.min_kept_matches = 0.0;
  EXPECT_TRUE(refine().is_accepted);
}

TEST_F(RefinementTest, APoseTooFarAwayIsRefused) {
  options_.method = RefinementMethod::kGicp;
  const Rigid3 pose = Off(0.03, 0.2);
  options_.max_translation = 0.05;
  ExpectKept(Refine(pose), pose, "too far");
  options_.max_translation = 2.0;
  options_.max_rotation = 0.01;
  ExpectKept(Refine(pose), pose, "too far");
}

TEST_F(RefinementTest, WhatDidNotConvergeIsRefused) {
  options_.method = RefinementMethod::kGicp;
  options_.alignment.max_num_iterations = 1;
  const Rigid3 pose = Off(0.03, 0.2);
  ExpectKept(Refine(pose), pose, "not converged");
}

TEST_F(RefinementTest, ABarePlaneIsRefusedWithItsDirection) {
  options_.method = RefinementMethod::kGicp;
  const Prepared a(RandomPlane(2000, 20.0, 1).points);
  const Prepared b(RandomPlane(2000, 20.0, 2).points);
  const RefinementSummary summary = quatro::Refine(
      a.cloud(), b.cloud(), Points(3, 0), Points(3, 0), 0.3, {}, options_);
  ExpectKept(summary, {}, "do not constrain a");
  EXPECT_EQ(summary.alignment.termination, AlignmentTermination::kDegenerate);
}

TEST(RefinementOptions, ErrorNamesTheField) {
  const auto expect_error = [](const auto& change, const char* field) {
    RegistrationOptions options;
    change(&options.refinement);
    std::string error;
    EXPECT_FALSE(options.IsValid(&error)) << field;
    EXPECT_THAT(error, HasSubstr(field));
  };
  using Options = RefinementOptions*;
  expect_error([](Options o) { o->max_translation = 0.0; },
               "refinement.max_translation = 0");
  expect_error([](Options o) { o->max_rotation = -1.0; },
               "refinement.max_rotation = -1");
  expect_error([](Options o) { o->min_kept_matches = 2.0; },
               "refinement.min_kept_matches = 2");
  expect_error([](Options o) { o->epsilon = 0.0; }, "refinement.epsilon = 0");
  expect_error([](Options o) { o->voxel_size = 0.0; },
               "refinement.voxel_size = 0");
  expect_error([](Options o) { o->alignment.max_num_iterations = 0; },
               "refinement.max_num_iterations = 0");
}

// The front door

PointCloud CloudOf(const Points& points) {
  PointCloud cloud;
  cloud.points = points;
  return cloud;
}

TEST(RegisterWithRefinement, PoseIsRefinedAndTheOneBeforeIsKept) {
  const Rigid3 truth{RotationZ(0.7), {1.0, -0.8, 0.1}};
  const PointCloud source =
      CloudOf(Inverse(truth).Apply(RandomStreet(12000, 0.01, 1)));
  const PointCloud target = CloudOf(RandomStreet(12000, 0.01, 2));
  RegistrationOptions options;
  const RegistrationSummary plain = Register(source, target, options);
  EXPECT_FALSE(plain.refinement.has_value());
  ASSERT_TRUE(plain.target_from_source().has_value());
  for (const RefinementMethod method : kMethods) {
    options.refinement.method = method;
    options.num_threads = 1;
    const RegistrationSummary one = Register(source, target, options);
    ASSERT_TRUE(one.refinement.has_value());
    EXPECT_TRUE(one.refinement->is_accepted) << one.refinement->message;
    EXPECT_EQ(one.refinement->unrefined_target_from_source.ToMatrix(),
              plain.target_from_source()->ToMatrix());
    EXPECT_EQ(one.target_from_source()->ToMatrix(),
              one.refinement->target_from_source.ToMatrix());
    EXPECT_TRUE(one.verdict.IsRegistered()) << one.verdict.reason;
    EXPECT_LE(
        (one.target_from_source()->translation - truth.translation).norm(),
        0.1);
    EXPECT_TRUE(std::any_of(
        one.stage_times.begin(),
        one.stage_times.end(),
        [](const StageTime& time) { return time.stage == "refinement"; }));

    options.num_threads = 2;
    const RegistrationSummary two = Register(source, target, options);
    EXPECT_EQ(two.target_from_source()->ToMatrix(),
              one.target_from_source()->ToMatrix());
  }
}

// The verdict is on the pose that is given.
TEST(RegisterWithRefinement, VerdictJudgesTheRefinedPose) {
  const PointCloud source = CloudOf(RandomStreet(12000, 0.01, 1));
  const PointCloud target = CloudOf(RandomStreet(12000, 0.01, 2));
  RegistrationOptions options;
  options.solver = [](const PointsRef&, const PointsRef&) {
    PoseSummary summary;
    summary.termination = PoseTermination::kSolved;
    summary.target_from_source =
        Rigid3{Eigen::Matrix3d::Identity(), {0.5, 0.4, 0.0}};
    return summary;
  };
  const auto before = Register(source, target, options).verdict.num_inliers;
  options.refinement.method = RefinementMethod::kGicp;
  const auto after = Register(source, target, options).verdict.num_inliers;
  EXPECT_GT(after, 2 * before);
}

TEST(RegisterWithRefinement, NothingIsTriedWithoutAPose) {
  RegistrationOptions options;
  options.refinement.method = RefinementMethod::kGicp;
  const RegistrationSummary summary =
      Register(CloudOf(Points::Ones(3, 1)),
               CloudOf(RandomStreet(2000, 0.01, 2)),
               options);
  EXPECT_FALSE(summary.refinement.has_value());
  EXPECT_FALSE(summary.target_from_source().has_value());
}

}  // namespace
}  // namespace quatro::refinement_test
