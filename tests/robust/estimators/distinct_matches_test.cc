// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/distinct_matches.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::distinct_matches_test {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

class DistinctMatchesTest : public ::testing::Test {
 protected:
  const KnownProblem problem_ = MakeMatchedProblem({}, /*seed=*/1);
  const Points& source_ = problem_.source;
  const Points& target_ = problem_.target;
  const DistinctMatches distinct_ = FindDistinctMatches(source_, target_);
};

TEST_F(DistinctMatchesTest, KeepsDistinctMatchesOnceEach) {
  EXPECT_EQ(distinct_.source.cols(), source_.cols());
  std::set<Eigen::Index> columns;
  for (std::size_t k = 0; k < distinct_.columns.size(); ++k) {
    ASSERT_THAT(distinct_.columns[k], SizeIs(1));
    const Eigen::Index i = distinct_.columns[k].front();
    columns.insert(i);
    EXPECT_EQ(distinct_.source.col(static_cast<Eigen::Index>(k)),
              source_.col(i));
    EXPECT_EQ(distinct_.target.col(static_cast<Eigen::Index>(k)),
              target_.col(i));
  }
  EXPECT_THAT(columns, SizeIs(source_.cols()));
}

TEST_F(DistinctMatchesTest, OrderOfTheInputDoesNotMatter) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const auto order = RandomPermutation(source_.cols(), seed);
    const DistinctMatches permuted = FindDistinctMatches(
        Reordered(source_, order), Reordered(target_, order));
    EXPECT_EQ(permuted.source, distinct_.source) << "seed " << seed;
    EXPECT_EQ(permuted.target, distinct_.target) << "seed " << seed;
  }
}

TEST_F(DistinctMatchesTest, TakesCopiesTogetherWhereverTheyAre) {
  auto order = RandomPermutation(source_.cols(), 1);
  const auto again = RandomPermutation(source_.cols(), 2);
  order.insert(order.end(), again.begin(), again.end());
  const DistinctMatches doubled =
      FindDistinctMatches(Reordered(source_, order), Reordered(target_, order));
  EXPECT_EQ(doubled.source, distinct_.source);
  EXPECT_EQ(doubled.target, distinct_.target);
  for (std::size_t k = 0; k < doubled.columns.size(); ++k) {
    const auto& copies = doubled.columns[k];
    ASSERT_THAT(copies, SizeIs(2));
    EXPECT_LT(copies[0], copies[1]);
    for (const Eigen::Index copy : copies) {
      EXPECT_EQ(order[static_cast<std::size_t>(copy)],
                distinct_.columns[k].front());
    }
  }
}

TEST_F(DistinctMatchesTest, ValuesComeInTheOrderOfTheirColumns) {
  auto order = RandomPermutation(source_.cols(), 1);
  const auto again = RandomPermutation(source_.cols(), 2);
  order.insert(order.end(), again.begin(), again.end());
  const DistinctMatches doubled =
      FindDistinctMatches(Reordered(source_, order), Reordered(target_, order));
  const std::vector<Eigen::Index> selected = {7, 3, 20};
  // The value of each match is the x of its source.
  std::vector<double> values;
  for (const Eigen::Index k : selected) {
    values.push_back(doubled.source(0, k));
  }
  const auto columns = InputColumns(doubled, selected);
  const auto in_order = InputValues(doubled, selected, values);
  ASSERT_THAT(in_order, SizeIs(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto column = static_cast<std::size_t>(columns[i]);
    EXPECT_EQ(in_order[i], source_(0, order[column]));
  }
}

TEST_F(DistinctMatchesTest, TwoMatchesThatShareAPointAreTwo) {
  Points target = target_.leftCols(2);
  const Points source = source_.leftCols(1).replicate(1, 2);
  EXPECT_THAT(FindDistinctMatches(source, target).columns, SizeIs(2));
  target.col(1) = target.col(0);
  EXPECT_THAT(FindDistinctMatches(source, target).columns, SizeIs(1));
}

TEST_F(DistinctMatchesTest, ADifferenceInTheLastBitIsADifference) {
  Points source = source_.leftCols(1).replicate(1, 2);
  const Points target = target_.leftCols(1).replicate(1, 2);
  source(2, 1) = std::nextafter(source(2, 1), 1e9);
  EXPECT_THAT(FindDistinctMatches(source, target).columns, SizeIs(2));
}

TEST_F(DistinctMatchesTest, MinusZeroIsZero) {
  Points source = Points::Zero(3, 2);
  Points target = Points::Zero(3, 2);
  source.col(1).setConstant(-0.0);
  target(1, 0) = -0.0;
  const DistinctMatches distinct = FindDistinctMatches(source, target);
  ASSERT_THAT(distinct.columns, SizeIs(1));
  EXPECT_THAT(distinct.columns[0], ElementsAre(0, 1));
}

TEST_F(DistinctMatchesTest, SwappingSourceAndTargetKeepsTheOrder) {
  const DistinctMatches swapped = FindDistinctMatches(target_, source_);
  EXPECT_EQ(swapped.columns, distinct_.columns);
  EXPECT_EQ(swapped.source, distinct_.target);
  EXPECT_EQ(swapped.target, distinct_.source);
}

TEST_F(DistinctMatchesTest, NeighboursInOrderAreNoNeighboursInSpace) {
  // Points along a line, in order. Differences between neighbors in the new
  // order are long.
  const Eigen::Index n = 1000;
  Points line = Points::Zero(3, n);
  line.row(0).setLinSpaced(n, 0.0, 999.0);
  const Points x = FindDistinctMatches(line, line).source;
  const double mean_step =
      (x.rightCols(n - 1) - x.leftCols(n - 1)).row(0).cwiseAbs().mean();
  EXPECT_GT(mean_step, 250.0);  // A third of the length in a random order.
}

TEST_F(DistinctMatchesTest, NoMatchesAreNone) {
  const DistinctMatches none = FindDistinctMatches(Points(3, 0), Points(3, 0));
  EXPECT_EQ(none.source.cols(), 0);
  EXPECT_EQ(none.target.cols(), 0);
  EXPECT_THAT(none.columns, SizeIs(0));
}

}  // namespace
}  // namespace quatro::distinct_matches_test
