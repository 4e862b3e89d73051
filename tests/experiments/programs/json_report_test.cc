// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/json_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "robust/estimators/pose_summary.h"
#include "robust/registration/registration.h"
#include "robust/verdict/verdict.h"

namespace quatro::json_report_test {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> Names(const Json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return names;
}

TEST(JsonReportTest, WithoutAnAnswerThePoseIsNull) {
  const Json report = MakeReport("quatro", Verdict(), PoseSummary(), {}, 0.0);
  EXPECT_THAT(Names(report),
              ::testing::IsSupersetOf({"status",
                                       "reason",
                                       "target_from_source",
                                       "yaw_deg",
                                       "counts",
                                       "covariance",
                                       "certificate",
                                       "timings_ms",
                                       "method"}));
  EXPECT_EQ(report["status"], "insufficient");
  EXPECT_EQ(report["reason"], "no registration was tried");
  EXPECT_TRUE(report["target_from_source"].is_null());
  EXPECT_TRUE(report["yaw_deg"].is_null());
  EXPECT_EQ(report["method"], "quatro");
}

TEST(JsonReportTest, PoseIsWrittenRowByRowAndBitForBit) {
  PoseSummary summary;
  summary.target_from_source = Rigid3{RotationZ(-2.0), {0.1, -1.0 / 3.0, 1e7}};
  const std::string text =
      MakeReport("quatro", Verdict(), summary, {}, 0.0).dump();
  const Json report = Json::parse(text);
  const Eigen::Matrix4d expected = summary.target_from_source->ToMatrix();
  ASSERT_EQ(report["target_from_source"].size(), 4u);
  for (int row = 0; row < 4; ++row) {
    const auto numbers = report["target_from_source"]
                             .at(static_cast<std::size_t>(row))
                             .get<std::vector<double>>();
    EXPECT_THAT(numbers,
                ElementsAre(expected(row, 0),
                            expected(row, 1),
                            expected(row, 2),
                            expected(row, 3)));
  }
  EXPECT_NEAR(report["yaw_deg"].get<double>(), -2.0 * 180.0 / M_PI, 1e-12);
}

TEST(JsonReportTest, CountsAreTheSolvers) {
  PoseSummary summary;
  summary.num_matches = 1;
  summary.num_consistent = 2;
  summary.num_tims = 3;
  summary.num_rotation_inliers = 4;
  summary.num_translation_inliers = 5;
  Verdict verdict;
  verdict.num_inliers = 6;
  EXPECT_EQ(MakeReport("quatro", verdict, summary, {}, 0.0)["counts"],
            Json({{"matches", 1},
                  {"consistent", 2},
                  {"tims", 3},
                  {"rotation_inliers", 4},
                  {"translation_inliers", 5},
                  {"inliers", 6}}));
}

TEST(JsonReportTest, ErrorRadiusIsInMetersAndDegrees) {
  EXPECT_TRUE(DescribeRadius(std::nullopt).is_null());
  const Json radius = DescribeRadius(
      std::optional(ErrorRadius{0.12, M_PI / 180.0, Regime::kFar, 0.04, 0.01}));
  EXPECT_EQ(radius["translation_m"], 0.12);
  EXPECT_NEAR(radius["rotation_deg"].get<double>(), 1.0, 1e-12);
  EXPECT_EQ(radius["confidence"], 0.95);
  EXPECT_EQ(radius["regime"], "far");
}

TEST(JsonReportTest, TimesAreMillisecondsStageByStage) {
  const Json report = MakeReport("quatro",
                                 Verdict(),
                                 PoseSummary(),
                                 {{"graph", 0.0123456}, {"clique", 2.0}},
                                 2.5);
  EXPECT_THAT(Names(report["timings_ms"]),
              ElementsAre("graph", "clique", "total"));
  EXPECT_EQ(report["timings_ms"]["graph"], 12.346);
  EXPECT_EQ(report["timings_ms"]["clique"], 2000.0);
  EXPECT_EQ(report["timings_ms"]["total"], 2500.0);
}

TEST(JsonReportTest, EveryStatusHasItsName) {
  const auto name_of = [](Status status) {
    Verdict verdict;
    verdict.status = status;
    return MakeReport("quatro", verdict, PoseSummary(), {}, 0.0)["status"];
  };
  EXPECT_EQ(name_of(Status::kRegistered), "registered");
  EXPECT_EQ(name_of(Status::kAmbiguous), "ambiguous");
  EXPECT_EQ(name_of(Status::kDegenerate), "degenerate");
  EXPECT_EQ(name_of(Status::kInsufficient), "insufficient");
}

TEST(JsonReportTest, EvidenceIsNullWhereItWasNotMeasured) {
  const auto evidence_of = [](const Verdict& verdict) {
    return MakeReport("quatro", verdict, PoseSummary(), {}, 0.0)["evidence"];
  };
  Verdict verdict;
  Json evidence = evidence_of(verdict);
  EXPECT_TRUE(evidence["false_alarms"].empty());
  EXPECT_TRUE(evidence["rival"].is_null());
  EXPECT_TRUE(evidence["geometry"].is_null());
  EXPECT_TRUE(evidence["features"].empty());

  verdict.false_alarms.push_back({"pose", 100, 20, 0.25, -7.5});
  verdict.rival.emplace();
  verdict.rival->num_inliers = 19;
  verdict.geometry.emplace();
  verdict.geometry->structure_overlap = 0.5;
  verdict.features.push_back({"overlap", 0.5});
  evidence = evidence_of(verdict);
  EXPECT_EQ(evidence["false_alarms"][0]["stage"], "pose");
  EXPECT_EQ(evidence["false_alarms"][0]["log10_false_alarms"], -7.5);
  EXPECT_EQ(evidence["rival"]["inliers"], 19);
  EXPECT_EQ(evidence["rival"]["target_from_source"].size(), 4u);
  EXPECT_EQ(evidence["geometry"]["structure_overlap"], 0.5);
  EXPECT_TRUE(evidence["geometry"]["contradicted_share"].is_null());
  EXPECT_EQ(evidence["features"]["overlap"], 0.5);
}

TEST(JsonReportTest, GeometryIsThereWhereItWasMeasured) {
  const auto evidence = [](const Verdict& verdict) {
    return MakeReport(
        "quatro", verdict, PoseSummary(), {}, 0.0)["evidence"]["geometry"];
  };
  Verdict verdict;
  EXPECT_FALSE(evidence(verdict).contains("rival_overlap"));
  verdict.geometry.emplace();
  verdict.geometry->rival.rival_overlap = 0.25;
  verdict.geometry->rival.yaw = -M_PI;
  verdict.geometry->rival.shift << 1.0, 2.0, 3.0;
  EXPECT_TRUE(evidence(verdict)["contradicted_share"].is_null());
  verdict.geometry->free_space = {10, 30};
  verdict.geometry->rival_free_space = {1, 1};
  EXPECT_EQ(evidence(verdict)["contradicted_share"], 0.25);
  EXPECT_EQ(evidence(verdict)["contradicted"], 10);
  EXPECT_EQ(evidence(verdict)["rival_contradicted_share"], 0.5);
  EXPECT_EQ(evidence(verdict)["rival_overlap"], 0.25);
  EXPECT_EQ(evidence(verdict)["rival_yaw_deg"], -180.0);
  EXPECT_EQ(evidence(verdict)["rival_shift_m"].dump(), "[1.0,2.0,3.0]");
}

TEST(JsonReportTest, CovarianceIsSixRowsBitForBitOrNull) {
  const auto report_on = [](const PoseSummary& summary) {
    return Json::parse(
        MakeReport("quatro", Verdict(), summary, {}, 0.0).dump());
  };
  EXPECT_TRUE(report_on(PoseSummary())["covariance"].is_null());
  EXPECT_TRUE(report_on(PoseSummary())["unobservable_directions"].empty());

  PoseSummary summary;
  PoseCovariance& uncertainty = summary.covariance.emplace();
  uncertainty.sigma = 0.1;
  UnobservableDirection direction;
  direction.axis = Eigen::Vector3d::UnitX();
  direction.point = {1.0, 2.0, 3.0};
  direction.standard_deviation = 0.02;
  direction.reason = UnobservableReason::kUncertain;
  uncertainty.unobservable.push_back(direction);
  direction.freedom = Freedom::kTranslation;
  direction.reason = UnobservableReason::kNoSurface;
  direction.standard_deviation.reset();
  uncertainty.unobservable.push_back(direction);
  Json report = report_on(summary);
  EXPECT_TRUE(report["covariance"].is_null());
  ASSERT_EQ(report["unobservable_directions"].size(), 2u);
  EXPECT_EQ(report["unobservable_directions"][0],
            Json({{"freedom", "rotation"},
                  {"reason", "uncertain"},
                  {"axis", {1.0, 0.0, 0.0}},
                  {"point", {1.0, 2.0, 3.0}},
                  {"standard_deviation", 0.02},
                  {"text", uncertainty.unobservable[0].Describe()}}));
  EXPECT_EQ(report["unobservable_directions"][1]["freedom"], "translation");
  EXPECT_EQ(report["unobservable_directions"][1]["reason"], "no_surface");
  EXPECT_TRUE(report["unobservable_directions"][1]["point"].is_null());
  EXPECT_TRUE(
      report["unobservable_directions"][1]["standard_deviation"].is_null());
  EXPECT_EQ(report["match_sigma"]["assumed"], 0.1);
  EXPECT_TRUE(report["match_sigma"]["from_residuals"].is_null());

  uncertainty.covariance =
      Matrix6::NullaryExpr([](Eigen::Index row, Eigen::Index column) {
        return static_cast<double>(1 + 6 * row + column) / 3.0;
      });
  uncertainty.covariance_at_center = 2.0 * *uncertainty.covariance;
  report = report_on(summary);
  ASSERT_EQ(report["covariance"].size(), 6u);
  for (std::size_t row = 0; row < 6; ++row) {
    ASSERT_EQ(report["covariance"][row].size(), 6u);
    for (std::size_t column = 0; column < 6; ++column) {
      const double expected = static_cast<double>(1 + 6 * row + column) / 3.0;
      EXPECT_EQ(report["covariance"][row][column], expected);
      EXPECT_EQ(report["covariance_about"]["covariance"][row][column],
                2.0 * expected);
    }
  }
}

TEST(JsonReportTest, StructureThatWasNotMeasuredIsNull) {
  EXPECT_TRUE(Describe(std::nullopt).is_null());
  SurfaceObservability hold;
  hold.weakest_level_share = 0.25;
  hold.weakest_level_axis = Eigen::Vector3d::UnitY();
  EXPECT_EQ(Describe(hold)["weakest_level_share"], 0.25);
  EXPECT_EQ(Describe(hold)["weakest_level_axis"], Json({0.0, 1.0, 0.0}));
}

TEST(JsonReportTest, VersionIsThreeNumbers) {
  EXPECT_THAT(Version(), ::testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
}

}  // namespace
}  // namespace quatro::json_report_test
