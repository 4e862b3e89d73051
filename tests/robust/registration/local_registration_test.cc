// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/local_registration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/random_problems.h"

namespace quatro::local_registration_test {
namespace {

using ::testing::HasSubstr;

PointCloud CloudOf(const Points& points) {
  PointCloud cloud;
  cloud.points = points;
  return cloud;
}

RegistrationOptions By(RefinementMethod method) {
  RegistrationOptions options;
  options.refinement.method = method;
  return options;
}

constexpr RefinementMethod kMethods[] = {
    RefinementMethod::kIcp, RefinementMethod::kGicp, RefinementMethod::kVgicp};

TEST(RegisterLocally, FindsAPoseNearTheGuessAndDoesNotVouchForIt) {
  const Rigid3 truth{RotationZ(0.7), {1.0, -0.8, 0.1}};
  const Rigid3 guess{RotationZ(0.72), {1.2, -0.7, 0.1}};
  const PointCloud source =
      CloudOf(Inverse(truth).Apply(RandomStreet(12000, 0.01, 1)));
  const PointCloud target = CloudOf(RandomStreet(12000, 0.01, 2));
  for (const RefinementMethod method : kMethods) {
    const RegistrationSummary summary =
        RegisterLocally(source, target, guess, By(method));
    EXPECT_EQ(summary.error, "");
    ASSERT_TRUE(summary.target_from_source().has_value())
        << summary.solution.message;
    EXPECT_LE(
        (summary.target_from_source()->translation - truth.translation).norm(),
        0.1);
    EXPECT_EQ(summary.verdict.status, Status::kAmbiguous);
    EXPECT_THAT(summary.verdict.reason, HasSubstr("guess"));
    ASSERT_TRUE(summary.refinement.has_value());
    EXPECT_EQ(summary.refinement->unrefined_target_from_source.ToMatrix(),
              guess.ToMatrix());
    EXPECT_GT(summary.refinement->moved_translation, 0.1);
    EXPECT_GT(summary.num_source_voxels, 1000);
    EXPECT_EQ(summary.matched_source.cols(), 0);

    RegistrationOptions threads = By(method);
    threads.num_threads = 2;
    EXPECT_EQ(RegisterLocally(source, target, guess, threads)
                  .target_from_source()
                  ->ToMatrix(),
              summary.target_from_source()->ToMatrix());
  }
}

TEST(RegisterLocally, WithoutAnAnswerSaysWhy) {
  const PointCloud street = CloudOf(RandomStreet(3000, 0.01, 1));
  const PointCloud plane = CloudOf(RandomPlane(5000, 20.0, 1).points);
  for (const RefinementMethod method : kMethods) {
    const RegistrationSummary one = RegisterLocally(
        CloudOf(Points::Ones(3, 1)), street, Rigid3(), By(method));
    EXPECT_EQ(one.verdict.status, Status::kInsufficient);
    EXPECT_FALSE(one.target_from_source().has_value());
    EXPECT_THAT(one.verdict.reason, HasSubstr("source has 1 points"));

    const RegistrationSummary far =
        RegisterLocally(street,
                        street,
                        Rigid3{Eigen::Matrix3d::Identity(), {1000.0, 0.0, 0.0}},
                        By(method));
    EXPECT_EQ(far.verdict.status, Status::kInsufficient);
    EXPECT_FALSE(far.target_from_source().has_value());
  }
  const RegistrationSummary flat =
      RegisterLocally(plane, plane, Rigid3(), By(RefinementMethod::kGicp));
  EXPECT_EQ(flat.verdict.status, Status::kDegenerate);
  EXPECT_EQ(flat.solution.termination, PoseTermination::kDegenerate);
  EXPECT_FALSE(flat.target_from_source().has_value());
}

TEST(RegisterLocally, BadInputIsAnError) {
  const PointCloud street = CloudOf(RandomStreet(3000, 0.01, 1));
  const PointCloud none = CloudOf(Points(3, 0));
  const RegistrationOptions gicp = By(RefinementMethod::kGicp);
  EXPECT_THAT(RegisterLocally(none, street, Rigid3(), gicp).error,
              HasSubstr("source has no points"));
  EXPECT_THAT(RegisterLocally(street, none, Rigid3(), gicp).error,
              HasSubstr("target has no points"));
  EXPECT_THAT(RegisterLocally(street, street, Rigid3(), {}).error,
              HasSubstr("refinement.method is none"));
  Rigid3 nowhere;
  nowhere.translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(RegisterLocally(street, street, nowhere, gicp).error,
              HasSubstr("initial pose is not finite"));
  RegistrationOptions bad = gicp;
  bad.front_end.voxel_size = 0.0;
  EXPECT_THAT(RegisterLocally(street, street, Rigid3(), bad).error,
              HasSubstr("voxel_size = 0"));
}

}  // namespace
}  // namespace quatro::local_registration_test
