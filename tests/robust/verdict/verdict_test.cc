// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "robust/estimators/quatro.h"
#include "robust/estimators/teaser.h"
#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::verdict_test {
namespace {

using ::testing::HasSubstr;

constexpr double kNoiseBound = 0.3;  // [m]

// The summary of an estimator that found the true pose.
PoseSummary TruthOf(const KnownProblem& problem) {
  PoseSummary summary;
  summary.termination = PoseTermination::kSolved;
  summary.target_from_source = problem.true_target_from_source;
  summary.consistent = problem.inliers;
  return summary;
}

Verdict JudgeTruth(const KnownProblem& problem,
                   const VerdictOptions& options = {}) {
  return Judge(problem.source,
               problem.target,
               TruthOf(problem),
               kNoiseBound,
               std::nullopt,
               options);
}

double Log10FalseAlarms(const Verdict& verdict) {
  return verdict.false_alarms.back().log10_false_alarms;
}

TEST(Judge, RegistersAGoodConsensus) {
  for (const Eigen::Index num_inliers : {12, 20, 100}) {
    const KnownProblem problem =
        MakeMatchedProblem({.num_inliers = num_inliers, .num_outliers = 200},
                           /*seed=*/1);
    const Verdict verdict = JudgeTruth(problem);
    EXPECT_TRUE(verdict.IsRegistered()) << verdict.reason;
    EXPECT_EQ(verdict.num_matches, num_inliers + 200);
    EXPECT_GE(verdict.num_inliers, num_inliers);
    EXPECT_LT(verdict.num_inliers, num_inliers + 3);
    EXPECT_LE(Log10FalseAlarms(verdict), -3.0);
  }
}

TEST(Judge, OfTwoMatchesIsAmbiguous) {
  const Verdict verdict = JudgeTruth(
      MakeMatchedProblem({.num_inliers = 2, .num_outliers = 100}, /*seed=*/4));
  EXPECT_EQ(verdict.status, Status::kAmbiguous) << verdict.reason;
  EXPECT_THAT(verdict.reason, HasSubstr("chance alone could"));
}

TEST(Judge, OfACrowdIsAmbiguous) {
  // All points are within the noise bound of each other, so many poses fit.
  const Verdict verdict = JudgeTruth(MakeMatchedProblem(
      {.num_inliers = 100, .half_widths = {0.05, 0.05, 0.05}}, /*seed=*/5));
  EXPECT_EQ(verdict.status, Status::kAmbiguous) << verdict.reason;
  EXPECT_GT(verdict.num_inliers, 50);
}

TEST(Judge, OfTooFewMatchesIsAmbiguous) {
  for (const Eigen::Index n : {0, 1, 2}) {
    const Verdict verdict = JudgeTruth(
        MakeMatchedProblem({.num_inliers = n, .num_outliers = 0}, /*seed=*/6));
    EXPECT_EQ(verdict.status, Status::kAmbiguous) << verdict.reason;
    EXPECT_GE(Log10FalseAlarms(verdict), 0.0) << n << " matches";
  }
}

TEST(Judge, CopiesAreNoEvidence) {
  const KnownProblem problem = MakeMatchedProblem({}, /*seed=*/7);
  const Verdict once = JudgeTruth(problem);
  const Verdict twice = Judge(problem.source.replicate(1, 2),
                              problem.target.replicate(1, 2),
                              TruthOf(problem),
                              kNoiseBound,
                              std::nullopt,
                              {});
  EXPECT_EQ(twice.num_matches, once.num_matches);
  EXPECT_EQ(twice.num_inliers, once.num_inliers);
  EXPECT_EQ(Log10FalseAlarms(twice), Log10FalseAlarms(once));
  EXPECT_EQ(twice.probability, once.probability);
}

TEST(Judge, StagesAreThoseWhereAConsensusIsChosen) {
  const Verdict verdict = JudgeTruth(MakeMatchedProblem({}, /*seed=*/12));
  ASSERT_EQ(verdict.false_alarms.size(), 3u);
  EXPECT_EQ(verdict.false_alarms[0].stage, "clique");
  EXPECT_EQ(verdict.false_alarms[1].stage, "rotation");
  EXPECT_EQ(verdict.false_alarms[2].stage, "pose");
  for (const FalseAlarms& alarms : verdict.false_alarms) {
    EXPECT_LT(alarms.log10_false_alarms, -10.0) << alarms.stage;
  }
}

TEST(Judge, ReasonNamesTheNumbers) {
  const Verdict verdict = JudgeTruth(
      MakeMatchedProblem({.num_inliers = 30, .num_outliers = 40}, /*seed=*/8));
  EXPECT_THAT(verdict.reason,
              HasSubstr(std::to_string(verdict.num_inliers) + " of 70 "));
  EXPECT_THAT(verdict.reason,
              HasSubstr("1e" + std::to_string(static_cast<int>(
                                   -Log10FalseAlarms(verdict)))));
}

TEST(Judge, ThresholdIsTheOption) {
  const KnownProblem problem =
      MakeMatchedProblem({.num_inliers = 12, .num_outliers = 60}, /*seed=*/9);
  const double probability = JudgeTruth(problem).probability;
  VerdictOptions options;
  options.min_probability = probability - 1e-9;
  EXPECT_TRUE(JudgeTruth(problem, options).IsRegistered());
  options.min_probability = probability + 1e-9;
  EXPECT_EQ(JudgeTruth(problem, options).status, Status::kAmbiguous);
}

TEST(Judge, DoesNotRegisterAPoleAndALuckyMatch) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    // 20 matches on a pole, and one of 100 others that is an inlier for some
    // yaw.
    Random random(seed);
    KnownProblem problem = MakeMatchedProblem(
        {.num_inliers = 20, .num_outliers = 0, .half_widths = {0.1, 0.1, 3.0}},
        seed);
    Points pole = problem.source;
    Points pole_target = problem.target;
    problem = MakeMatchedProblem({.num_inliers = 1, .num_outliers = 99}, seed);
    Points source(3, 120);
    Points target(3, 120);
    source << pole, problem.source;
    target << pole_target, problem.target;
    const QuatroSummary summary = SolveQuatro(source, target, {});
    const Verdict verdict =
        Judge(source, target, summary, kNoiseBound, std::nullopt, {});
    EXPECT_FALSE(verdict.IsRegistered())
        << "seed " << seed << ": " << verdict.reason;
  }
}

