// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/synthetic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "experiments/protocols/synthetic_protocols.h"

namespace quatro::synthetic_test {
namespace {

using ::testing::ElementsAre;

Points Errors(const MatchedProblem& problem) {
  return problem.target - problem.true_target_from_source.Apply(problem.source);
}

std::vector<Eigen::Index> TrueOnes(const MatchedProblem& problem,
                                   double bound) {
  const Points errors = Errors(problem);
  std::vector<Eigen::Index> columns;
  for (Eigen::Index i = 0; i < errors.cols(); ++i) {
    if (errors.col(i).cwiseAbs().maxCoeff() <= bound) columns.push_back(i);
  }
  return columns;
}

void ExpectMotionOnTheGround(const Rigid3& motion) {
  EXPECT_EQ(motion.rotation, RotationZ(Yaw(motion.rotation)));
  EXPECT_LE(motion.translation.head<2>().cwiseAbs().maxCoeff(), 20.0);
  EXPECT_LE(std::abs(motion.translation.z()), 1.0);
}

TEST(OutlierProblem, TheTrueOnesComeLast) {
  for (const double ratio : {0.0, 0.5, 0.95, 1.0}) {
    const MatchedProblem problem = MakeOutlierProblem(200, ratio, 0.01, 1);
    ExpectMotionOnTheGround(problem.true_target_from_source);
    EXPECT_EQ(problem.source.cols(), 200);
    const auto true_ones = TrueOnes(problem, 0.06);
    const auto num_outliers =
        static_cast<Eigen::Index>(std::llround(200 * ratio));
    EXPECT_EQ(static_cast<Eigen::Index>(true_ones.size()), 200 - num_outliers);
    if (!true_ones.empty()) {
      EXPECT_EQ(true_ones.front(), num_outliers);
    }
    EXPECT_LE(problem.source.topRows<2>().cwiseAbs().maxCoeff(), 50.0);
    EXPECT_LE(problem.source.row(2).cwiseAbs().maxCoeff(), 4.0);
  }
}

TEST(OutlierProblem, NoiseIsNormalOnEachAxis) {
  const MatchedProblem problem = MakeOutlierProblem(20000, 0.0, 0.1, 1);
  const Points errors = Errors(problem);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(errors.row(axis).mean(), 0.0, 0.003) << "axis " << axis;
    EXPECT_NEAR(errors.row(axis).array().square().mean(), 0.01, 0.0005);
    // Within one standard deviation.
    EXPECT_NEAR(
        static_cast<double>((errors.row(axis).array().abs() <= 0.1).count()) /
            20000.0,
        0.6827,
        0.015);
  }
}

TEST(SyntheticProblems, AreFunctionsOfTheSeed) {
  const auto make = [](std::uint64_t seed) {
    return std::vector<MatchedProblem>{
        MakeOutlierProblem(50, 0.5, 0.1, seed),
        MakeDegenerateProblem(50, 3, 0.1, 0.6, seed),
        MakeQuasiInlierProblem(50, 10, 20, 0.1, seed),
        MakeTimProblem(50, 0.5, 0.1, seed)};
  };
  const auto first = make(1);
  const auto again = make(1);
  const auto other = make(2);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].source, again[i].source) << "problem " << i;
    EXPECT_EQ(first[i].target, again[i].target) << "problem " << i;
    EXPECT_NE(first[i].source, other[i].source) << "problem " << i;
  }
}

TEST(DegenerateProblem, NoOutlierIsConsistentWithAnything) {
  for (const Eigen::Index num_true : {1, 2, 3, 5}) {
    const MatchedProblem problem =
        MakeDegenerateProblem(50, num_true, 0.05, 0.6, 1);
    ExpectMotionOnTheGround(problem.true_target_from_source);
    ASSERT_EQ(problem.source.cols(), 50);
    EXPECT_EQ(static_cast<Eigen::Index>(TrueOnes(problem, 0.25).size()),
              num_true);
    for (Eigen::Index i = 0; i < 50; ++i) {
      for (Eigen::Index j = 0; j < i; ++j) {
        const double a = (problem.source.col(i) - problem.source.col(j)).norm();
        const double b = (problem.target.col(i) - problem.target.col(j)).norm();
        EXPECT_EQ(std::abs(a - b) <= 0.6, i < num_true) << i << ", " << j;
      }
    }
  }
}

