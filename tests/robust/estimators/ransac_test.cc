// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/ransac.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "robust/estimators/consensus.h"
#include "robust/verdict/verdict.h"
#include "solvers/closed_form/rotation.h"
#include "tests/support/matched_problems.h"
#include "tests/support/pose_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::ransac_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr MinimalSample kSamples[] = {MinimalSample::kThreePoints,
                                      MinimalSample::kTwoPoints,
                                      MinimalSample::kPointAndNormal};

// A problem with horizontal normals at the matched points. Those of inliers are
// rotated by the yaw, with errors of up to 2 deg.
struct ProblemWithNormals : KnownProblem {
  MatchedNormals normals;
};

ProblemWithNormals MakeProblem(const MatchedProblemOptions& options,
                               std::uint64_t seed) {
  ProblemWithNormals problem{MakeMatchedProblem(options, seed), {}};
  Random random(seed + 1000);
  const Eigen::Index n = problem.source.cols();
  problem.normals = {Points::Zero(3, n), Points::Zero(3, n)};
  const auto direction = [](double angle) {
    return Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    const double angle = M_PI * SignedUniform(&random);
    const bool is_inlier =
        std::binary_search(problem.inliers.begin(), problem.inliers.end(), i);
    problem.normals.source.col(i) = direction(angle);
    problem.normals.target.col(i) = direction(
        is_inlier ? angle + options.yaw + 0.035 * SignedUniform(&random)
                  : M_PI * SignedUniform(&random));
  }
  return problem;
}

RansacOptions WithSample(MinimalSample sample) {
  RansacOptions options;
  options.minimal.sample = sample;
  return options;
}

RansacSummary Solve(const ProblemWithNormals& problem,
                    const RansacOptions& options = {}) {
  return SolveRansac(problem.source, problem.target, options, &problem.normals);
}

void ExpectSameBits(const RansacSummary& a, const RansacSummary& b) {
  ASSERT_TRUE(a.IsUsable()) << a.message;
  ASSERT_TRUE(b.IsUsable()) << b.message;
  EXPECT_EQ(a.target_from_source->ToMatrix(), b.target_from_source->ToMatrix());
  EXPECT_EQ(a.cost, b.cost);
  EXPECT_EQ(a.num_translation_inliers, b.num_translation_inliers);
  EXPECT_EQ(a.num_iterations, b.num_iterations);
  EXPECT_EQ(a.num_hypotheses, b.num_hypotheses);
  EXPECT_EQ(a.num_improvements, b.num_improvements);
}

TEST(NumIterationsFor, IsTheFormulaByNumber) {
  // log(0.01) / log(1 - 50 49 48 / (100 99 98)) = 35.6
  EXPECT_EQ(NumIterationsFor(0.99, 50, 100, 3), 36.0);
  // log(0.01) / log(1 - 0.5^3) = 34.5
  EXPECT_EQ(NumIterationsFor(0.99, 5'000'000, 10'000'000, 3), 35.0);
  // log(0.001) / log(1 - 0.1^3) = 6904.3
  EXPECT_EQ(NumIterationsFor(0.999, 1'000'000, 10'000'000, 3), 6905.0);
  // log(0.01) / log(1 - 0.25) = 16.01
  EXPECT_EQ(NumIterationsFor(0.99, 5'000'000, 10'000'000, 2), 17.0);
  // log(0.01) / log(1 - 0.5) = 6.6
  EXPECT_EQ(NumIterationsFor(0.99, 5, 10, 1), 7.0);
  EXPECT_EQ(NumIterationsFor(0.99, 10, 10, 3), 1.0);
  EXPECT_EQ(NumIterationsFor(1.0, 10, 10, 3), 1.0);
  EXPECT_EQ(NumIterationsFor(1.0, 9, 10, 3), kInfinity);
  EXPECT_EQ(NumIterationsFor(0.5, 2, 10, 3), kInfinity);
  EXPECT_EQ(NumIterationsFor(0.5, 0, 10, 1), kInfinity);
}

