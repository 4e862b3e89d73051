// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/consensus.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::consensus_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Matches with errors of 0, (0.3, 0.3, 0.3), 0.31 in z and 3 m in x, after a
// rotation by 90 deg and a translation.
class ConsensusTest : public ::testing::Test {
 protected:
  ConsensusTest() {
    source_ << 1.0, 2.0, 3.0, 4.0,  //
        5.0, 6.0, 7.0, 8.0,         //
        9.0, 10.0, 11.0, 12.0;
    target_ << -4.0, -4.7, -6.0, -4.0,  //
        3.0, 4.3, 5.0, 6.0,             //
        12.0, 13.3, 14.31, 15.0;
  }

  Points source_{3, 4};
  Points target_{3, 4};
  const Rigid3 pose_{RotationZ(M_PI / 2), {1.0, 2.0, 3.0}};
};

TEST_F(ConsensusTest, CostByHand) {
  // Relative to 0.6^2 = 0.36 the costs are 0, 3 * 0.3^2, 0.31^2 and truncated.
  EXPECT_NEAR(ConsensusCost(source_, target_, pose_, 0.6),
              (0.27 + 0.31 * 0.31) / 0.36 + 1.0,
              1e-12);
  EXPECT_NEAR(ConsensusCost(source_, target_, pose_, 10.0),
              (0.27 + 0.31 * 0.31 + 9.0) / 100.0,
              1e-12);
}

TEST_F(ConsensusTest, AgreeingByHand) {
  EXPECT_THAT(FindInliers(source_, target_, pose_, 0.299), ElementsAre(0));
  EXPECT_THAT(FindInliers(source_, target_, pose_, 0.301), ElementsAre(0, 1));
  EXPECT_THAT(FindInliers(source_, target_, pose_, 0.311),
              ElementsAre(0, 1, 2));
  EXPECT_THAT(FindInliers(source_, target_, pose_, 3.01),
              ElementsAre(0, 1, 2, 3));
}

TEST_F(ConsensusTest, WithinTheBallByHand) {
  // The errors are 0, 0.3 sqrt(3) = 0.5196, 0.31 and 3.
  EXPECT_THAT(FindWithinBall(source_, target_, pose_, 0.309), ElementsAre(0));
  EXPECT_THAT(FindWithinBall(source_, target_, pose_, 0.311),
              ElementsAre(0, 2));
  EXPECT_THAT(FindWithinBall(source_, target_, pose_, 0.519),
              ElementsAre(0, 2));
  EXPECT_THAT(FindWithinBall(source_, target_, pose_, 0.520),
              ElementsAre(0, 1, 2));
}

TEST_F(ConsensusTest, NoMatchesCostNothingAndNoneAgrees) {
  EXPECT_EQ(ConsensusCost(Points(3, 0), Points(3, 0), pose_, 0.3), 0.0);
  EXPECT_THAT(FindInliers(Points(3, 0), Points(3, 0), pose_, 0.3), IsEmpty());
}

TEST(Consensus, WhoIsWithinTheBallAgreesOnEachAxis) {
  const KnownProblem problem = MakeMatchedProblem({}, /*seed=*/1);
  const auto inliers = FindInliers(
      problem.source, problem.target, problem.true_target_from_source, 0.05);
  EXPECT_EQ(inliers, problem.inliers);
  const double num_others =
      static_cast<double>(problem.source.cols() - problem.inliers.size());
  const double cost = ConsensusCost(
      problem.source, problem.target, problem.true_target_from_source, 0.05);
  EXPECT_GT(cost, num_others);
  EXPECT_LT(cost, static_cast<double>(problem.source.cols()));
}

TEST(Consensus, MovingBothCloudsDoesNotMatter) {
  const KnownProblem problem = MakeMatchedProblem({}, /*seed=*/2);
  const Rigid3 a{RandomRotation(1), {1.0, -2.0, 3.0}};
  const Rigid3 b{RandomRotation(2), {-4.0, 5.0, 6.0}};
  EXPECT_NEAR(
      ConsensusCost(a.Apply(problem.source),
                    b.Apply(problem.target),
                    b * problem.true_target_from_source * Inverse(a),
                    0.1),
      ConsensusCost(
          problem.source, problem.target, problem.true_target_from_source, 0.1),
      1e-9);
}

}  // namespace
}  // namespace quatro::consensus_test
