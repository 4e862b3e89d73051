// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/fgr_clouds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro {
namespace {

using ::testing::HasSubstr;

PointCloud CloudOf(const Points& points) {
  PointCloud cloud;
  cloud.points = points;
  return cloud;
}

// Two scans of one street corner, sampled anew and from different places.
class RegisterByFgrTest : public ::testing::Test {
 protected:
  const Rigid3 true_target_from_source_{RotationZ(0.7), {1.0, -0.8, 0.1}};
  const PointCloud source_ =
      CloudOf(Inverse(true_target_from_source_)
                  .Apply(RandomStreet(12000, 0.01, /*seed=*/1)));
  const PointCloud target_ = CloudOf(RandomStreet(12000, 0.01, /*seed=*/2));
};

TEST_F(RegisterByFgrTest, FindsTheMotionBetweenTwoScans) {
  const RegistrationSummary summary = RegisterByFgr(source_, target_, {}, {});
  ASSERT_TRUE(summary.target_from_source().has_value())
      << summary.solution.message;
  EXPECT_TRUE(summary.verdict.IsRegistered()) << summary.verdict.reason;
  EXPECT_LE(LargestDisplacement(*summary.target_from_source(),
                                true_target_from_source_,
                                source_.points),
            0.3);
}

TEST_F(RegisterByFgrTest, IsFgrOnTheMatchesOfItsTupleTest) {
  RegistrationOptions options;
  options.quatro.noise_bound = 0.2;
  options.front_end.tuple.scale = 0.5;  // Replaced.
  const RegistrationSummary summary =
      RegisterByFgr(source_, target_, options, {});
  FgrOptions fgr;
  fgr.noise_bound = 0.2;
  const FgrSummary expected =
      SolveFgr(summary.matched_source, summary.matched_target, fgr);
  ASSERT_TRUE(summary.target_from_source() && expected.IsUsable());
  EXPECT_EQ(summary.target_from_source()->ToMatrix(),
            expected.target_from_source->ToMatrix());
  RegistrationOptions front_door;
  front_door.front_end = WithTupleTestOfFgr({});
  EXPECT_EQ(summary.matched_source,
            Register(source_, target_, front_door).matched_source);
  options.num_threads = 3;
  EXPECT_EQ(RegisterByFgr(source_, target_, options, {})
                .target_from_source()
                ->ToMatrix(),
            summary.target_from_source()->ToMatrix());
}

TEST(WithTupleTestOfFgr, HasItsNumbersAndKeepsTheRest) {
  FrontEndOptions options;
  options.voxel_size = 0.17;
  options.tuple_test = false;
  options.tuple = {0.5, 7, 3, 9};
  const FrontEndOptions changed = WithTupleTestOfFgr(options);
  EXPECT_EQ(changed.voxel_size, 0.17);
  EXPECT_TRUE(changed.tuple_test);
  EXPECT_EQ(changed.tuple.scale, 0.95);
  EXPECT_EQ(changed.tuple.num_triples_per_match, 100);
  EXPECT_EQ(changed.tuple.max_num_triples, 1000);
  EXPECT_EQ(changed.tuple.seed, 9u);
}

TEST_F(RegisterByFgrTest, BadOptionsAndCloudsAreRefused) {
  FgrOptions fgr;
  fgr.mu_step = 0.5;
  EXPECT_THAT(RegisterByFgr(source_, target_, {}, fgr).error,
              HasSubstr("mu_step = 0.5"));
  RegistrationOptions options;
  options.quatro.noise_bound = -1.0;
  EXPECT_THAT(RegisterByFgr(source_, target_, options, {}).error,
              HasSubstr("noise_bound = -1"));
  EXPECT_THAT(RegisterByFgr({}, target_, {}, {}).error, HasSubstr("no points"));
}

}  // namespace
}  // namespace quatro
