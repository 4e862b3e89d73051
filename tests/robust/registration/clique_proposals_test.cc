// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/clique_proposals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/matched_problems.h"

namespace quatro::clique_proposals_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

bool IsNear(const Rigid3& a, const Rigid3& b) {
  return AngleBetween(a.rotation, b.rotation) < 0.03 &&
         (a.translation - b.translation).norm() < 0.5;
}

// A tilt of 0.5 rad moves points of the yaw-only model by many noise bounds.
TEST(ProposeByCliques, FindsTiltedPosesInSo3) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    KnownProblem problem =
        MakeMatchedProblem({.num_inliers = 30, .num_outliers = 60}, seed);
    const Eigen::Matrix3d tilt =
        Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()).toRotationMatrix();
    problem.source = tilt * problem.source;
    Rigid3 truth = problem.true_target_from_source;
    truth.rotation = truth.rotation * tilt.transpose();
    int num_near = 0;
    for (const ProposedPose& pose :
         ProposeByCliques(problem.source, problem.target, {})) {
      if (!IsNear(pose.target_from_source, truth)) continue;
      ++num_near;
      EXPECT_THAT(pose.origin, HasSubstr("SO(3)")) << seed;
    }
    EXPECT_EQ(num_near, 2) << seed;
  }
}

// With errors of up to 0.8 m on each axis, few matches are consistent at the
// noise bound of 0.3 m.
TEST(ProposeByCliques, TheWiderBoundFindsNoisyMatches) {
  int num_narrow = 0;
  int num_wide = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const KnownProblem problem = MakeMatchedProblem(
        {.num_inliers = 6, .num_outliers = 400, .noise = 0.8}, seed);
    for (const ProposedPose& pose :
         ProposeByCliques(problem.source, problem.target, {})) {
      const bool is_near =
          AngleBetween(pose.target_from_source.rotation,
                       problem.true_target_from_source.rotation) < 0.1 &&
          (pose.target_from_source.translation -
           problem.true_target_from_source.translation)
                  .norm() < 2.0;
      if (pose.origin.ends_with("x 1")) num_narrow += is_near;
      if (pose.origin.ends_with("x 2")) num_wide += is_near;
    }
  }
  EXPECT_GT(num_wide, num_narrow);
}

TEST(ProposeByCliques, HasNoneWithoutMatches) {
  EXPECT_THAT(ProposeByCliques(Points(3, 0), Points(3, 0), {}), IsEmpty());
}

}  // namespace
}  // namespace quatro::clique_proposals_test