TEST(Judge, DoesNotRegisterOneOfTwoTwins) {
  KnownProblem problem =
      MakeMatchedProblem({.num_inliers = 80, .num_outliers = 200}, /*seed=*/11);
  const Rigid3 twin{RotationZ(M_PI), Eigen::Vector3d(2.0, 1.0, 0.0)};
  for (std::size_t k = 0; k < 38; ++k) {
    const Eigen::Index i = problem.inliers[k];
    problem.target.col(i) = twin * Eigen::Vector3d(problem.target.col(i));
  }
  const Verdict verdict = JudgeTruth(problem);
  EXPECT_EQ(verdict.status, Status::kAmbiguous) << verdict.reason;
  ASSERT_TRUE(verdict.rival);
  EXPECT_GE(verdict.rival->num_inliers, 38);
  EXPECT_THAT(verdict.reason, HasSubstr("inliers of another pose"));
  EXPECT_THAT(verdict.reason, HasSubstr("180 deg"));
}

TEST(Judge, TakesTheCloudsIntoAccount) {
  const KnownProblem problem =
      MakeMatchedProblem({.num_inliers = 15, .num_outliers = 100}, /*seed=*/13);
  const auto judge = [&](const GeometricEvidence& geometry) {
    return Judge(problem.source,
                 problem.target,
                 TruthOf(problem),
                 kNoiseBound,
                 geometry,
                 {});
  };
  GeometricEvidence good;
  good.structure_overlap = 0.7;
  good.free_space = {3, 97};
  good.weakest_share = 0.3;
  good.rival_free_space = {30, 70};
  good.rival.overlap = 0.7;
  good.rival.rival_overlap = 0.2;
  EXPECT_TRUE(judge(good).IsRegistered()) << judge(good).reason;
  GeometricEvidence bad = good;
  bad.structure_overlap = 0.05;
  bad.rival.overlap = 0.05;
  bad.rival.rival_overlap = 0.04;
  bad.free_space = {60, 40};
  EXPECT_EQ(judge(bad).status, Status::kAmbiguous) << judge(bad).reason;
  EXPECT_THAT(judge(bad).reason, HasSubstr("saw to be free"));
  EXPECT_THAT(judge(bad).reason, HasSubstr("overlap as well"));
}

