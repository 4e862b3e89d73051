// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gflags/gflags.h>

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/outputs.h"
#include "experiments/programs/explain.h"
#include "experiments/programs/flag_problems.h"
#include "experiments/programs/json_report.h"
#include "experiments/programs/matches_csv.h"
#include "experiments/programs/methods.h"
#include "experiments/programs/picture.h"
#include "experiments/programs/program.h"
#include "experiments/programs/registration_flags.h"
#include "robust/registration/registration.h"

DEFINE_string(correspondences,
              "",
              "CSV file of matched points, sx,sy,sz,tx,ty,tz [m] a line; "
              "-: standard input");
DEFINE_string(preset, "kitti", "kitti, paper, reference or indoor");
DEFINE_string(method, "auto", "Method; see --list_methods");
DEFINE_bool(list_methods, false, "List the methods and exit");
DEFINE_string(options,
              "",
              "Further options of the method, name=value;name=value; see "
              "--list_options");
DEFINE_bool(list_options, false, "List the options of --method and exit");
DEFINE_string(recover,
              "",
              "Re-estimate the translation: on or off; empty: the "
              "preset's");
DEFINE_string(polish,
              "",
              "Polish roll and pitch: on or off; empty: the preset's");
DEFINE_string(ins_mode,
              "none",
              "Roll and pitch from an INS: none, relative, leveled or fused");
DEFINE_string(source_rpy_deg,
              "",
              "The INS' roll,pitch,yaw of the source [deg]; x ahead, z up");
DEFINE_string(target_rpy_deg,
              "",
              "The INS' roll,pitch,yaw of the target [deg]");
DEFINE_double(ins_std_deg,
              0.5,
              "Standard deviation of each roll and pitch [deg], for fused");
DEFINE_string(gravity, "0,0,1", "Up direction of a level cloud: x,y,z");
DEFINE_string(guess,
              "",
              "A prior on target_from_source: x,y,z,yaw_deg, or a text file of "
              "4, 12 or 16 numbers (the rows of a matrix); empty: no motion");
DEFINE_double(max_translation,
              0.0,
              "Largest distance from the guess [m]; 0: any");
DEFINE_double(max_yaw_deg, 180.0, "Largest yaw from the guess [deg]; 180: any");
DEFINE_double(
    max_tilt_deg,
    5.0,
    "Largest tilt from the guess [deg], with one of the bounds above");
DEFINE_bool(crosscheck,
            false,
            "Solve every weighted subproblem by Ceres too and report the "
            "largest difference");
DEFINE_double(noise_bound,
              0.0,
              "Largest error of an inlier [m]; 0: the preset's");
DEFINE_uint64(seed, 0, "Random seed");
DEFINE_int32(threads,
             0,
             "Threads; 0: one per core. Does not affect the result");
DEFINE_string(json, "", "File for the answer; empty or -: standard output");
DEFINE_bool(explain,
            false,
            "Print what came of each stage in plain words, in place of the "
            "JSON on standard output");
DEFINE_string(picture, "", "PNG file for the points before and after");

namespace {

quatro::RegistrationFlags GivenFlags() {
  return {FLAGS_method,
          FLAGS_recover,
          FLAGS_polish,
          /*refine=*/"",
          FLAGS_options,
          FLAGS_crosscheck,
          FLAGS_noise_bound,
          FLAGS_seed,
          FLAGS_threads,
          {FLAGS_ins_mode,
           FLAGS_source_rpy_deg,
           FLAGS_target_rpy_deg,
           FLAGS_ins_std_deg,
           FLAGS_gravity},
          {FLAGS_guess,
           FLAGS_max_translation,
           FLAGS_max_yaw_deg,
           FLAGS_max_tilt_deg}};
}

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

int Main(int argc, char** argv) {
  using quatro::Fail;
  if (const auto exit_code =
          quatro::ParseFlags(kUsage, "solve_main", argc, argv)) {
    return *exit_code;
  }
  if (FLAGS_list_methods) {
    std::fputs(quatro::DescribeMethods().c_str(), stdout);
    return quatro::kExitDone;
  }
  std::string error;
  if (FLAGS_list_options) {
    const std::string text =
        quatro::DescribeOptionsOf(FLAGS_method, /*has_clouds=*/false, &error);
    if (text.empty()) return Fail(error);
    std::fputs(text.c_str(), stdout);
    return quatro::kExitDone;
  }
  if (FLAGS_correspondences.empty()) {
    return Fail("--correspondences is empty, must name a CSV file");
  }
  if (!quatro::CanWriteAll(
          {{"json", quatro::JsonPath(FLAGS_json, FLAGS_explain)},
           {"explain", FLAGS_explain ? "-" : ""},
           {"picture", FLAGS_picture}},
          {FLAGS_correspondences},
          &error)) {
    return Fail(error);
  }
  if (!quatro::HasEnding({"picture", FLAGS_picture}, ".png", &error)) {
    return Fail(error);
  }
  if (!FLAGS_picture.empty() && !quatro::CanDrawPictures(&error)) {
    return Fail(error);
  }
  auto options = quatro::FindPreset(FLAGS_preset, &error);
  if (!options || !quatro::ApplyFlags(
                      GivenFlags(), /*has_clouds=*/false, &*options, &error)) {
    return Fail(error);
  }
  const auto matches = quatro::ReadMatches(FLAGS_correspondences, &error);
  if (!matches) return Fail(error);

  const quatro::RegistrationSummary summary = quatro::FindMatchSolver(
      FLAGS_method, {}, &error)({matches->source, matches->target}, *options);
  if (!summary.error.empty()) return Fail(summary.error);
  const quatro::Verdict& verdict = summary.verdict;

  quatro::Json report = quatro::MakeReport(FLAGS_method,
                                           verdict,
                                           summary.solution,
                                           summary.stage_times,
                                           summary.total_seconds);
  report["parameters"] = {{"correspondences", FLAGS_correspondences},
                          {"preset", FLAGS_preset}};
  report["parameters"].update(
      quatro::DescribeOptions(quatro::WithSharedValues(*options).quatro));
  report["parameters"].update(quatro::DescribeOptions(options->ins));
  report["parameters"].update(quatro::DescribeOptions(options->bounds));
  report["version"] = quatro::Version();
  std::fprintf(stderr,
               "%s: %s\n",
               quatro::StatusName(verdict.status),
               verdict.reason.c_str());

  std::vector<quatro::OutputFile> files;
  if (!FLAGS_picture.empty()) {
    const auto picture = quatro::DrawRegistration(
        {matches->source,
         matches->target,
         matches->source,
         matches->target,
         summary.solution.translation_inliers,
         summary.target_from_source(),
         std::string(quatro::StatusName(verdict.status)) + ": " +
             verdict.reason},
        &error);
    if (!picture) return Fail(error);
    files.push_back({FLAGS_picture, *picture});
  }
  const std::string json_path = quatro::JsonPath(FLAGS_json, FLAGS_explain);
  if (!json_path.empty()) files.push_back({json_path, report.dump(2) + "\n"});
  if (FLAGS_explain) files.push_back({"", quatro::Explain(report)});
  if (!quatro::WriteOutputs(files, &error)) return Fail(error);
  return verdict.IsRegistered() ? quatro::kExitDone
                                : quatro::kExitNotVouchedFor;
}

}  // namespace

int main(int argc, char** argv) { return quatro::RunProgram(Main, argc, argv); }
