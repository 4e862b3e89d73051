// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/explain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <sstream>
#include <string>

#include "experiments/programs/options_json.h"
#include "robust/estimators/quatro.h"
#include "tests/support/matched_problems.h"

namespace quatro::explain_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// The report of quatro_solve for these matches.
Json Report(const PointsRef& source, const PointsRef& target) {
  const QuatroOptions options;
  const QuatroSummary summary = SolveQuatro(source, target, options);
  const Verdict verdict =
      Judge(source, target, summary, options.noise_bound, std::nullopt, {});
  Json report =
      MakeReport("quatro", verdict, summary, summary.stage_times, 0.1);
  report["parameters"] =
      DescribeOptions("quatro", /*has_clouds=*/false, RegistrationOptions());
  return report;
}

Json Report(const KnownProblem& problem) {
  return Report(problem.source, problem.target);
}

std::string Unwrapped(const std::string& text) {
  std::string line;
  std::istringstream words(text);
  for (std::string word; words >> word;) line += word + ' ';
  return line;
}

TEST(Explain, TellsTheNumbersOfTheReport) {
  const Json report = Report(
      MakeMatchedProblem({.num_inliers = 40, .num_outliers = 160}, /*seed=*/1));
  ASSERT_EQ(report["status"], "registered");
  const std::string text = Unwrapped(Explain(report));
  const Json& counts = report["counts"];
  EXPECT_THAT(
      text,
      HasSubstr("consensus: " + counts["consistent"].dump() + " of 200 "));
  EXPECT_THAT(text,
              HasSubstr("rotation: " + counts["rotation_inliers"].dump() +
                        " of " + counts["tims"].dump() + " differences"));
  EXPECT_THAT(text,
              HasSubstr("translation: " + counts["translation_inliers"].dump() +
                        " matches"));
  EXPECT_THAT(text, HasSubstr(report["notes"]["rotation"]));
  EXPECT_THAT(
      text,
      HasSubstr("polish: " + report["notes"]["polish"].get<std::string>()));
  EXPECT_THAT(text, HasSubstr("certificate: the yaw is the global optimum"));
  EXPECT_THAT(text, HasSubstr(report["reason"]));
  // Without clouds they are not mentioned, and there is nothing to change.
  EXPECT_THAT(text, Not(HasSubstr("voxels:")));
  EXPECT_THAT(text, Not(HasSubstr("geometry:")));
  EXPECT_THAT(text, Not(HasSubstr("what to do")));
  EXPECT_THAT(text, Not(HasSubstr("?")));
}

TEST(Explain, TellsOfAMissedOptimum) {
  Json report = Report(MakeMatchedProblem({}, /*seed=*/2));
  report["certificate"]["gap"] = 12.5;
  EXPECT_THAT(Unwrapped(Explain(report)),
              HasSubstr("stopped 12.5 above the optimum"));
}

TEST(Explain, OfTooFewSaysWhatToChange) {
  const std::string text =
      Unwrapped(Explain(Report(Points(3, 0), Points(3, 0))));
  EXPECT_THAT(text, HasSubstr("verdict: insufficient"));
  EXPECT_THAT(text, HasSubstr("what to do:"));
  EXPECT_THAT(text, HasSubstr("--noise_bound"));
}

TEST(Explain, OfAPoleSaysWhatToChange) {
  Points pole = Points::Zero(3, 10);
  pole.row(2).setLinSpaced(10, 0.0, 9.0);
  const std::string text = Unwrapped(Explain(Report(pole, pole)));
  EXPECT_THAT(text, HasSubstr("verdict: degenerate"));
  EXPECT_THAT(text, HasSubstr("on one line"));
}

TEST(Explain, OfTwinsNamesTheRival) {
  KnownProblem problem =
      MakeMatchedProblem({.num_inliers = 80, .num_outliers = 100}, /*seed=*/3);
  for (std::size_t k = 0; k < 39; ++k) {
    problem.target.col(problem.inliers[k]).x() += 7.0;
  }
  const std::string text = Unwrapped(Explain(Report(problem)));
  EXPECT_THAT(text, HasSubstr("verdict: ambiguous"));
  EXPECT_THAT(text, HasSubstr("another pose has nearly as many inliers"));
}

