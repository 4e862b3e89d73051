// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gflags/gflags.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include "experiments/base/outputs.h"
#include "experiments/programs/aligned_clouds.h"
#include "experiments/programs/explain.h"
#include "experiments/programs/json_report.h"
#include "experiments/programs/matches_csv.h"
#include "experiments/programs/methods.h"
#include "experiments/programs/picture.h"
#include "experiments/programs/program.h"
#include "experiments/programs/registration_flags.h"
#include "experiments/report/pair_report.h"
#include "experiments/report/report_template.h"
#include "experiments/runner/manifest.h"
#include "features/io/cloud_io.h"
#include "robust/registration/presets.h"
#include "robust/registration/registration.h"

DEFINE_string(source,
              "",
              "The cloud to move: .bin (KITTI), .ply, .pcd, .npy, .xyz, .txt "
              "or .csv, or one of these with .gz");
DEFINE_string(target, "", "The cloud to move it onto");
DEFINE_int32(point_floats,
             0,
             "Numbers of a point of a .bin: x, y, z, the intensity, others; 0: "
             "told by the file");
DEFINE_string(preset,
              "kitti",
              "kitti (64 beams outdoors), paper or reference (as published), "
              "indoor (16 beams), or auto (from the clouds themselves)");
DEFINE_string(method, "quatro", "Method; see --list_methods");
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
DEFINE_string(refine,
              "none",
              "Refine the pose by local registration: none, icp, gicp or "
              "vgicp");
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
DEFINE_double(voxel_size, 0.0, "Voxel size [m]; 0: the preset's");
DEFINE_double(normal_radius, 0.0, "Radius of the normals [m]; 0: the preset's");
DEFINE_double(fpfh_radius,
              0.0,
              "Radius of the descriptors [m]; 0: the preset's");
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
DEFINE_string(output,
              "",
              "File for the source in the target's frame: .bin, .ply or .pcd; "
              "written only if there is a pose");
DEFINE_string(output_clouds,
              "source",
              "What --output gets: source, or both; intensity is then 0 for "
              "the source and 1 for the target");
DEFINE_string(picture, "", "PNG file for both clouds before and after");
DEFINE_string(report,
              "",
              "HTML file for an interactive page: both clouds in 3D, and the "
              "matches stage by stage");
DEFINE_string(correspondences_out,
              "",
              "CSV file for the matches, as input of quatro_solve");

