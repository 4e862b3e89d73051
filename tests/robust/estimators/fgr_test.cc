// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/fgr.h"

#include <ceres/ceres.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "robust/verdict/verdict.h"
#include "solvers/ceres/ceres_residuals.h"
#include "tests/support/matched_problems.h"
#include "tests/support/pose_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::fgr_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

FgrSummary Solve(const KnownProblem& problem, const FgrOptions& options = {}) {
  return SolveFgr(problem.source, problem.target, options);
}

Vector6 RandomTwist(double sigma, std::uint64_t seed) {
  return RandomPoints(2, sigma, seed).reshaped();
}

void ExpectSameBits(const FgrSummary& a, const FgrSummary& b) {
  ASSERT_TRUE(a.IsUsable()) << a.message;
  ASSERT_TRUE(b.IsUsable()) << b.message;
  EXPECT_EQ(a.target_from_source->ToMatrix(), b.target_from_source->ToMatrix());
  EXPECT_EQ(a.cost, b.cost);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.num_translation_inliers, b.num_translation_inliers);
}

// Stacked residuals of the moved pose.
Eigen::VectorXd Residuals(const KnownProblem& problem, const Rigid3& pose) {
  return (problem.target - pose.Apply(problem.source)).reshaped();
}

TEST(LinearizeFgr, AgreesWithFiniteDifferences) {
  constexpr double kStep = 1e-5;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const KnownProblem problem = TurnedProblem(20, 20, seed);
    const Rigid3 pose =
        ComposeLeft(RandomTwist(0.1, seed), problem.true_target_from_source);
    const double mu = 4.0;
    const FgrNormalEquations equations =
        LinearizeFgr(problem.source, problem.target, pose, mu, 1);

    // The weights (2) are rho'(r^2), so -2 b must be the gradient of (1).
    Eigen::MatrixXd jacobian(3 * problem.source.cols(), 6);
    for (int k = 0; k < 6; ++k) {
      const Vector6 step = kStep * Vector6::Unit(k);
      const Rigid3 up = ComposeLeft(step, pose);
      const Rigid3 down = ComposeLeft(-step, pose);
      const auto loss = [&](const Rigid3& moved) {
        return LinearizeFgr(problem.source, problem.target, moved, mu, 1).loss;
      };
      const double slope = (loss(up) - loss(down)) / (2.0 * kStep);
      EXPECT_GT(std::abs(slope), 1e-3);
      EXPECT_NEAR(-2.0 * equations.b[k], slope, 1e-5 * std::abs(slope) + 1e-6);
      jacobian.col(k) =
          (Residuals(problem, up) - Residuals(problem, down)) / (2.0 * kStep);
    }

    const Eigen::VectorXd r = Residuals(problem, pose);
    double loss = 0.0;
    Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
    for (Eigen::Index i = 0; i < problem.source.cols(); ++i) {
      const double r2 = r.segment<3>(3 * i).squaredNorm();
      const double line_process = std::pow(mu / (mu + r2), 2);
      A += line_process * jacobian.middleRows<3>(3 * i).transpose() *
           jacobian.middleRows<3>(3 * i);
      loss += mu * r2 / (mu + r2);
    }
    EXPECT_NEAR(equations.loss, loss, 1e-9 * loss);
    EXPECT_LE((equations.A - A).norm(), 1e-6 * A.norm());
  }
}

// Equation (1) at the last mu, for Ceres.
class GemanMcClureLoss final : public ceres::LossFunction {
 public:
  explicit GemanMcClureLoss(double mu) : mu_(mu) {}
  void Evaluate(double r2, double rho[3]) const override {
    const double sum = mu_ + r2;
    rho[0] = mu_ * r2 / sum;
    rho[1] = mu_ * mu_ / (sum * sum);
    rho[2] = -2.0 * mu_ * mu_ / (sum * sum * sum);
  }

 private:
  double mu_;
};