TEST(QuasiInlierProblem, AreRightInThePlaneAndWrongInHeight) {
  const MatchedProblem problem = MakeQuasiInlierProblem(500, 20, 180, 0.01, 1);
  ExpectMotionOnTheGround(problem.true_target_from_source);
  const Points errors = Errors(problem);
  int num_up = 0;
  for (Eigen::Index i = 0; i < 200; ++i) {
    EXPECT_LE(errors.col(i).head<2>().cwiseAbs().maxCoeff(), 0.06) << i;
    const double off = std::abs(errors(2, i));
    if (i < 20) {
      EXPECT_LE(off, 0.06) << i;
      continue;
    }
    EXPECT_GE(off, 0.44) << i;
    EXPECT_LE(off, 3.06) << i;
    num_up += errors(2, i) > 0.0;
  }
  EXPECT_GT(num_up, 60);
  EXPECT_LT(num_up, 120);
  EXPECT_EQ(TrueOnes(problem, 0.06).size(), 20u);
  int num_in_the_plane = 0;
  for (Eigen::Index i = 200; i < 500; ++i) {
    num_in_the_plane += errors.col(i).head<2>().norm() < 0.1;
  }
  EXPECT_EQ(num_in_the_plane, 0);
}

TEST(TimProblem, LengthsAgreeAndOutliersAreTurned) {
  const MatchedProblem problem = MakeTimProblem(1000, 0.9, 0.01, 1);
  EXPECT_EQ(problem.true_target_from_source.translation,
            Eigen::Vector3d::Zero());
  const Eigen::RowVectorXd difference =
      problem.source.topRows<2>().colwise().norm() -
      problem.target.topRows<2>().colwise().norm();
  EXPECT_LE(difference.cwiseAbs().maxCoeff(), 0.1);
  const auto num_true = TrueOnes(problem, 0.06).size();
  EXPECT_GE(num_true, 100u);
  EXPECT_LE(num_true, 110u);  // Some rotations are tiny.
}

TEST(SlopeProblem, IsTiltedAndTheInsKnowsIt) {
  for (const double tilt : {0.0, 0.1, 0.25}) {
    const SlopeProblem problem = MakeSlopeProblem(200, 0.5, 0.01, tilt, 0.0, 1);
    const Eigen::Matrix3d rotation =
        problem.matches.true_target_from_source.rotation;
    EXPECT_NEAR(std::acos(std::min(1.0, rotation(2, 2))), tilt, 1e-7);
    EXPECT_LE((WorldFromBody(problem.target_attitude).transpose() *
                   WorldFromBody(problem.source_attitude) -
               rotation)
                  .norm(),
              1e-9);
    const auto true_ones = TrueOnes(problem.matches, 0.06);
    EXPECT_EQ(true_ones.size(), 100u);
    EXPECT_EQ(true_ones.front(), 100);
  }
}

TEST(SlopeProblem, InsIsOffByItsStandardDeviationInEachAngle) {
  constexpr int kNumProblems = 2000;
  Eigen::Matrix<double, 6, 1> squares = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::uint64_t seed = 0; seed < kNumProblems; ++seed) {
    const SlopeProblem a = MakeSlopeProblem(1, 0.0, 0.0, 0.1, 0.0, seed);
    const SlopeProblem b = MakeSlopeProblem(1, 0.0, 0.0, 0.1, 0.01, seed);
    Eigen::Matrix<double, 6, 1> errors;
    errors << b.source_attitude.roll - a.source_attitude.roll,
        b.source_attitude.pitch - a.source_attitude.pitch,
        b.source_attitude.yaw - a.source_attitude.yaw,
        b.target_attitude.roll - a.target_attitude.roll,
        b.target_attitude.pitch - a.target_attitude.pitch,
        b.target_attitude.yaw - a.target_attitude.yaw;
    squares += errors.cwiseAbs2();
  }
  for (const double square : squares) {
    EXPECT_NEAR(std::sqrt(square / kNumProblems), 0.01, 0.0006);
  }
}

// Every problem is counted, from 1 to the total.
class ProtocolTest : public ::testing::Test {
 protected:
  Progress Count() {
    return [this](int num_done, int num_problems) {
      EXPECT_EQ(num_done, ++num_done_);
      num_problems_ = num_problems;
    };
  }

  void ExpectTable(const Table& table, std::size_t num_rows) {
    EXPECT_EQ(table.rows.size(), num_rows);
    for (const auto& row : table.rows) {
      EXPECT_EQ(row.size(), table.columns.size());
    }
    EXPECT_EQ(num_done_, num_problems_);
    EXPECT_GT(num_done_, 0);
  }

