// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/summary_covariance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <vector>

#include "robust/estimators/arc_consensus.h"
#include "robust/estimators/quatro.h"
#include "robust/estimators/ransac.h"
#include "robust/estimators/teaser.h"
#include "robust/registration/ins.h"
#include "tests/support/ins_solutions.h"
#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::summary_covariance_test {
namespace {

constexpr double kNoiseBound = 0.3;  // [m]

PoseSummary WithCovariance(const KnownProblem& problem, PoseSummary summary) {
  AddCovariance(problem.source, problem.target, kNoiseBound, {}, {}, &summary);
  return summary;
}

// The block of the rotation or of the translation, about the center of the
// inliers.
double Spread(const PoseSummary& summary, Freedom freedom) {
  const int place = freedom == Freedom::kRotation ? 0 : 3;
  return summary.covariance->covariance_at_center->diagonal()
      .segment(place, 3)
      .sum();
}

class AddCovarianceTest : public ::testing::Test {
 protected:
  static KnownProblem MakeProblem(std::uint64_t seed) {
    MatchedProblemOptions options;
    options.noise = 0.1;
    return MakeMatchedProblem(options, seed);
  }

  static QuatroOptions YawOnly() {
    QuatroOptions options;
    options.noise_bound = kNoiseBound;
    options.polish = false;
    return options;
  }

  const KnownProblem problem_ = MakeProblem(1);
};

TEST_F(AddCovarianceTest, EveryEstimatorHasOneAndSaysWhatItEstimated) {
  const auto& [source, target, truth, inliers] = problem_;
  QuatroOptions polished = YawOnly();
  polished.polish = true;
  TeaserOptions teaser;
  teaser.noise_bound = kNoiseBound;
  ArcConsensusOptions arc;
  arc.noise_bound = kNoiseBound;
  RansacOptions three_points;
  three_points.minimal.noise_bound = kNoiseBound;
  RansacOptions two_points = three_points;
  two_points.minimal.sample = MinimalSample::kTwoPoints;
  const struct {
    const char* name;
    PoseSummary summary;
    PoseModel model;
    int rank;
  } cases[] = {
      {"quatro",
       SolveQuatro(source, target, YawOnly()),
       PoseModel::kYawTranslation,
       4},
      {"polished", SolveQuatro(source, target, polished), PoseModel::kRigid, 6},
      {"arc_consensus",
       SolveArcConsensus(source, target, arc),
       PoseModel::kYawTranslation,
       4},
      {"teaser", SolveTeaser(source, target, teaser), PoseModel::kRigid, 6},
      {"ransac, three points",
       SolveRansac(source, target, three_points),
       PoseModel::kRigid,
       6},
      {"ransac, two points",
       SolveRansac(source, target, two_points),
       PoseModel::kYawTranslation,
       4}};
  for (const auto& [name, summary, model, rank] : cases) {
    EXPECT_EQ(summary.model, model) << name;
    const auto given = WithCovariance(problem_, summary);
    ASSERT_TRUE(given.covariance.has_value()) << name;
    ASSERT_TRUE(given.covariance->covariance.has_value())
        << name << ": " << given.covariance->message;
    EXPECT_EQ(given.covariance->rank, rank) << name;
    EXPECT_EQ(given.covariance->sigma, kNoiseBound / 3.0);
    EXPECT_EQ(given.stage_times.back().stage, "covariance");
    // No direction is certain, and none is missing.
    const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(
        *given.covariance->covariance_at_center);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), 1e-9) << name;
    EXPECT_LT(eigen.eigenvalues().maxCoeff(), 0.1) << name;
  }
}