TEST(Fgr, IsWhereCeresStopsWithTheSameLoss) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const KnownProblem problem = TurnedProblem(60, 40, seed);
    const FgrSummary summary = Solve(problem);
    ASSERT_TRUE(summary.IsUsable()) << summary.message;
    EXPECT_TRUE(summary.has_converged);
    EXPECT_NEAR(summary.mu, 0.09, 1e-12);

    // Starts close to the solution.
    const Rigid3 start =
        ComposeLeft(RandomTwist(1e-3, seed), *summary.target_from_source);
    Eigen::Quaterniond rotation(start.rotation);
    Eigen::Vector3d translation = start.translation;
    ceres::Problem::Options ownership;
    ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem twin(ownership);
    GemanMcClureLoss loss(summary.mu);
    for (Eigen::Index i = 0; i < problem.source.cols(); ++i) {
      twin.AddResidualBlock(
          new PairResidual<Turn>::CostFunction(new PairResidual<Turn>{
              problem.source.col(i), problem.target.col(i), 1.0}),
          &loss,
          rotation.coeffs().data(),
          translation.data());
    }
    twin.SetManifold(rotation.coeffs().data(),
                     new ceres::EigenQuaternionManifold);
    ceres::Solver::Options options;
    options.function_tolerance = 0.0;
    options.parameter_tolerance = 1e-14;
    options.gradient_tolerance = 1e-12;
    options.max_num_iterations = 200;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary ceres_summary;
    ceres::Solve(options, &twin, &ceres_summary);
    const Rigid3 expected{rotation.normalized().toRotationMatrix(),
                          translation};
    EXPECT_LE(LargestDisplacement(
                  *summary.target_from_source, expected, problem.source),
              1e-6)
        << "seed " << seed << ": " << ceres_summary.BriefReport();
    EXPECT_NEAR(
        summary.cost, 2.0 * ceres_summary.final_cost, 1e-8 * summary.cost)
        << "seed " << seed;
  }
}

TEST(Fgr, MuFallsByItsStepEveryFourIterations) {
  const KnownProblem problem = TurnedProblem(50, 50, 1);
  const auto largest_radius = [](const Points& points) {
    return (points.colwise() - points.rowwise().mean())
        .colwise()
        .norm()
        .maxCoeff();
  };
  const double extent =
      std::max(largest_radius(problem.source), largest_radius(problem.target));
  FgrOptions options;
  double steps = 0.0;
  for (const int max_iterations : {1, 3, 4, 7, 8, 64}) {
    options.max_iterations = max_iterations;
    const FgrSummary summary = Solve(problem, options);
    steps = max_iterations / 4;
    EXPECT_NEAR(
        summary.mu, extent * extent / std::pow(1.4, steps), 1e-9 * summary.mu)
        << max_iterations;
    EXPECT_EQ(summary.iterations, max_iterations);
    EXPECT_FALSE(summary.has_converged);
  }
  options.max_iterations = 8;
  options.mu_step = 2.0;
  options.start_scale = 3.0;
  options.iterations_per_mu = 2;
  EXPECT_NEAR(Solve(problem, options).mu,
              9.0 * extent * extent / 16.0,
              1e-9 * extent * extent);
}

TEST(Fgr, FindsAnyRotationUpToHalfOutliers) {
  constexpr Eigen::Index kNumMatches = 400;
  for (const Eigen::Index num_inliers : {400, 320, 200}) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const KnownProblem problem =
          TurnedProblem(num_inliers, kNumMatches - num_inliers, seed);
      const FgrSummary summary = Solve(problem);
      ASSERT_TRUE(summary.IsUsable()) << summary.message;
      EXPECT_EQ(summary.num_needed, 3);
      EXPECT_LE(PoseError(summary, problem), 0.1)
          << num_inliers << " inliers, seed " << seed;
      EXPECT_THAT(summary.translation_inliers, IsSupersetOf(problem.inliers));
    }
  }
}

