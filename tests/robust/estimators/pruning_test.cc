// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/pruning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/matched_problems.h"

namespace quatro::pruning_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;

constexpr Pruning kMethods[] = {Pruning::kCliqueHeuristic,
                                Pruning::kExactClique,
                                Pruning::kMaxCore,
                                Pruning::kNone};

std::vector<Eigen::Index> Kept(const DistinctMatches& matches,
                               Pruning method,
                               int num_threads = 1) {
  PruningOptions options;
  options.method = method;
  std::vector<StageTime> stage_times;
  auto kept = FindConsistent(matches, options, num_threads, &stage_times);
  EXPECT_EQ(stage_times.size(), method == Pruning::kNone ? 0u : 2u);
  EXPECT_TRUE(std::ranges::is_sorted(kept));
  return kept;
}

// Columns of the input matches.
std::vector<Eigen::Index> KeptOf(const KnownProblem& problem, Pruning method) {
  const auto matches = FindDistinctMatches(problem.source, problem.target);
  return InputColumns(matches, Kept(matches, method));
}

bool AreConsistent(const KnownProblem& problem,
                   const std::vector<Eigen::Index>& columns) {
  for (const Eigen::Index i : columns) {
    for (const Eigen::Index j : columns) {
      const double a = (problem.source.col(i) - problem.source.col(j)).norm();
      const double b = (problem.target.col(i) - problem.target.col(j)).norm();
      if (std::abs(a - b) > 0.6) return false;
    }
  }
  return true;
}

TEST(Pruning, FindsWhatWasPlantedAmongMatchesThatAgreeWithNothing) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const KnownProblem problem = MakeInconsistentProblem(
        {.num_inliers = 12, .num_outliers = 60}, 0.6, seed);
    for (const Pruning method : kMethods) {
      if (method == Pruning::kNone) continue;
      EXPECT_EQ(KeptOf(problem, method), problem.inliers)
          << "method " << static_cast<int>(method) << ", seed " << seed;
    }
  }
}

TEST(Pruning, KeepsThePlantedOnesAmongManyThatAgreeByChance) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const KnownProblem problem =
        MakeMatchedProblem({.num_inliers = 60, .num_outliers = 300}, seed);
    const auto greedy = KeptOf(problem, Pruning::kCliqueHeuristic);
    const auto exact = KeptOf(problem, Pruning::kExactClique);
    const auto core = KeptOf(problem, Pruning::kMaxCore);
    const auto none = KeptOf(problem, Pruning::kNone);
    EXPECT_TRUE(AreConsistent(problem, greedy)) << "seed " << seed;
    EXPECT_TRUE(AreConsistent(problem, exact)) << "seed " << seed;
    EXPECT_THAT(greedy, IsSupersetOf(problem.inliers)) << "seed " << seed;
    EXPECT_THAT(exact, IsSupersetOf(problem.inliers)) << "seed " << seed;
    EXPECT_THAT(core, IsSupersetOf(problem.inliers)) << "seed " << seed;
    EXPECT_GE(exact.size(), greedy.size()) << "seed " << seed;
    EXPECT_LT(exact.size(), 80u) << "seed " << seed;
    EXPECT_EQ(none.size(), 360u);
  }
}

TEST(Pruning, OneMatchIsKeptWhereNoTwoAgreeAndNoneOfNone) {
  const KnownProblem problem = MakeInconsistentProblem(
      {.num_inliers = 1, .num_outliers = 20}, 0.6, /*seed=*/1);
  for (const Pruning method : kMethods) {
    EXPECT_EQ(KeptOf(problem, method).size(),
              method == Pruning::kNone ? 21u : 1u)
        << "method " << static_cast<int>(method);
    const auto none = FindDistinctMatches(Points(3, 0), Points(3, 0));
    EXPECT_THAT(Kept(none, method), IsEmpty())
        << "method " << static_cast<int>(method);
    const auto one = FindDistinctMatches(problem.source.leftCols(1),
                                         problem.target.leftCols(1));
    EXPECT_THAT(Kept(one, method), ElementsAre(0))
        << "method " << static_cast<int>(method);
  }
}

TEST(Pruning, NumberOfThreadsDoesNotMatter) {
  const KnownProblem problem =
      MakeMatchedProblem({.num_inliers = 60, .num_outliers = 300}, 1);
  const auto matches = FindDistinctMatches(problem.source, problem.target);
  for (const Pruning method : kMethods) {
    EXPECT_EQ(Kept(matches, method, 3), Kept(matches, method, 1))
        << "method " << static_cast<int>(method);
  }
}

TEST(PruningOptions, ErrorNamesTheFieldThatIsOutOfRange) {
  std::string error;
  PruningOptions options;
  EXPECT_TRUE(options.IsValid(&error)) << error;
  options.time_limit_seconds = -1.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("time_limit_seconds = -1"));
  options = {};
  options.consistency.bound = -0.5;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("bound = -0.5"));
}

}  // namespace
}  // namespace quatro::pruning_test