// The probability of the formula, confirmed by counting: only a sample without
// an outlier finds the pose.
TEST(Ransac, FindsAnOutlierFreeSampleAsOftenAsTheFormulaSays) {
  constexpr int kNumRuns = 400;
  RansacOptions options;
  options.minimal.edge_test = EdgeTest::kNone;
  options.local_optimization = false;
  options.confidence = 1.0;
  for (const MinimalSample sample :
       {MinimalSample::kThreePoints, MinimalSample::kTwoPoints}) {
    options.minimal.sample = sample;
    options.max_iterations = static_cast<std::int64_t>(
        NumIterationsFor(0.8, 20, 100, SampleSize(sample)));
    int num_found = 0;
    for (std::uint64_t seed = 0; seed < kNumRuns; ++seed) {
      const ProblemWithNormals problem = MakeProblem(
          {.num_inliers = 20, .num_outliers = 80, .noise = 1e-4}, seed);
      options.seed = seed;
      num_found += Solve(problem, options).num_translation_inliers >= 20;
    }
    // Three standard deviations.
    EXPECT_NEAR(num_found, 0.8 * kNumRuns, 3.0 * std::sqrt(0.16 * kNumRuns))
        << SampleSize(sample);
  }
}

TEST(Ransac, StopsOnceConfident) {
  const ProblemWithNormals problem =
      MakeProblem({.num_inliers = 300, .num_outliers = 300, .noise = 0.01}, 1);
  std::int64_t before = 0;
  for (const double confidence : {0.99, 0.9999, 0.999999}) {
    RansacOptions options;
    options.confidence = confidence;
    const RansacSummary summary = Solve(problem, options);
    EXPECT_TRUE(summary.is_confident);
    EXPECT_GT(summary.num_iterations, before);
    before = summary.num_iterations;
    EXPECT_EQ(static_cast<double>(summary.num_iterations),
              NumIterationsFor(confidence,
                               summary.num_translation_inliers,
                               summary.num_matches,
                               3))
        << confidence;
  }
  RansacOptions never;
  never.confidence = 1.0;
  never.max_iterations = 777;
  const RansacSummary summary = Solve(problem, never);
  EXPECT_FALSE(summary.is_confident);
  EXPECT_EQ(summary.num_iterations, 777);
}

TEST(Ransac, FindsThePoseAmongOutliers) {
  struct Case {
    MinimalSample sample;
    std::vector<Eigen::Index> num_inliers;  // Out of 600.
  };
  const Case cases[] = {
      {MinimalSample::kThreePoints, {600, 300, 120, 60}},
      {MinimalSample::kTwoPoints, {600, 300, 60, 30, 18}},
      {MinimalSample::kPointAndNormal, {600, 300, 60, 30, 12}},
  };
  for (const auto& [sample, num_inliers] : cases) {
    for (const Eigen::Index n : num_inliers) {
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const ProblemWithNormals problem =
            MakeProblem({.num_inliers = n, .num_outliers = 600 - n}, seed);
        const RansacSummary summary = Solve(problem, WithSample(sample));
        ASSERT_TRUE(summary.IsUsable()) << summary.message;
        EXPECT_LE(PoseError(summary, problem), 0.3)
            << SampleSize(sample) << " points, " << n << " inliers, seed "
            << seed;
        EXPECT_THAT(summary.translation_inliers, IsSupersetOf(problem.inliers));
        EXPECT_EQ(summary.num_needed, SampleSize(sample));
      }
    }
  }
}

TEST(Ransac, SaysWhetherRollAndPitchWereEstimated) {
  const ProblemWithNormals problem = MakeProblem({}, 1);
  for (const MinimalSample sample : kSamples) {
    const RansacSummary summary = Solve(problem, WithSample(sample));
    ASSERT_TRUE(summary.IsUsable()) << summary.message;
    EXPECT_EQ(summary.model,
              sample == MinimalSample::kThreePoints
                  ? PoseModel::kRigid
                  : PoseModel::kYawTranslation);
  }
}

