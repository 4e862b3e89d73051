// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gflags/gflags.h>

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/outputs.h"
#include "experiments/programs/bound_flags.h"
#include "experiments/programs/explain.h"
#include "experiments/programs/flag_problems.h"
#include "experiments/programs/ins_flags.h"
#include "experiments/programs/json_report.h"
#include "experiments/programs/matches_csv.h"
#include "experiments/programs/methods.h"
#include "experiments/programs/picture.h"
#include "experiments/programs/program.h"
#include "robust/estimators/bound_solver.h"
#include "robust/verdict/summary_covariance.h"
#include "robust/verdict/verdict.h"

DEFINE_string(correspondences,
              "",
              "CSV file of matched points, sx,sy,sz,tx,ty,tz [m] a line; "
              "-: standard input");
DEFINE_string(preset, "kitti", "kitti, paper, reference or indoor");
DEFINE_string(method, "auto", "Method; see --list_methods");
DEFINE_bool(list_methods, false, "List the methods and exit");
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
DEFINE_string(gravity, "0,0,1", "What is up in a level cloud: x,y,z");
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
              "How far a right match may be off [m]; 0: the preset's");
DEFINE_uint64(seed, 0, "Of all that is drawn at random");
DEFINE_int32(threads, 0, "0: one per core. The answer does not depend on it");
DEFINE_string(json, "", "File for the answer; empty or -: standard output");
DEFINE_bool(explain,
            false,
            "Print what came of each stage in plain words, in place of the "
            "JSON on standard output");
DEFINE_string(picture, "", "PNG file for the points before and after");

namespace {

std::optional<quatro::InsOptions> InsFromFlags(std::string* error) {
  return quatro::ParseInsFlags({FLAGS_ins_mode,
                                FLAGS_source_rpy_deg,
                                FLAGS_target_rpy_deg,
                                FLAGS_ins_std_deg,
                                FLAGS_gravity},
                               error);
}

// For a method that starts from the guess, `is_local`.
std::optional<quatro::PoseBounds> BoundsFromFlags(bool is_local,
                                                  std::string* error) {
  return quatro::ParseBoundFlags({FLAGS_guess,
                                  FLAGS_max_translation,
                                  FLAGS_max_yaw_deg,
                                  FLAGS_max_tilt_deg},
                                 is_local,
                                 error);
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

std::optional<quatro::RegistrationOptions> OptionsFromFlags(
    std::string* error) {
  auto options = quatro::FindPreset(FLAGS_preset, error);
  if (!options) return std::nullopt;
  if (FLAGS_noise_bound != 0.0) {
    options->noise_bound = FLAGS_noise_bound;
  }
  options->quatro.seed = FLAGS_seed;
  options->quatro.num_threads = FLAGS_threads;
  options->quatro.crosscheck = FLAGS_crosscheck;
  if (!quatro::ApplySwitch("recover",
                           FLAGS_recover,
                           &options->quatro.recover_translation,
                           error) ||
      !quatro::ApplySwitch(
          "polish", FLAGS_polish, &options->quatro.polish, error)) {
    return std::nullopt;
  }
  if (!options->IsValid(error)) return std::nullopt;
  return options;
}

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
  const auto options = OptionsFromFlags(&error);
  if (!options) return Fail(error);
  const auto ins = InsFromFlags(&error);
  if (!ins) return Fail(error);
  const quatro::PoseSolver solver =
      quatro::MakeLevelSolver(FLAGS_method, options->quatro, *ins, &error);
  if (!solver) return Fail(error);
  const auto bounds = BoundsFromFlags(/*is_local=*/false, &error);
  if (!bounds) return Fail(error);
  const auto matches = quatro::ReadMatches(FLAGS_correspondences, &error);
  if (!matches) return Fail(error);

  quatro::Stopwatch stopwatch;
  quatro::PoseSummary summary = quatro::SolveWithin(matches->source,
                                                    matches->target,
                                                    solver,
                                                    options->quatro.noise_bound,
                                                    *ins,
                                                    *bounds);
  quatro::AddCovariance(matches->source,
                        matches->target,
                        options->noise_bound,
                        options->covariance,
                        &summary);
  const double total_seconds = stopwatch.Lap();
  quatro::VerdictOptions verdict_options = options->verdict;
  verdict_options.rival.seed = FLAGS_seed;
  verdict_options.rival.num_threads = FLAGS_threads;
  verdict_options.rival.up_in_target = ins->up;
  verdict_options.rival.bounds = quatro::WithVertical(*bounds, *ins);
  const quatro::Verdict verdict = quatro::Judge(matches->source,
                                                matches->target,
                                                summary,
                                                options->noise_bound,
                                                /*geometry=*/std::nullopt,
                                                verdict_options);

  quatro::Json report = quatro::MakeReport(
      FLAGS_method, verdict, summary, summary.stage_times, total_seconds);
  report["parameters"] = {{"correspondences", FLAGS_correspondences},
                          {"preset", FLAGS_preset}};
  report["parameters"].update(quatro::DescribeOptions(options->quatro));
  report["parameters"].update(quatro::DescribeOptions(*ins));
  report["parameters"].update(quatro::DescribeOptions(*bounds));
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
         summary.translation_inliers,
         summary.target_from_source,
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