TEST_F(AddCovarianceTest, CopiesOfAMatchCountOnceBitForBit) {
  const Eigen::Index n = problem_.source.cols();
  KnownProblem copies = problem_;
  std::vector<Eigen::Index> order = RandomPermutation(n, 2);
  const std::vector<Eigen::Index> again = RandomPermutation(n, 3);
  order.insert(order.end(), again.begin(), again.end());
  copies.source = Reordered(problem_.source, order);
  copies.target = Reordered(problem_.target, order);
  const auto once = WithCovariance(
      problem_, SolveQuatro(problem_.source, problem_.target, YawOnly()));
  const auto twice = WithCovariance(
      copies, SolveQuatro(copies.source, copies.target, YawOnly()));
  ASSERT_TRUE(once.covariance->covariance.has_value());
  EXPECT_EQ(*twice.covariance->covariance, *once.covariance->covariance);
}

TEST_F(AddCovarianceTest, UsesTheInliersAlone) {
  PoseSummary summary =
      SolveQuatro(problem_.source, problem_.target, YawOnly());
  const auto all = WithCovariance(problem_, summary);
  summary.translation_inliers.resize(summary.translation_inliers.size() / 2);
  const auto half = WithCovariance(problem_, summary);
  EXPECT_NEAR(
      Spread(half, Freedom::kTranslation) / Spread(all, Freedom::kTranslation),
      2.0,
      0.2);
  summary.translation_inliers.clear();
  const auto none = WithCovariance(problem_, summary);
  EXPECT_FALSE(none.covariance->covariance.has_value());
  EXPECT_EQ(none.covariance->rank, 0);
}

TEST_F(AddCovarianceTest, WithoutAPoseThereIsNone) {
  EXPECT_FALSE(WithCovariance(problem_, PoseSummary()).covariance.has_value());
}

// An INS gives the vertical and its standard deviation.
TEST_F(AddCovarianceTest, AssumedTiltIsTheInsOwn) {
  KnownProblem problem = problem_;
  const Attitude attitude{0.1, -0.2, 0.0};
  const Eigen::Matrix3d R = WorldFromBody(attitude);
  problem.target = R.transpose() * problem.target;
  InsOptions ins;
  ins.mode = InsMode::kLeveled;
  ins.target_attitude = attitude;
  ins.attitude_std = 0.004;
  const auto leveled = WithCovariance(
      problem,
      SolveQuatroWithIns(problem.source, problem.target, YawOnly(), ins));
  ASSERT_TRUE(leveled.covariance.has_value()) << leveled.message;
  ASSERT_TRUE(leveled.covariance->covariance.has_value());
  int num_assumed = 0;
  for (const UnobservableDirection& direction :
       leveled.covariance->unobservable) {
    if (direction.reason != UnobservableReason::kAssumed) continue;
    ++num_assumed;
    EXPECT_NEAR(direction.axis.dot(R.transpose().col(2)), 0.0, 1e-9);
    EXPECT_NEAR(*direction.standard_deviation, std::sqrt(2.0) * 0.004, 1e-12);
  }
  EXPECT_EQ(num_assumed, 2);

  ins.mode = InsMode::kFused;
  const auto fused = WithCovariance(
      problem,
      SolveQuatroWithIns(problem.source, problem.target, YawOnly(), ins));
  ASSERT_THAT(fused.message, ::testing::HasSubstr("; fused with the INS"));
  EXPECT_EQ(fused.model, PoseModel::kRigid);
  ASSERT_TRUE(fused.covariance->covariance.has_value());
  EXPECT_LT(fused.covariance->offset, 1e-2);
  PoseSummary unfused = fused;
  unfused.vertical.reset();
  unfused = WithCovariance(problem, unfused);
  EXPECT_LT(Spread(fused, Freedom::kRotation),
            0.999 * Spread(unfused, Freedom::kRotation));
}

TEST_F(AddCovarianceTest, ScaleIsAppliedToTheSource) {
  PoseSummary summary =
      SolveQuatro(problem_.source, problem_.target, YawOnly());
  const auto plain = WithCovariance(problem_, summary);
  KnownProblem half = problem_;
  half.source *= 0.5;
  summary.scale = 2.0;
  const auto scaled = WithCovariance(half, summary);
  EXPECT_LT(
      (*scaled.covariance->covariance - *plain.covariance->covariance).norm(),
      1e-9 * plain.covariance->covariance->norm());
}

}  // namespace
}  // namespace quatro::summary_covariance_test