TEST(Ransac, ThreePointsFindAnyRotation) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    ProblemWithNormals problem =
        MakeProblem({.num_inliers = 60,
                     .num_outliers = 140,
                     .half_widths = Eigen::Vector3d::Constant(30.0)},
                    seed);
    const Rigid3 turn{RandomRotation(seed), {1.0, 2.0, 3.0}};
    problem.true_target_from_source = turn * problem.true_target_from_source;
    problem.target = turn.Apply(problem.target);
    const RansacSummary summary = Solve(problem);
    ASSERT_TRUE(summary.IsUsable()) << summary.message;
    EXPECT_LE(PoseError(summary, problem), 0.1) << "seed " << seed;
  }
}

// None of the 220 triples gives a pose of lower cost than the result.
TEST(Ransac, IsNoWorseThanEverySampleThereIs) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const ProblemWithNormals problem =
        MakeProblem({.num_inliers = 5, .num_outliers = 7, .noise = 0.15}, seed);
    RansacOptions options;
    options.minimal.edge_test = EdgeTest::kNone;
    options.confidence = 1.0;
    options.max_iterations = 5000;
    options.local_optimization = seed % 2 == 0;
    const RansacSummary summary = Solve(problem, options);
    ASSERT_TRUE(summary.IsUsable()) << summary.message;
    double least = kInfinity;
    for (Eigen::Index i = 0; i < 12; ++i) {
      for (Eigen::Index j = 0; j < i; ++j) {
        for (Eigen::Index k = 0; k < j; ++k) {
          const auto pose = EstimateMinimalPose(problem.source,
                                                problem.target,
                                                nullptr,
                                                {i, j, k},
                                                options.minimal);
          if (!pose) continue;
          least = std::min(
              least, ConsensusCost(problem.source, problem.target, *pose, 0.3));
        }
      }
    }
    ASSERT_LT(least, kInfinity) << "seed " << seed;
    EXPECT_LE(summary.cost, least + 1e-9) << "seed " << seed;
    EXPECT_NEAR(
        summary.cost,
        ConsensusCost(
            problem.source, problem.target, *summary.target_from_source, 0.3),
        1e-9);
  }
}

// The yaw of a single sample has an error of a degree or two. Few matches of a
// large scene are within the bound of its pose, and least squares on these is
// not enough.
TEST(Ransac, LocalOptimizationLowersTheCost) {
  RansacOptions options = WithSample(MinimalSample::kPointAndNormal);
  options.confidence = 1.0;
  options.max_iterations = 1;
  int num_lower = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const ProblemWithNormals problem =
        MakeProblem({.num_inliers = 100,
                     .num_outliers = 10,
                     .noise = 0.17,
                     .half_widths = {100.0, 100.0, 4.0}},
                    seed);
    options.seed = seed;
    options.local_optimization = false;
    const double without = Solve(problem, options).cost;
    options.local_optimization = true;
    const double with = Solve(problem, options).cost;
    EXPECT_LE(with, without + 1e-9) << "seed " << seed;
    num_lower += with < 0.9 * without;
  }
  EXPECT_GE(num_lower, 3);
}

TEST(Ransac, AnswerIsAFixedPointOfItsInliers) {
  const ProblemWithNormals problem =
      MakeProblem({.num_inliers = 100, .num_outliers = 100}, 4);
  for (const bool optimizes : {false, true}) {
    RansacOptions options;
    options.local_optimization = optimizes;
    const RansacSummary summary = Solve(problem, options);
    ASSERT_TRUE(summary.IsUsable());
    const auto& inliers = summary.translation_inliers;
    const Points p = problem.source(Eigen::all, inliers);
    const Points q = problem.target(Eigen::all, inliers);
    const auto refit = EstimateRigid(p, q, Weights::Ones(p.cols()));
    EXPECT_LE(LargestDisplacement(
                  refit->target_from_source, *summary.target_from_source, p),
              1e-9);
  }
}

