// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/benchmarks/limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "experiments/benchmarks/peak_memory.h"
#include "experiments/simulator/synthetic.h"
#include "features/base/simd.h"

namespace quatro::limits_test {
namespace {

constexpr double kBound = 0.6;

// Nullopt if the pair is too close to the bound for single precision.
std::optional<bool> IsConsistent(const MatchedProblem& problem,
                                 Eigen::Index i,
                                 Eigen::Index j) {
  const double a = (problem.source.col(i) - problem.source.col(j)).norm();
  const double b = (problem.target.col(i) - problem.target.col(j)).norm();
  const double gap = std::abs(a - b) - kBound;
  if (std::abs(gap) < 1e-3) return std::nullopt;
  return gap < 0.0;
}

void ExpectThatOfLengths(const MatchedProblem& problem, SimdLevel level) {
  const Eigen::Index n = problem.source.cols();
  PairTestLimit limit(problem.source, problem.target, kBound);
  limit.Run(level);
  Eigen::Index num_consistent = 0;
  Eigen::Index num_tested = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const auto expected = IsConsistent(problem, i, j);
      if (!expected) continue;
      ++num_tested;
      num_consistent += *expected;
      ASSERT_EQ(limit.IsConsistent(i, j), *expected) << i << ", " << j;
    }
  }
  EXPECT_GE(num_tested, n * (n - 1) / 2 * 9 / 10);
  EXPECT_GT(num_consistent, 0);
  EXPECT_LT(num_consistent, num_tested);
}

TEST(Limits, PairTestIsThatOfLengthsAtEveryLevel) {
  // Sizes within, at and beyond the end of a word; matches far apart, and
  // within a few bounds of each other.
  for (const Eigen::Index n : {20, 31, 32, 33, 64, 175}) {
    for (const double scale : {1.0, 0.02}) {
      MatchedProblem problem = MakeOutlierProblem(n, 0.5, 0.1, 7);
      problem.source *= scale;
      problem.target *= scale;
      for (int level = 0; level <= static_cast<int>(BestSimdLevel()); ++level) {
        SCOPED_TRACE(std::to_string(n) + " matches, scale " +
                     std::to_string(scale) + ", level " +
                     std::to_string(level));
        ExpectThatOfLengths(problem, static_cast<SimdLevel>(level));
      }
    }
  }
}

TEST(Limits, PairTestHoldsBothHalvesOfTheRows) {
  const MatchedProblem problem = MakeOutlierProblem(640, 0.5, 0.1, 7);
  EXPECT_EQ(PairTestLimit(problem.source, problem.target, kBound).num_bytes(),
            640u * 640u / 8u);
}

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
TEST(PeakMemory, IsThatOfTheWorkAlone) {
  const auto use = [](std::size_t megabytes) {
    std::vector<char> bytes(megabytes << 20, 1);
    // Reads the result, so that the compiler keeps it.
    volatile char last = bytes.back();
    (void)last;
  };
  const auto most = MeasurePeakMemory([&] { use(64); });
  if (!most) GTEST_SKIP() << "the kernel does not tell";
  const auto less = MeasurePeakMemory([&] { use(24); });
  EXPECT_NEAR(*most / (1 << 20), 64.0, 2.0);
  EXPECT_NEAR(*less / (1 << 20), 24.0, 2.0);
}
#endif

}  // namespace
}  // namespace quatro::limits_test