namespace {

quatro::RegistrationFlags GivenFlags() {
  return {FLAGS_method,
          FLAGS_recover,
          FLAGS_polish,
          FLAGS_refine,
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

// The report's header: what the answer depends on.
quatro::Manifest ManifestOf(const quatro::Json& report) {
  quatro::Manifest manifest = quatro::BeginManifest();
  manifest.seed = FLAGS_seed;
  manifest.flags["method"] = FLAGS_method;
  for (const auto& [name, value] : report["parameters"].items()) {
    manifest.flags[name] =
        value.is_string() ? value.get<std::string>() : value.dump();
  }
  return manifest;
}

// "a.bin onto b.bin"
std::string PairName() {
  return std::filesystem::path(FLAGS_source).filename().string() + " onto " +
         std::filesystem::path(FLAGS_target).filename().string();
}

constexpr char kUsage[] =
    "finds the pose between two scans of one place, far apart or not.\n"
    "\n"
    "  quatro_register --source=a.bin --target=b.bin --picture=ab.png\n"
    "\n"
    "The answer is JSON; target_from_source moves points of the source onto "
    "the\n"
    "target. Progress goes to standard error.\n"
    "Exits with 0 if registered; 1 if an answer can't be vouched for (the "
    "JSON\n"
    "says why); 2 if a flag or a file is invalid (nothing is written then).";

// The options that the flags ask for, but for those that --preset=auto takes
// from the clouds.
std::optional<quatro::RegistrationOptions> OptionsFromFlags(
    const quatro::PointCloud& source,
    const quatro::PointCloud& target,
    std::string* error) {
  auto options = FLAGS_preset == "auto"
                     ? quatro::MakeAutoOptions(source, target)
                     : quatro::MakePreset(FLAGS_preset);
  if (!options) {
    *error = "--preset=" + FLAGS_preset + ", must be auto";
    for (const std::string& name : quatro::PresetNames()) *error += ", " + name;
    return std::nullopt;
  }
  const auto override_with = [](double flag, double* value) {
    if (flag != 0.0) *value = flag;
  };
  override_with(FLAGS_voxel_size, &options->front_end.voxel_size);
  override_with(FLAGS_normal_radius, &options->front_end.normal_radius);
  override_with(FLAGS_fpfh_radius, &options->front_end.fpfh_radius);
  if (!quatro::ApplyFlags(GivenFlags(), true, &*options, error)) {
    return std::nullopt;
  }
  return options;
}

int Main(int argc, char** argv) {
  using quatro::Fail;
  if (const auto exit_code =
          quatro::ParseFlags(kUsage, "register_main", argc, argv)) {
    return *exit_code;
  }
  if (FLAGS_list_methods) {
    std::fputs(quatro::DescribeMethods().c_str(), stdout);
    return quatro::kExitDone;
  }
  std::string error;
  if (FLAGS_list_options) {
    const std::string text =
        quatro::DescribeOptionsOf(FLAGS_method, /*has_clouds=*/true, &error);
    if (text.empty()) return Fail(error);
    std::fputs(text.c_str(), stdout);
    return quatro::kExitDone;
  }
  if (FLAGS_source.empty()) return Fail("--source is empty, must name a cloud");
  if (FLAGS_target.empty()) return Fail("--target is empty, must name a cloud");
  // What can be found wrong at once is found before the work is done.
  const quatro::AlignedOutput aligned{FLAGS_output, FLAGS_output_clouds};
  if (!aligned.IsValid(&error)) return Fail(error);
  if (!quatro::CanWriteAll(
          {{"json", quatro::JsonPath(FLAGS_json, FLAGS_explain)},
           {"explain", FLAGS_explain ? "-" : ""},
           {"picture", FLAGS_picture},
           {"report", FLAGS_report},
           {"correspondences_out", FLAGS_correspondences_out},
           {"output", FLAGS_output}},
          {FLAGS_source, FLAGS_target},
          &error)) {
    return Fail(error);
  }
  if (!quatro::HasEnding({"picture", FLAGS_picture}, ".png", &error) ||
      !quatro::HasEnding({"report", FLAGS_report}, ".html", &error)) {
    return Fail(error);
  }
  if (!FLAGS_picture.empty() && !quatro::CanDrawPictures(&error)) {
    return Fail(error);
  }
  std::optional<std::string> report_template;
  if (!FLAGS_report.empty()) {
    report_template = quatro::ReadReportTemplate(&error);
    if (!report_template) return Fail("--report: " + error);
  }
  if (!OptionsFromFlags({}, {}, &error)) return Fail(error);

  const quatro::ReadCloudOptions reading = {FLAGS_point_floats};
  if (!reading.IsValid(&error)) return Fail(error);
  const auto source = quatro::ReadCloud(FLAGS_source, reading, &error);
  if (!source) return Fail(error);
  const auto target = quatro::ReadCloud(FLAGS_target, reading, &error);
  if (!target) return Fail(error);
  auto options = OptionsFromFlags(*source, *target, &error);
  if (!options) return Fail(error);
  options->progress = [](const quatro::StageTime& time) {
    std::fprintf(
        stderr, "%-12s %9.1f ms\n", time.stage.c_str(), time.seconds * 1e3);
  };

  const quatro::RegistrationSummary summary =
      quatro::FindPairSolver(FLAGS_method, {}, &error)(
          *source, *target, /*matched=*/nullptr, *options);
  if (!summary.error.empty()) return Fail(summary.error);

  quatro::Json report = quatro::MakeReport(FLAGS_method,
                                           summary.verdict,
                                           summary.solution,
                                           summary.stage_times,
                                           summary.total_seconds);
  report["counts"].update(
      quatro::Json{{"source_points", source->points.cols()},
                   {"source_dropped", source->num_dropped},
                   {"source_voxels", summary.num_source_voxels},
                   {"target_points", target->points.cols()},
                   {"target_dropped", target->num_dropped},
                   {"target_voxels", summary.num_target_voxels}});
  if (!quatro::StartsFromGuess(FLAGS_method)) {
    report["counts"]["mutual_matches"] = summary.num_mutual_matches;
    report["rung"] = summary.rung;
    report["scale_factor"] = summary.scale_factor;
    report["candidates"] = quatro::DescribeCandidates(summary.candidates);
  }
  report["surface_observability"] =
      quatro::Describe(summary.surface_observability);
  report["refinement"] = quatro::DescribeRefinement(summary.refinement);
  report["parameters"] = {{"source", FLAGS_source},
                          {"target", FLAGS_target},
                          {"preset", FLAGS_preset}};
  report["parameters"].update(quatro::DescribeOptions(options->front_end));
  report["parameters"].update(
      quatro::DescribeOptions(quatro::WithSharedValues(*options).quatro));
  report["parameters"].update(quatro::DescribeOptions(options->ins));
  report["parameters"].update(quatro::DescribeOptions(options->bounds));
  report["version"] = quatro::Version();
  std::fprintf(stderr,
               "%-12s %9.1f ms\n%s: %s\n",
               "total",
               summary.total_seconds * 1e3,
               quatro::StatusName(summary.verdict.status),
               summary.verdict.reason.c_str());
  std::error_code ignored;
  if (std::filesystem::equivalent(FLAGS_source, FLAGS_target, ignored)) {
    std::fprintf(stderr, "source and target are the same file\n");
  }

  std::vector<quatro::OutputFile> files;
  if (!FLAGS_correspondences_out.empty()) {
    files.push_back({FLAGS_correspondences_out,
                     quatro::FormatMatches(summary.matched_source,
                                           summary.matched_target)});
  }
  if (!FLAGS_output.empty() && summary.target_from_source()) {
    const auto bytes =
        aligned.Format(*source, *target, *summary.target_from_source(), &error);
    if (!bytes) return Fail(error);
    files.push_back({FLAGS_output, *bytes});
  } else if (!FLAGS_output.empty()) {
    std::fprintf(stderr,
                 "%s: not written, because there is no pose\n",
                 FLAGS_output.c_str());
  }
  if (!FLAGS_picture.empty()) {
    const auto picture = quatro::DrawRegistration(
        {source->points,
         target->points,
         summary.matched_source,
         summary.matched_target,
         summary.solution.translation_inliers,
         summary.target_from_source(),
         std::string(quatro::StatusName(summary.verdict.status)) + ": " +
             summary.verdict.reason},
        &error);
    if (!picture) return Fail(error);
    files.push_back({FLAGS_picture, *picture});
  }
  if (report_template) {
    files.push_back({FLAGS_report,
                     quatro::FormatPairReport({PairName(),
                                               FLAGS_source,
                                               FLAGS_target,
                                               source->points,
                                               target->points,
                                               std::nullopt,
                                               options->noise_bound},
                                              options->front_end.voxel_size,
                                              {FLAGS_method, summary},
                                              ManifestOf(report),
                                              *report_template)});
  }
  const std::string json_path = quatro::JsonPath(FLAGS_json, FLAGS_explain);
  if (!json_path.empty()) files.push_back({json_path, report.dump(2) + "\n"});
  if (FLAGS_explain) files.push_back({"", quatro::Explain(report)});
  if (!quatro::WriteOutputs(files, &error)) return Fail(error);
  return summary.verdict.IsRegistered() ? quatro::kExitDone
                                        : quatro::kExitNotVouchedFor;
}

}  // namespace

int main(int argc, char** argv) { return quatro::RunProgram(Main, argc, argv); }