TEST(Ransac, SwappingSourceAndTargetInvertsThePose) {
  for (const MinimalSample sample : kSamples) {
    const ProblemWithNormals problem =
        MakeProblem({.num_inliers = 100, .num_outliers = 200}, 1);
    const RansacSummary forward = Solve(problem, WithSample(sample));
    const MatchedNormals swapped{problem.normals.target,
                                 problem.normals.source};
    const RansacSummary backward = SolveRansac(
        problem.target, problem.source, WithSample(sample), &swapped);
    ASSERT_TRUE(forward.IsUsable() && backward.IsUsable());
    EXPECT_EQ(backward.translation_inliers, forward.translation_inliers);
    EXPECT_LE(LargestDisplacement(Inverse(*backward.target_from_source),
                                  *forward.target_from_source,
                                  problem.source),
              1e-9)
        << SampleSize(sample);
  }
}

// The samples differ, since the order depends on the coordinates; the result
// does not.
TEST(Ransac, MovingTheTargetMovesThePose) {
  const ProblemWithNormals problem =
      MakeProblem({.num_inliers = 100, .num_outliers = 200}, 3);
  for (const MinimalSample sample : kSamples) {
    const RansacSummary base = Solve(problem, WithSample(sample));
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const Rigid3 motion{sample == MinimalSample::kThreePoints
                              ? RandomRotation(seed)
                              : RotationZ(static_cast<double>(seed)),
                          {-30.0, 12.0, 3.0}};
      const MatchedNormals turned{problem.normals.source,
                                  motion.rotation * problem.normals.target};
      const RansacSummary moved = SolveRansac(problem.source,
                                              motion.Apply(problem.target),
                                              WithSample(sample),
                                              &turned);
      ASSERT_TRUE(moved.IsUsable()) << moved.message;
      EXPECT_LE(LargestDisplacement(*moved.target_from_source,
                                    motion * *base.target_from_source,
                                    problem.source),
                0.02)
          << SampleSize(sample) << ", seed " << seed;
    }
  }
}

TEST(Ransac, OrderRepetitionAndThreadsDoNotMatterBitForBit) {
  const ProblemWithNormals problem =
      MakeProblem({.num_inliers = 60, .num_outliers = 240}, 2);
  for (const MinimalSample sample : kSamples) {
    RansacOptions options = WithSample(sample);
    const RansacSummary expected = Solve(problem, options);
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      auto order = RandomPermutation(problem.source.cols(), seed);
      for (std::size_t k = 0; k < 50; ++k) order.push_back(order[3 * k]);
      const MatchedNormals normals{Reordered(problem.normals.source, order),
                                   Reordered(problem.normals.target, order)};
      RansacSummary reordered = SolveRansac(Reordered(problem.source, order),
                                            Reordered(problem.target, order),
                                            options,
                                            &normals);
      ExpectSameBits(reordered, expected);
    }
    for (const int num_threads : {0, 2, 5}) {
      options.num_threads = num_threads;
      ExpectSameBits(Solve(problem, options), expected);
    }
  }
}

TEST(Ransac, CopiesWithOtherNormalsAreOneMatchInAnyOrder) {
  ProblemWithNormals problem =
      MakeProblem({.num_inliers = 4, .num_outliers = 4}, 2);
  std::vector<Eigen::Index> order = {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3};
  MatchedNormals normals{Reordered(problem.normals.source, order),
                         Reordered(problem.normals.target, order)};
  for (Eigen::Index k = 8; k < 12; ++k) {
    normals.target.col(k) = Eigen::Vector3d::UnitX();
  }
  const RansacOptions options = WithSample(MinimalSample::kPointAndNormal);
  const Points source = Reordered(problem.source, order);
  const Points target = Reordered(problem.target, order);
  const RansacSummary expected = SolveRansac(source, target, options, &normals);
  EXPECT_EQ(expected.num_matches, 8);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto shuffled = RandomPermutation(12, seed);
    const MatchedNormals shuffled_normals{Reordered(normals.source, shuffled),
                                          Reordered(normals.target, shuffled)};
    ExpectSameBits(SolveRansac(Reordered(source, shuffled),
                               Reordered(target, shuffled),
                               options,
                               &shuffled_normals),
                   expected);
  }
  // A single match has the heading of its normals.
  const auto solve_copies = [&](const std::vector<Eigen::Index>& copies) {
    const MatchedNormals of_copies{Reordered(normals.source, copies),
                                   Reordered(normals.target, copies)};
    return SolveRansac(Reordered(source, copies),
                       Reordered(target, copies),
                       options,
                       &of_copies);
  };
  ExpectSameBits(solve_copies({0, 8}), solve_copies({8, 0}));
  EXPECT_NE(solve_copies({0}).target_from_source->rotation,
            solve_copies({8}).target_from_source->rotation);
}