TEST(Explain, OfAnAccidentSaysSo) {
  const std::string text = Unwrapped(Explain(Report(MakeMatchedProblem(
      {.num_inliers = 2, .num_outliers = 100}, /*seed=*/6))));
  EXPECT_THAT(text, HasSubstr("verdict: ambiguous"));
  EXPECT_THAT(text, HasSubstr("no consensus stands out from chance"));
}

TEST(Explain, OfCloudsTellsTheFrontEndAndWhatSpeaksAgainst) {
  Json report = Report(MakeMatchedProblem({}, /*seed=*/4));
  report["status"] = "ambiguous";
  report["counts"].update(Json{{"source_points", 1000},
                               {"source_dropped", 3},
                               {"source_voxels", 500},
                               {"target_points", 1200},
                               {"target_dropped", 0},
                               {"target_voxels", 600},
                               {"mutual_matches", 2000}});
  report["evidence"]["geometry"] = {{"structure_overlap", 0.08},
                                    {"contradicted_share", 0.6},
                                    {"coarse_overlap", 0.1},
                                    {"rival_overlap", 0.09}};
  const std::string text = Unwrapped(Explain(report));
  EXPECT_THAT(text, HasSubstr("the 1000 source points (3 not finite"));
  EXPECT_THAT(text, HasSubstr("2000 pairs are mutual nearest neighbors"));
  EXPECT_THAT(text, HasSubstr("8 % of the vertical structure"));
  EXPECT_THAT(text, HasSubstr("--fpfh_radius"));
  EXPECT_THAT(text, HasSubstr("less than a tenth"));
  EXPECT_THAT(text, HasSubstr("show different places"));
  EXPECT_THAT(text, HasSubstr("free space"));
}

// The candidate described is the first one of the rung that gave the answer.
TEST(Explain, OfASearchNamesTheRungAndItsBestCandidate) {
  Json report = Report(MakeMatchedProblem({}, /*seed=*/5));
  EXPECT_THAT(Explain(report), Not(HasSubstr("search:")));
  const auto candidate = [](const char* origin, double score, double overlap) {
    return Json{{"origin", origin},
                {"score", score},
                {"overlap", overlap},
                {"contradicted_share", 0.25},
                {"log_likelihood_ratio", 30.0}};
  };
  report["candidates"] = {candidate("rung 1", 0.51, 0.11),
                          candidate("rung 1, leveled by walls", 0.42, 0.12),
                          candidate("rung 2", 2.53, 0.63),
                          candidate("rung 2", 0.84, 0.14)};
  report["rung"] = 2;
  std::string text = Unwrapped(Explain(report));
  EXPECT_THAT(text, HasSubstr("4 candidates were aligned with the scans"));
  EXPECT_THAT(text, HasSubstr("the answer is from rung 2"));
  EXPECT_THAT(text, HasSubstr("a score of 2.5, with 63 % overlap"));
  EXPECT_THAT(text, HasSubstr("the next one 0.84"));
  EXPECT_THAT(text, Not(HasSubstr("0.51")));
  report["rung"] = 0;
  text = Unwrapped(Explain(report));
  EXPECT_THAT(text, HasSubstr("none is more probable"));
  EXPECT_THAT(text, HasSubstr("0.51"));
  EXPECT_THAT(text, HasSubstr("the next one 0.42"));
}

TEST(Explain, TellsOfAnInsAndOfARefinement) {
  Json report = Report(MakeMatchedProblem({}, /*seed=*/7));
  EXPECT_THAT(Explain(report), Not(HasSubstr("ins:")));
  EXPECT_THAT(Explain(report), Not(HasSubstr("refinement:")));
  report["parameters"]["ins_mode"] = "fused";
  report["message"] = "solved; fused with the INS";
  report["refinement"] = {{"method", "gicp"},
                          {"moved_m", 0.25},
                          {"moved_deg", 0.5},
                          {"message", "taken"}};
  const std::string text = Unwrapped(Explain(report));
  EXPECT_THAT(text, HasSubstr("ins: roll and pitch of the INS, fused; solved"));
  EXPECT_THAT(
      text,
      HasSubstr("refinement: gicp moved the pose by 0.25 m and 0.5 deg: "
                "taken"));
}

TEST(Explain, KeepsToTheWidthOfATerminal) {
  std::istringstream text(Explain(Report(MakeMatchedProblem({}, /*seed=*/5))));
  for (std::string line; std::getline(text, line);) {
    EXPECT_LE(line.size(), 79u) << line;
  }
}

}  // namespace
}  // namespace quatro::explain_test
