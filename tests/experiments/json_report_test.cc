// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/json_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "robust/pose_summary.h"
#include "robust/quatro.h"
#include "robust/registration.h"
#include "robust/verdict.h"
#include "solvers/rigid3.h"

namespace quatro {
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
  summary.num_distinct = 1;
  summary.num_consistent = 2;
  summary.num_tims = 3;
  summary.num_rotation_inliers = 4;
  summary.num_translation_inliers = 5;
  Verdict verdict;
  verdict.num_agreeing = 6;
  EXPECT_EQ(MakeReport("quatro", verdict, summary, {}, 0.0)["counts"],
            Json({{"correspondences", 1},
                  {"clique", 2},
                  {"tims", 3},
                  {"rotation_inliers", 4},
                  {"translation_inliers", 5},
                  {"agreeing", 6}}));
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

TEST(JsonReportTest, OverlapIsNullWhereItWasNotMeasured) {
  Verdict verdict;
  EXPECT_TRUE(MakeReport("quatro",
                         verdict,
                         PoseSummary(),
                         {},
                         0.0)["evidence"]["structure_overlap"]
                  .is_null());
  verdict.structure_overlap = 0.5;
  EXPECT_EQ(MakeReport("quatro",
                       verdict,
                       PoseSummary(),
                       {},
                       0.0)["evidence"]["structure_overlap"],
            0.5);
}

TEST(JsonReportTest, GeometryIsThereWhereItWasMeasured) {
  const auto evidence = [](const Verdict& verdict) {
    return MakeReport("quatro", verdict, PoseSummary(), {}, 0.0)["evidence"];
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

TEST(JsonReportTest, OptionsAreDescribedByTheirNamesInTheLibrary) {
  RegistrationOptions options;
  options.quatro.noise_bound = 0.15;
  options.quatro.gnc.start = GncStart::kIdentity;
  options.front_end.normal_radius = 0.5;
  const Json quatro = DescribeOptions(options.quatro);
  EXPECT_EQ(quatro["noise_bound"], 0.15);
  EXPECT_EQ(quatro["gnc_start"], "identity");
  const Json front_end = DescribeOptions(options.front_end);
  EXPECT_EQ(front_end["voxel_size"], options.front_end.voxel_size);
  EXPECT_EQ(front_end["normal_radius"], 0.5);
}

TEST(JsonReportTest, VersionIsThreeNumbers) {
  EXPECT_THAT(Version(), ::testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
}

}  // namespace
}  // namespace quatro