TEST(Ransac, SeedDecidesTheSamples) {
  const ProblemWithNormals problem =
      MakeProblem({.num_inliers = 60, .num_outliers = 540}, 6);
  RansacOptions options;
  options.confidence = 1.0;
  const RansacSummary first = Solve(problem, options);
  options.seed = 1;
  const RansacSummary second = Solve(problem, options);
  EXPECT_NE(first.num_hypotheses, second.num_hypotheses);
}

TEST(Ransac, FewerMatchesThanNeededAreNoAnswer) {
  const ProblemWithNormals problem =
      MakeProblem({.num_inliers = 10, .num_outliers = 0}, 1);
  for (const MinimalSample sample : kSamples) {
    const int num_needed = SampleSize(sample);
    for (Eigen::Index n = 0; n <= num_needed; ++n) {
      const MatchedNormals normals{problem.normals.source.leftCols(n),
                                   problem.normals.target.leftCols(n)};
      const RansacSummary summary = SolveRansac(problem.source.leftCols(n),
                                                problem.target.leftCols(n),
                                                WithSample(sample),
                                                &normals);
      EXPECT_EQ(summary.num_needed, num_needed);
      if (n == num_needed) {
        EXPECT_TRUE(summary.IsUsable()) << summary.message;
      } else {
        ExpectNoAnswer(summary, PoseTermination::kInsufficient);
        EXPECT_THAT(summary.message,
                    HasSubstr("needs at least " + std::to_string(num_needed)));
      }
    }
    // One match, repeated a hundred times.
    if (num_needed == 1) continue;
    ExpectNoAnswer(SolveRansac(problem.source.col(0).replicate(1, 100),
                               problem.target.col(0).replicate(1, 100),
                               WithSample(sample)),
                   PoseTermination::kInsufficient);
  }
}

TEST(Ransac, MatchesOnALineAreDegenerate) {
  for (const double width : {0.0, 0.01}) {
    ProblemWithNormals problem =
        MakeProblem({.num_inliers = 50,
                     .num_outliers = 0,
                     .noise = width,
                     .half_widths = {40.0, width, width}},
                    1);
    const RansacSummary on_line = Solve(problem);
    ExpectNoAnswer(on_line, PoseTermination::kDegenerate);
    EXPECT_THAT(on_line.message, HasSubstr("on one line"));
    EXPECT_TRUE(
        Solve(problem, WithSample(MinimalSample::kTwoPoints)).IsUsable());

    problem = MakeProblem({.num_inliers = 50,
                           .num_outliers = 0,
                           .noise = width,
                           .half_widths = {width, width, 40.0}},
                          1);
    const RansacSummary on_vertical =
        Solve(problem, WithSample(MinimalSample::kTwoPoints));
    ExpectNoAnswer(on_vertical, PoseTermination::kDegenerate);
    EXPECT_THAT(on_vertical.message, HasSubstr("on a vertical"));
    EXPECT_TRUE(
        Solve(problem, WithSample(MinimalSample::kPointAndNormal)).IsUsable());
  }
}

TEST(Ransac, MatchesThatDisagreeAreNoAnswer) {
  const KnownProblem problem =
      MakeInconsistentProblem({.num_inliers = 0, .num_outliers = 30}, 0.3, 1);
  RansacOptions options;
  options.minimal.edge_test = EdgeTest::kBound;
  const RansacSummary summary =
      SolveRansac(problem.source, problem.target, options);
  ExpectNoAnswer(summary, PoseTermination::kInsufficient);
  EXPECT_EQ(summary.num_iterations, options.max_iterations);
  EXPECT_THAT(summary.message, HasSubstr("10000 samples"));
}