// The paper's criterion at the noise bound of preset kitti.
TEST(ToleranceOf, ScalesWithTheNoiseBound) {
  EXPECT_NEAR(ToleranceOf(0.3).translation, 2.0, 1e-12);
  EXPECT_NEAR(ToleranceOf(0.3).rotation, M_PI / 18.0, 1e-12);
  EXPECT_NEAR(ToleranceOf(0.006).translation, 0.04, 1e-12);
  EXPECT_EQ(ToleranceOf(0.006).rotation, ToleranceOf(0.3).rotation);
}

TEST(Judge, MoreInliersNearASearchedPoseNeverLowerItsProbability) {
  const KnownProblem problem =
      MakeMatchedProblem({.num_inliers = 15, .num_outliers = 100}, /*seed=*/13);
  GeometricEvidence evidence;
  evidence.structure_overlap = 0.2;
  evidence.free_space = {3, 97};
  evidence.weakest_share = 0.3;
  evidence.rival_free_space = {30, 70};
  evidence.rival.overlap = 0.2;
  evidence.rival.rival_overlap = 0.1;
  const auto probability_of =
      [&](Eigen::Index num_inliers, bool is_first, double segment_ratio = 3.0) {
        evidence.search = SearchEvidence{.num_guided_matches = 1000,
                                         .num_guided_inliers = num_inliers,
                                         .segment_ratio = segment_ratio,
                                         .is_first = is_first};
        const Verdict verdict = Judge(problem.source,
                                      problem.target,
                                      TruthOf(problem),
                                      kNoiseBound,
                                      evidence,
                                      {});
        return verdict.probability;
      };
  EXPECT_GT(probability_of(50, true), probability_of(20, true));
  EXPECT_GT(probability_of(20, true), probability_of(0, true));
  EXPECT_EQ(probability_of(500, true), probability_of(100, true));
  EXPECT_GT(probability_of(50, true), probability_of(50, false));
  EXPECT_GT(probability_of(50, true, 6.0), probability_of(50, true, 3.0));
  EXPECT_EQ(probability_of(50, true, 60.0), probability_of(50, true, 10.0));
}

// Points distributed as in scans: near a plane, and dense near the sensor.
Points ScanLikePoints(Eigen::Index n, Random* random) {
  Points points(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double range = 3.0 * std::pow(20.0, random->Uniform());
    const double azimuth = M_PI * SignedUniform(random);
    points.col(i) << range * std::cos(azimuth), range * std::sin(azimuth),
        random->Below(2) == 0 ? 0.1 * random->Uniform()
                              : 4.0 * random->Uniform();
  }
  return points;
}

TEST(Judge, DoesNotRegisterMatchesAtRandom) {
  int num_registered = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const Eigen::Index n = 20 + 20 * static_cast<Eigen::Index>(seed % 10);
    const bool scan_like = seed % 2;
    const Eigen::Vector3d box(30.0, 30.0, 3.0);
    const Points source = scan_like ? ScanLikePoints(n, &random)
                                    : RandomPointsInBox(n, box, &random);
    const Points target = scan_like ? ScanLikePoints(n, &random)
                                    : RandomPointsInBox(n, box, &random);
    const QuatroSummary summary = SolveQuatro(source, target, {});
    const Verdict verdict =
        Judge(source, target, summary, kNoiseBound, std::nullopt, {});
    if (verdict.IsRegistered()) {
      ++num_registered;
      RecordProperty("registered_seed", static_cast<int>(seed));
    }
  }
  EXPECT_LE(num_registered, 1) << "of 200";
}