  int num_done_ = 0;
  int num_problems_ = 0;
};

TEST_F(ProtocolTest, TimsHaveARowPerOutlierRatio) {
  const Table table = RunTimProtocol(2, Count());
  ExpectTable(table, 3);
  EXPECT_EQ(num_done_, 6);
  EXPECT_EQ(table.rows[0][0], "95 %");
  EXPECT_EQ(table.rows[2][0], "99 %");
  for (const auto& row : table.rows) {
    EXPECT_EQ(row[2], "2/2") << row[0];  // The exact yaw.
    EXPECT_GE(std::stod(row[6]), -1e-9) << row[0];
  }
}

TEST_F(ProtocolTest, DegeneracyHasARowPerEstimatorAndNumber) {
  const Table table = RunDegeneracyProtocol(2, Count());
  ExpectTable(table, 12);
  EXPECT_EQ(num_done_, 8);
  std::set<std::string> estimators;
  for (const auto& row : table.rows) {
    estimators.insert(row[0]);
    if (row[1] == "1") {
      EXPECT_EQ(row[2], "0/2") << row[0];
    }
    if (row[0].starts_with("quasi") && row[1] != "1") {
      EXPECT_EQ(row[3], "2/2") << row[0] << ", " << row[1];
    }
    if (row[0].starts_with("SO(3)") && row[1] == "2") {
      EXPECT_EQ(row[2], "0/2");
    }
  }
  EXPECT_EQ(estimators.size(), 3u);
}

TEST_F(ProtocolTest, QuasiInliersHaveARowPerEstimatorBoundAndNumber) {
  const Table table = RunQuasiInlierProtocol(2, Count());
  ExpectTable(table, 18);
  EXPECT_EQ(num_done_, 12);
}

TEST_F(ProtocolTest, SlopesHaveARowPerInsNumberAndPolish) {
  const Table table = RunSlopeProtocol(2, Count());
  ExpectTable(table, 16);
  EXPECT_EQ(num_done_, 16);
  for (const auto& row : table.rows) {
    const bool is_yaw_alone = row[0] == "plain" && row[2] == "off";
    for (std::size_t i = 3; i < row.size(); ++i) {
      if (is_yaw_alone) {
        EXPECT_THAT(row[i], ::testing::EndsWith("(0/2)"));
      } else if (row[1] == "30") {
        EXPECT_THAT(row[i], ::testing::EndsWith("(2/2)")) << row[0] << row[2];
      }
    }
  }
}

TEST_F(ProtocolTest, SizesHaveARowPerSizeAndRatio) {
  const Table table = RunSizeProtocol(2, 10000, 1, Count());
  ExpectTable(table, 4);
  EXPECT_EQ(num_done_, 8);
  EXPECT_EQ(table.rows[0][0], "1000");
  EXPECT_EQ(table.rows[3][0], "10000");
  for (const auto& row : table.rows) {
    EXPECT_EQ(row[2], "2/2") << row[0] << ", " << row[1];
  }
}

TEST(TabulateSurrogates, EndsAtTruncatedLeastSquares) {
  const Table table = TabulateSurrogates();
  ASSERT_EQ(table.rows.size(), 6u * 301u);
  EXPECT_THAT(table.rows.front(), ElementsAre("0.01", "0.00", "0.000000"));
  EXPECT_THAT(table.rows.back(), ElementsAre("inf", "3.00", "1.000000"));
  EXPECT_THAT(table.rows[table.rows.size() - 301 + 50],
              ElementsAre("inf", "0.50", "0.250000"));
}

TEST(FormatTable, ColumnsAreUnderEachOther) {
  const Table table{{"name", "n", "long title"},
                    {{"a", "1", "2.5"}, {"longer name", "100", "3"}}};
  EXPECT_EQ(FormatTable(table),
            "name           n  long title\n"
            "a              1         2.5\n"
            "longer name  100           3\n");
  EXPECT_EQ(FormatTable({{"only"}, {}}), "only\n");
}

TEST(FormatCsv, QuotesWhatHoldsACommaOrAQuote) {
  const Table table{{"name", "n"},
                    {{"plain", "1"}, {"a, b", "2"}, {"say \"so\"", "3"}}};
  EXPECT_EQ(FormatCsv(table),
            "name,n\n"
            "plain,1\n"
            "\"a, b\",2\n"
            "\"say \"\"so\"\"\",3\n");
}

}  // namespace
}  // namespace quatro::synthetic_test