TEST(Ransac, WhatIsFoundAmongRandomMatchesIsNotVouchedFor) {
  for (const MinimalSample sample : kSamples) {
    const ProblemWithNormals problem =
        MakeProblem({.num_inliers = 0, .num_outliers = 300}, 5);
    const RansacSummary summary = Solve(problem, WithSample(sample));
    EXPECT_FALSE(
        Judge(problem.source, problem.target, summary, 0.3, std::nullopt, {})
            .IsRegistered());
  }
}

TEST(Ransac, FarFromTheOriginIsAsGood) {
  const Eigen::Vector3d far(1e7, -1e7, 1e5);
  for (const MinimalSample sample : kSamples) {
    const ProblemWithNormals problem =
        MakeProblem({.num_inliers = 100, .num_outliers = 200}, 1);
    const Points source = problem.source.colwise() + far;
    const Points target = problem.target.colwise() - far;
    const RansacSummary summary =
        SolveRansac(source, target, WithSample(sample), &problem.normals);
    ASSERT_TRUE(summary.IsUsable()) << summary.message;
    const Points there =
        problem.true_target_from_source.Apply(problem.source).colwise() - far;
    EXPECT_LE((summary.target_from_source->Apply(source) - there)
                  .colwise()
                  .norm()
                  .maxCoeff(),
              0.1)
        << SampleSize(sample);
    EXPECT_THAT(summary.translation_inliers, IsSupersetOf(problem.inliers));
  }
}

TEST(Ransac, BadInputIsRefused) {
  ProblemWithNormals problem =
      MakeProblem({.num_inliers = 10, .num_outliers = 10}, 1);
  const auto options = WithSample(MinimalSample::kPointAndNormal);
  const RansacSummary without =
      SolveRansac(problem.source, problem.target, options);
  ExpectNoAnswer(without, PoseTermination::kInvalidInput);
  EXPECT_THAT(without.message, HasSubstr("need normals"));
  MatchedNormals few = problem.normals;
  few.target.conservativeResize(3, 7);
  const RansacSummary with_few =
      SolveRansac(problem.source, problem.target, options, &few);
  ExpectNoAnswer(with_few, PoseTermination::kInvalidInput);
  EXPECT_THAT(with_few.message,
              HasSubstr("matches; equal numbers are required"));
  problem.normals.source(0, 0) = kNaN;
  EXPECT_THAT(Solve(problem, options).message, HasSubstr("normal is not"));
  EXPECT_TRUE(Solve(problem).IsUsable());  // The normals are ignored.
  problem.target(2, 3) = kNaN;
  const RansacSummary summary = Solve(problem);
  ExpectNoAnswer(summary, PoseTermination::kInvalidInput);
  EXPECT_THAT(summary.message, HasSubstr("not finite"));
}

TEST(RansacOptions, ErrorNamesTheFieldAndNothingIsTried) {
  std::string none;
  EXPECT_TRUE(RansacOptions().IsValid(&none)) << none;
  const auto expect_error = [](const auto& change, const char* field) {
    RansacOptions options;
    change(&options);
    std::string error;
    EXPECT_FALSE(options.IsValid(&error)) << field;
    EXPECT_THAT(error, HasSubstr(field));
    const RansacSummary summary =
        Solve(MakeProblem({.num_inliers = 10, .num_outliers = 0}, 1), options);
    ExpectNoAnswer(summary, PoseTermination::kInvalidInput);
    EXPECT_EQ(summary.message, error);
    EXPECT_EQ(summary.num_iterations, 0);
  };
  using Options = RansacOptions*;
  expect_error([](Options o) { o->minimal.noise_bound = -1.0; },
               "noise_bound = -1");
  expect_error([](Options o) { o->max_iterations = 0; }, "max_iterations = 0");
  expect_error([](Options o) { o->confidence = 0.0; }, "confidence = 0");
  expect_error([](Options o) { o->confidence = kNaN; }, "confidence = nan");
  expect_error([](Options o) { o->num_threads = -1; }, "num_threads = -1");
}

}  // namespace
}  // namespace quatro::ransac_test