TEST(Judge, RegistersWhatQuatroFoundAmongOutliers) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const KnownProblem problem =
        MakeMatchedProblem({.num_inliers = 20, .num_outliers = 180}, seed);
    const QuatroSummary summary =
        SolveQuatro(problem.source, problem.target, {});
    const Verdict verdict = Judge(
        problem.source, problem.target, summary, kNoiseBound, std::nullopt, {});
    EXPECT_TRUE(verdict.IsRegistered())
        << "seed " << seed << ": " << verdict.reason;
  }
}

// With one or two inliers nothing rules out chance.
TEST(Judge, NeverRegistersAWrongAnswerFromOneMatchOrTwo) {
  int num_right = 0;
  for (const Eigen::Index num_inliers : {1, 2}) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const KnownProblem problem = MakeInconsistentProblem(
          {.num_inliers = num_inliers, .num_outliers = 30}, 0.6, seed);
      const QuatroSummary yaw_only =
          SolveQuatro(problem.source, problem.target, {});
      const TeaserSummary rigid =
          SolveTeaser(problem.source, problem.target, {});
      for (const PoseSummary* summary :
           {static_cast<const PoseSummary*>(&yaw_only),
            static_cast<const PoseSummary*>(&rigid)}) {
        const Verdict verdict = Judge(problem.source,
                                      problem.target,
                                      *summary,
                                      kNoiseBound,
                                      std::nullopt,
                                      {});
        const bool is_right =
            summary->IsUsable() &&
            AngleBetween(summary->target_from_source->rotation,
                         problem.true_target_from_source.rotation) < 0.05;
        EXPECT_TRUE(is_right || !verdict.IsRegistered())
            << num_inliers << ", seed " << seed << ": " << verdict.reason;
        if (summary == &yaw_only && is_right) {
          ++num_right;
          EXPECT_NE(verdict.status, Status::kInsufficient) << "seed " << seed;
        }
      }
    }
  }
  EXPECT_EQ(num_right, 20);  // All problems with two inliers.
}

TEST(Judge, PassesOnWhyThereIsNoAnswer) {
  const Points none(3, 0);
  QuatroSummary summary = SolveQuatro(none, none, {});
  Verdict verdict = Judge(none, none, summary, kNoiseBound, std::nullopt, {});
  EXPECT_EQ(verdict.status, Status::kInsufficient);
  EXPECT_EQ(verdict.reason, summary.message);

  Points pole = Points::Zero(3, 10);
  pole.row(2).setLinSpaced(10, 0.0, 9.0);
  summary = SolveQuatro(pole, pole, {});
  verdict = Judge(pole, pole, summary, kNoiseBound, std::nullopt, {});
  EXPECT_EQ(verdict.status, Status::kDegenerate);
  EXPECT_EQ(verdict.reason, summary.message);
  EXPECT_EQ(verdict.num_matches, 10);
  EXPECT_FALSE(verdict.IsRegistered());
}

TEST(StatusName, IsTheWord) {
  EXPECT_STREQ(StatusName(Status::kRegistered), "registered");
  EXPECT_STREQ(StatusName(Status::kAmbiguous), "ambiguous");
  EXPECT_STREQ(StatusName(Status::kDegenerate), "degenerate");
  EXPECT_STREQ(StatusName(Status::kInsufficient), "insufficient");
}

TEST(VerdictOptions, ErrorNamesTheFieldThatIsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::string error;
  EXPECT_TRUE(VerdictOptions().IsValid(&error)) << error;
  EXPECT_TRUE(error.empty());
  for (const double bad : {-0.1, 1.1, nan}) {
    EXPECT_FALSE(
        (VerdictOptions{.min_probability = bad, .rival = {}}.IsValid(&error)));
    EXPECT_THAT(error, HasSubstr("min_probability"));
  }
  VerdictOptions options;
  options.rival.num_pairs = 0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("num_pairs"));
}

}  // namespace
}  // namespace quatro::verdict_test
