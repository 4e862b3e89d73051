// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/metrics/registration_metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "features/base/degree.h"
#include "tests/support/pair_results.h"

namespace quatro::registration_metrics_test {
namespace {

using ::testing::ElementsAre;

RegistrationMetrics Metrics(const std::vector<PairResult>& results) {
  return ComputeMetrics(results, UsualLimits());
}

// Five answers, one without an answer, one unreadable, two without overlap.
std::vector<PairResult> Mixed() {
  auto unsure = ResultOff("m", "e", 10.0, 60.0);
  unsure.status = "ambiguous";
  return {ResultOff("m", "a", 0.2, 1.0),
          ResultOff("m", "b", 1.0, 4.0),
          ResultOff("m", "c", 1.5, 8.0),
          ResultOff("m", "d", 3.0, 2.0),
          unsure,
          ResultWithoutAnswer("m", "f"),
          UnreadableResult("m", "g"),
          ResultApart("m", "h", "registered"),
          ResultApart("m", "i", "ambiguous")};
}

TEST(RegistrationMetrics, CountEveryKindOfPair) {
  const RegistrationMetrics metrics = Metrics(Mixed());
  EXPECT_EQ(metrics.num_pairs, 9);
  EXPECT_EQ(metrics.num_unreadable, 1);
  EXPECT_EQ(metrics.num_apart, 2);
  EXPECT_EQ(metrics.num_posed, 6);
  EXPECT_EQ(metrics.num_answers, 5);
  EXPECT_EQ(metrics.num_registered, 5);
  // d is beyond 2 m, h has no overlap; e is not registered.
  EXPECT_EQ(metrics.num_wrong_registered, 2);
  EXPECT_THAT(metrics.num_successes, ElementsAre(3, 2, 1));
}

TEST(RegistrationMetrics, WithoutTruthNothingIsRightOrWrong) {
  auto results = Mixed();
  const RegistrationMetrics before = Metrics(results);
  results.push_back(ResultWithoutTruth("m", "j"));
  const RegistrationMetrics metrics = Metrics(results);
  EXPECT_EQ(metrics.num_unknown, 1);
  EXPECT_EQ(metrics.num_apart, before.num_apart);
  EXPECT_EQ(metrics.num_registered, before.num_registered + 1);
  EXPECT_EQ(metrics.num_wrong_registered, before.num_wrong_registered);
  EXPECT_EQ(metrics.SuccessRate(0), before.SuccessRate(0));
}

TEST(RegistrationMetrics, RatesAreOfPairsWithTruthThatCouldBeRead) {
  const RegistrationMetrics metrics = Metrics(Mixed());
  EXPECT_DOUBLE_EQ(*metrics.SuccessRate(0), 3.0 / 6.0);
  EXPECT_DOUBLE_EQ(*metrics.SuccessRate(2), 1.0 / 6.0);
  ASSERT_EQ(metrics.success_intervals.size(), 3u);
  EXPECT_EQ(metrics.success_intervals[0].low, WilsonInterval(3, 6).low);
  EXPECT_EQ(metrics.success_intervals[0].high, WilsonInterval(3, 6).high);
}

TEST(RegistrationMetrics, AveragesAreByHand) {
  const RegistrationMetrics metrics = Metrics(Mixed());
  const ErrorAverages& good = metrics.of_successes;
  EXPECT_EQ(good.num_pairs, 3);
  EXPECT_NEAR(*good.translation, (0.2 + 1.0 + 1.5) / 3.0, 1e-12);
  EXPECT_NEAR(*good.translation_as_printed, (0.04 + 1.0 + 2.25) / 3.0, 1e-12);
  EXPECT_NEAR(*good.rotation, 13.0 / 3.0 * kDegree, 1e-12);
  EXPECT_NEAR(*good.yaw, 6.5 / 3.0 * kDegree, 1e-12);
  EXPECT_NEAR(*good.median_translation, 1.0, 1e-12);
  EXPECT_NEAR(*good.median_rotation, 4.0 * kDegree, 1e-12);
  const ErrorAverages& all = metrics.of_all;
  EXPECT_EQ(all.num_pairs, 5);
  EXPECT_NEAR(*all.translation, 15.7 / 5.0, 1e-12);
  EXPECT_NEAR(*all.rotation, 15.0 * kDegree, 1e-12);
  EXPECT_NEAR(*all.median_translation, 1.5, 1e-12);
  EXPECT_LE(all.translation_interval->low, *all.translation);
  EXPECT_GE(all.translation_interval->high, *all.translation);
}

TEST(RegistrationMetrics, WithoutBootstrapAreTheSameButForTheIntervals) {
  const RegistrationMetrics metrics =
      ComputeMetrics(Mixed(), UsualLimits(), std::nullopt);
  EXPECT_EQ(metrics.of_all.translation, Metrics(Mixed()).of_all.translation);
  EXPECT_FALSE(metrics.of_all.translation_interval);
  EXPECT_TRUE(Metrics(Mixed()).of_all.median_rotation_interval);
  EXPECT_EQ(metrics.success_intervals[1].low, WilsonInterval(2, 6).low);
}

TEST(RegistrationMetrics, ALimitIsWithinItself) {
  auto result = ResultOff("m", "a", 2.0, 0.0);
  result.error->rotation = 10.0 * kDegree;
  EXPECT_THAT(Metrics({result}).num_successes, ElementsAre(1, 0, 0));
}

TEST(RegistrationMetrics, OfNothingAreNone) {
  const RegistrationMetrics metrics = Metrics({});
  EXPECT_EQ(metrics.num_pairs, 0);
  EXPECT_FALSE(metrics.SuccessRate(0));
  EXPECT_FALSE(metrics.of_all.translation);
  EXPECT_FALSE(metrics.of_successes.median_rotation_interval);
  EXPECT_FALSE(Metrics({ResultWithoutAnswer("m", "a")}).of_all.rotation);
  EXPECT_EQ(*Metrics({ResultWithoutAnswer("m", "a")}).SuccessRate(0), 0.0);
}

TEST(RegistrationMetrics, OrderOfPairsDoesNotMatter) {
  auto reversed = Mixed();
  std::reverse(reversed.begin(), reversed.end());
  const RegistrationMetrics a = Metrics(Mixed()), b = Metrics(reversed);
  EXPECT_EQ(a.num_successes, b.num_successes);
  EXPECT_NEAR(*a.of_all.translation, *b.of_all.translation, 1e-12);
  EXPECT_EQ(a.num_wrong_registered, b.num_wrong_registered);
}

TEST(SuccessLimit, NamesItself) {
  std::vector<std::string> names;
  for (const SuccessLimit& limit : UsualLimits()) names.push_back(limit.Name());
  EXPECT_THAT(names, ElementsAre("2 m 10 deg", "2 m 5 deg", "0.6 m 5 deg"));
}

TEST(ParseLimits, AreMetresAndDegrees) {
  std::string error;
  const auto limits = ParseLimits("2/10,0.6/5", &error);
  ASSERT_TRUE(limits) << error;
  ASSERT_EQ(limits->size(), 2u);
  EXPECT_EQ((*limits)[1].translation, 0.6);
  EXPECT_NEAR((*limits)[1].rotation, 5.0 * M_PI / 180.0, 1e-15);
  EXPECT_EQ((*limits)[0].Name(), UsualLimits()[0].Name());
  for (const char* text : {"", "2", "2/", "2/-1", "x/1", "1/2/3"}) {
    EXPECT_FALSE(ParseLimits(text, &error)) << text;
    EXPECT_NE(error.find("must be like"), std::string::npos) << error;
  }
}

TEST(Recall, IsByHand) {
  const std::vector<double> grid = {0.0, 0.2, 1.2, 3.0, 100.0};
  EXPECT_THAT(TranslationRecall(Mixed(), grid),
              ElementsAre(0.0, 1.0 / 6.0, 2.0 / 6.0, 4.0 / 6.0, 5.0 / 6.0));
  EXPECT_THAT(RotationRecall(Mixed(), {1.5 * kDegree, 5.0 * kDegree}),
              ElementsAre(1.0 / 6.0, 3.0 / 6.0));
  EXPECT_THAT(TranslationRecall({}, {1.0}), ElementsAre(0.0));
}

}  // namespace
}  // namespace quatro::registration_metrics_test
