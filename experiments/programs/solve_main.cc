// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gflags/gflags.h>

#include <cstdio>
#include <string>

#include "experiments/programs/flag_problems.h"
#include "experiments/programs/json_report.h"
#include "experiments/programs/matches_csv.h"
#include "experiments/programs/methods.h"
#include "experiments/programs/options_json.h"
#include "experiments/programs/program.h"
#include "experiments/programs/registration_flags.h"
#include "robust/registration/registration.h"

DEFINE_string(correspondences,
              "",
              "CSV file of matched points, sx,sy,sz,tx,ty,tz [m] a line; "
              "-: standard input");
DEFINE_string(preset, "kitti", "kitti, paper, reference or indoor");
DEFINE_string(method, "auto", "Method; see --list_methods");

namespace {

constexpr char kUsage[] =
    "finds the pose between matched points, mostly outliers.\n"
    "\n"
    "  quatro_solve --correspondences=matches.csv --noise_bound=0.3\n"
    "\n"
    "The answer is JSON; target_from_source moves source points onto target\n"
    "points. Exits with 0 if registered; 1 if an answer can't be vouched for\n"
    "(the JSON says why); 2 if a flag or a file is invalid (nothing is "
    "written\n"
    "then).";

// The JSON report: the answer, its inputs and its options.
quatro::Json MakeReportOf(const quatro::RegistrationSummary& summary,
                          const quatro::RegistrationOptions& options) {
  quatro::Json report = quatro::MakeReport(FLAGS_method,
                                           summary.verdict,
                                           summary.solution,
                                           summary.stage_times,
                                           summary.total_seconds);
  report["parameters"] = {{"correspondences", FLAGS_correspondences},
                          {"preset", FLAGS_preset}};
  report["parameters"].update(
      quatro::DescribeOptions(FLAGS_method, /*has_clouds=*/false, options));
  report["version"] = quatro::Version();
  return report;
}

int Main(int argc, char** argv) {
  using quatro::Fail;
  if (const auto exit_code = quatro::ParseFlags(kUsage, argc, argv)) {
    return *exit_code;
  }
  if (const auto exit_code =
          quatro::PrintLists(FLAGS_method, /*has_clouds=*/false)) {
    return *exit_code;
  }
  if (FLAGS_correspondences.empty()) {
    return Fail("--correspondences is empty, must name a CSV file");
  }
  std::string error;
  if (!quatro::CanWriteAnswer({}, {FLAGS_correspondences}, &error)) {
    return Fail(error);
  }
  auto options = quatro::FindPreset(FLAGS_preset, &error);
  if (!options || !quatro::ApplyFlags(FLAGS_method,
                                      /*refine=*/"",
                                      /*has_clouds=*/false,
                                      &*options,
                                      &error)) {
    return Fail(error);
  }
  const auto matches = quatro::ReadMatches(FLAGS_correspondences, &error);
  if (!matches) return Fail(error);

  const quatro::RegistrationSummary summary = quatro::FindMatchSolver(
      FLAGS_method, {}, &error)({matches->source, matches->target}, *options);
  if (!summary.error.empty()) return Fail(summary.error);
  const std::string verdict = quatro::VerdictLine(summary.verdict);
  std::fprintf(stderr, "%s\n", verdict.c_str());
  return quatro::WriteAnswer(MakeReportOf(summary, *options),
                             {matches->source,
                              matches->target,
                              matches->source,
                              matches->target,
                              summary.solution.translation_inliers,
                              summary.target_from_source(),
                              verdict},
                             summary.verdict,
                             {});
}

}  // namespace

int main(int argc, char** argv) { return quatro::RunProgram(Main, argc, argv); }