// Without pruning, FGR begins to fail between 50 % and 96 % outliers.
TEST(Fgr, FailsSomewhereBelowFiftyAndNinetySixPercentOutliers) {
  int num_found = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const KnownProblem problem = TurnedProblem(16, 384, seed);
    const FgrSummary summary = Solve(problem);
    num_found += summary.IsUsable() && PoseError(summary, problem) <= 0.3;
    EXPECT_FALSE(
        summary.IsUsable() && PoseError(summary, problem) > 0.3 &&
        Judge(problem.source, problem.target, summary, 0.3, std::nullopt, {})
            .IsRegistered());
  }
  EXPECT_LT(num_found, 10);
}

TEST(Fgr, StartsAtThePlainFitIfAsked) {
  KnownProblem problem = MakeMatchedProblem(
      {.num_inliers = 50, .num_outliers = 0, .yaw = M_PI}, 3);
  FgrOptions options;
  options.max_iterations = 4;
  EXPECT_FALSE(Solve(problem, options).IsUsable() &&
               PoseError(Solve(problem, options), problem) <= 0.1);
  options.start_at_plain_fit = true;
  const FgrSummary summary = Solve(problem, options);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_LE(PoseError(summary, problem), 0.1);
  EXPECT_EQ(summary.message,
            "solved, but max_iterations was reached before convergence");
}

TEST(Fgr, SwappingSourceAndTargetInvertsThePose) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const KnownProblem problem = TurnedProblem(60, 60, seed);
    const FgrSummary forward = Solve(problem);
    const FgrSummary backward = SolveFgr(problem.target, problem.source, {});
    ASSERT_TRUE(forward.IsUsable() && backward.IsUsable());
    EXPECT_LE(LargestDisplacement(Inverse(*backward.target_from_source),
                                  *forward.target_from_source,
                                  problem.source),
              1e-7);
    EXPECT_EQ(backward.translation_inliers, forward.translation_inliers);
  }
}

TEST(Fgr, MovingAndScalingTheCloudsMovesAndScalesThePose) {
  const KnownProblem problem = TurnedProblem(60, 60, 2);
  const FgrSummary base = Solve(problem);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Rigid3 motion{RandomRotation(100 + seed), {-30.0, 12.0, 3.0}};
    const FgrSummary moved =
        SolveFgr(problem.source, motion.Apply(problem.target), {});
    ASSERT_TRUE(moved.IsUsable()) << moved.message;
    EXPECT_LE(LargestDisplacement(*moved.target_from_source,
                                  motion * *base.target_from_source,
                                  problem.source),
              1e-7)
        << "seed " << seed;
  }
  FgrOptions options;
  options.noise_bound *= 10.0;
  const FgrSummary scaled =
      SolveFgr(10.0 * problem.source, 10.0 * problem.target, options);
  ASSERT_TRUE(scaled.IsUsable());
  EXPECT_EQ(scaled.iterations, base.iterations);
  EXPECT_LE((scaled.target_from_source->translation -
             10.0 * base.target_from_source->translation)
                .norm(),
            1e-7);
}

TEST(Fgr, OrderRepetitionAndThreadsDoNotMatterBitForBit) {
  const KnownProblem problem = TurnedProblem(6000, 4000, 2);
  FgrOptions options;
  const FgrSummary expected = Solve(problem, options);
  auto order = RandomPermutation(problem.source.cols(), 1);
  for (std::size_t k = 0; k < 50; ++k) order.push_back(order[3 * k]);
  ExpectSameBits(SolveFgr(Reordered(problem.source, order),
                          Reordered(problem.target, order),
                          options),
                 expected);
  for (const int num_threads : {0, 2, 5}) {
    options.num_threads = num_threads;
    ExpectSameBits(Solve(problem, options), expected);
  }
}

