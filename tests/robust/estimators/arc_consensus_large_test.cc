// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "experiments/simulator/synthetic.h"
#include "robust/estimators/arc_consensus.h"

namespace quatro::arc_consensus_large_test {
namespace {

// Peak memory of this process [kB], or 0 if the system does not report it.
long PeakMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != "VmHWM:") continue;
    long kilobytes = 0;
    status >> kilobytes;
    return kilobytes;
  }
  return 0;
}

TEST(LargeArcConsensus, AMillionMatchesOfWhich99PercentAreWrong) {
  const MatchedProblem problem =
      MakeOutlierProblem(1'000'000, 0.99, 0.1, /*seed=*/0);
  const PoseSummary summary =
      SolveArcConsensus(problem.source, problem.target, {});
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_LE(AngleBetween(summary.target_from_source->rotation,
                         problem.true_target_from_source.rotation),
            M_PI / 180.0);
  EXPECT_LE((summary.target_from_source->translation -
             problem.true_target_from_source.translation)
                .norm(),
            0.3);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LT(PeakMemory(), 2L * 1024 * 1024);
#endif
}

}  // namespace
}  // namespace quatro::arc_consensus_large_test