TEST(Fgr, FewerThanThreeMatchesAreNoAnswer) {
  const KnownProblem problem = TurnedProblem(10, 0, 1);
  for (const Eigen::Index n : {0, 1, 2}) {
    const FgrSummary summary =
        SolveFgr(problem.source.leftCols(n), problem.target.leftCols(n), {});
    ExpectNoAnswer(summary, PoseTermination::kInsufficient);
    EXPECT_THAT(summary.message, HasSubstr("there are " + std::to_string(n)));
  }
  EXPECT_TRUE(
      SolveFgr(problem.source.leftCols(3), problem.target.leftCols(3), {})
          .IsUsable());
  ExpectNoAnswer(SolveFgr(problem.source.col(0).replicate(1, 100),
                          problem.target.col(0).replicate(1, 100),
                          {}),
                 PoseTermination::kInsufficient);
}

TEST(Fgr, MatchesOnALineAreDegenerate) {
  for (const double width : {0.0, 0.01}) {
    const KnownProblem problem =
        MakeMatchedProblem({.num_inliers = 50,
                            .num_outliers = 0,
                            .noise = width,
                            .half_widths = {40.0, width, width}},
                           1);
    const FgrSummary summary = Solve(problem);
    ExpectNoAnswer(summary, PoseTermination::kDegenerate);
    EXPECT_THAT(summary.message, HasSubstr("on one line"));
  }
}

TEST(Fgr, MatchesThatDisagreeAreNoAnswer) {
  const KnownProblem problem =
      MakeInconsistentProblem({.num_inliers = 0, .num_outliers = 30}, 0.3, 1);
  const FgrSummary summary = Solve(problem);
  ExpectNoAnswer(summary, PoseTermination::kInsufficient);
  EXPECT_THAT(summary.message, HasSubstr("among 30 matches"));
}

TEST(Fgr, FarFromTheOriginIsAsGood) {
  const Eigen::Vector3d far(1e7, -1e7, 1e5);
  const KnownProblem problem = TurnedProblem(60, 40, 1);
  const FgrSummary near = Solve(problem);
  const Points source = problem.source.colwise() + far;
  const Points target = problem.target.colwise() - far;
  const FgrSummary summary = SolveFgr(source, target, {});
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  const Points expected =
      near.target_from_source->Apply(problem.source).colwise() - far;
  EXPECT_LE((summary.target_from_source->Apply(source) - expected)
                .colwise()
                .norm()
                .maxCoeff(),
            1e-6);
}

TEST(Fgr, PointsThatAreNotFiniteAreRefused) {
  KnownProblem problem = TurnedProblem(10, 10, 1);
  problem.source(1, 2) = kNaN;
  const FgrSummary summary = Solve(problem);
  ExpectNoAnswer(summary, PoseTermination::kInvalidInput);
  EXPECT_THAT(summary.message, HasSubstr("not finite"));
}

TEST(FgrOptions, ErrorNamesTheFieldAndNothingIsTried) {
  std::string none;
  EXPECT_TRUE(FgrOptions().IsValid(&none)) << none;
  const auto expect_error = [](const auto& change, const char* field) {
    FgrOptions options;
    change(&options);
    std::string error;
    EXPECT_FALSE(options.IsValid(&error)) << field;
    EXPECT_THAT(error, HasSubstr(field));
    const FgrSummary summary = Solve(TurnedProblem(10, 0, 1), options);
    ExpectNoAnswer(summary, PoseTermination::kInvalidInput);
    EXPECT_EQ(summary.message, error);
  };
  using Options = FgrOptions*;
  expect_error([](Options o) { o->noise_bound = kNaN; }, "noise_bound = nan");
  expect_error([](Options o) { o->start_scale = 0.0; }, "start_scale = 0");
  expect_error([](Options o) { o->mu_step = 1.0; }, "mu_step = 1");
  expect_error([](Options o) { o->iterations_per_mu = 0; },
               "iterations_per_mu = 0");
  expect_error([](Options o) { o->max_iterations = 0; }, "max_iterations = 0");
  expect_error([](Options o) { o->step_tolerance = 0.0; },
               "step_tolerance = 0");
  expect_error([](Options o) { o->num_threads = -1; }, "num_threads = -1");
}

}  // namespace
}  // namespace quatro::fgr_test
