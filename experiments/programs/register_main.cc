// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "experiments/base/one_line.h"
#include "experiments/base/outputs.h"
#include "experiments/programs/aligned_clouds.h"
#include "experiments/programs/flag_problems.h"
#include "experiments/programs/json_report.h"
#include "experiments/programs/matches_csv.h"
#include "experiments/programs/methods.h"
#include "experiments/programs/options_json.h"
#include "experiments/programs/program.h"
#include "experiments/programs/registration_flags.h"
#include "experiments/report/pair_report.h"
#include "experiments/report/report_template.h"
#include "experiments/runner/manifest.h"
#include "features/io/cloud_format.h"
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
              "auto",
              "auto (all lengths from the clouds themselves), kitti (64 beams "
              "outdoors), paper or reference (as published), or indoor (16 "
              "beams)");
DEFINE_string(method, "quatro", "Method; see --list_methods");
DEFINE_string(refine,
              "",
              "Refine the pose by local registration: none, icp, gicp or "
              "vgicp; empty: the preset's");
DEFINE_double(voxel_size, 0.0, "Voxel size [m]; 0: the preset's");
DEFINE_double(normal_radius, 0.0, "Radius of the normals [m]; 0: the preset's");
DEFINE_double(fpfh_radius,
              0.0,
              "Radius of the descriptors [m]; 0: the preset's");
DEFINE_string(output,
              "",
              "File for the source in the target's frame: .bin, .ply or .pcd; "
              "written only if there is a pose");
DEFINE_string(output_clouds,
              "source",
              "What --output gets: source, or both; intensity is then 0 for "
              "the source and 1 for the target");
DEFINE_string(report,
              "",
              "HTML file for an interactive page: both clouds in 3D, and the "
              "matches stage by stage");
DEFINE_string(correspondences_out,
              "",
              "CSV file for the matches, as input of quatro_solve");

namespace {

// The report's header: the inputs on which the answer depends.
quatro::Manifest ManifestOf(const quatro::Json& report) {
  quatro::Manifest manifest = quatro::BeginManifest();
  manifest.seed = FLAGS_seed;
  manifest.flags["method"] = FLAGS_method;
  for (const auto& [name, value] : report["parameters"].items()) {
    manifest.flags[name] =
        value.is_string()
            ? value.get<std::string>()
            : value.dump(
                  -1, ' ', false, quatro::Json::error_handler_t::replace);
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

// The options by the flags, except for those that --preset=auto computes from
// the clouds.
std::optional<quatro::RegistrationOptions> OptionsFromFlags(
    const quatro::PointCloud& source,
    const quatro::PointCloud& target,
    std::string* error) {
  std::optional<quatro::RegistrationOptions> options;
  if (FLAGS_preset != "auto") {
    options = quatro::MakePreset(FLAGS_preset);
  } else if (FLAGS_voxel_size > 0.0 && std::isfinite(FLAGS_voxel_size)) {
    options = quatro::MakeAutoOptions(FLAGS_voxel_size);
  } else {
    options = quatro::MakeAutoOptions(source, target);
  }
  if (!options) {
    *error = quatro::UnknownPreset(FLAGS_preset, /*has_auto=*/true);
    return std::nullopt;
  }
  const auto override_with = [](double flag, double* value) {
    if (flag != 0.0) *value = flag;
  };
  override_with(FLAGS_voxel_size, &options->front_end.voxel_size);
  override_with(FLAGS_normal_radius, &options->front_end.normal_radius);
  override_with(FLAGS_fpfh_radius, &options->front_end.fpfh_radius);
  if (!quatro::ApplyFlags(FLAGS_method,
                          FLAGS_refine,
                          /*has_clouds=*/true,
                          &*options,
                          error)) {
    return std::nullopt;
  }
  return options;
}

// Whether all flags can be used, as far as this is known before the clouds are
// read.
bool CheckFlags(const quatro::AlignedOutput& aligned, std::string* error) {
  const std::vector<quatro::OutputFlag> outputs = {
      {"report", FLAGS_report},
      {"correspondences_out", FLAGS_correspondences_out},
      {"output", FLAGS_output}};
  return aligned.IsValid(error) &&
         quatro::CanWriteAnswer(outputs, {FLAGS_source, FLAGS_target}, error) &&
         quatro::HasEnding(outputs[0], ".html", error) &&
         OptionsFromFlags({}, {}, error).has_value();
}

// The clouds, and the pose between them.
struct Registered {
  quatro::PointCloud source;
  quatro::PointCloud target;
  quatro::RegistrationOptions options;
  quatro::RegistrationSummary summary;
};

// Reads the clouds and registers them. Returns nullopt and sets *error if the
// input cannot be used.
std::optional<Registered> ReadAndRegister(std::string* error) {
  const quatro::ReadCloudOptions reading = {FLAGS_point_floats};
  if (!reading.IsValid(error)) return std::nullopt;
  const auto is_bin = [](const std::string& path) {
    const auto type = quatro::FindCloudFileType(path);
    return type && type->format == quatro::CloudFormat::kBin;
  };
  if (FLAGS_point_floats != 0 && !is_bin(FLAGS_source) &&
      !is_bin(FLAGS_target)) {
    *error = "point_floats: is for .bin alone, and neither cloud is one";
    return std::nullopt;
  }
  auto source = quatro::ReadCloud(FLAGS_source, reading, error);
  if (!source) return std::nullopt;
  auto target = quatro::ReadCloud(FLAGS_target, reading, error);
  if (!target) return std::nullopt;
  auto options = OptionsFromFlags(*source, *target, error);
  if (!options) return std::nullopt;
  options->progress = [](const quatro::StageTime& time) {
    std::fprintf(
        stderr, "%-12s %9.1f ms\n", time.stage.c_str(), time.seconds * 1e3);
  };
  auto summary = quatro::FindPairSolver(FLAGS_method, {}, error)(
      *source, *target, /*matched=*/nullptr, *options);
  if (!summary.error.empty()) {
    *error = summary.error;
    return std::nullopt;
  }
  return Registered{std::move(*source),
                    std::move(*target),
                    std::move(*options),
                    std::move(summary)};
}

// The JSON report: the answer, its inputs and its options.
quatro::Json MakeReportOf(const Registered& registered) {
  const quatro::RegistrationSummary& summary = registered.summary;
  quatro::Json report = quatro::MakeReport(FLAGS_method,
                                           summary.verdict,
                                           summary.solution,
                                           summary.stage_times,
                                           summary.total_seconds);
  report["counts"].update(
      quatro::Json{{"source_points", registered.source.points.cols()},
                   {"source_dropped", registered.source.num_dropped},
                   {"source_voxels", summary.num_source_voxels},
                   {"target_points", registered.target.points.cols()},
                   {"target_dropped", registered.target.num_dropped},
                   {"target_voxels", summary.num_target_voxels}});
  if (!quatro::StartsFromGuess(FLAGS_method)) {
    report["counts"]["mutual_matches"] = summary.num_mutual_matches;
    report["rung"] = summary.rung;
    report["scale_factor"] = summary.scale_factor;
    report["leveled_by"] = summary.leveled_by;
    report["candidates"] = quatro::DescribeCandidates(summary.candidates);
  }
  report["surface_observability"] =
      quatro::Describe(summary.surface_observability);
  report["error_radius"] = quatro::DescribeRadius(summary.error_radius);
  report["refinement"] = quatro::DescribeRefinement(summary.refinement);
  report["parameters"] = {{"source", FLAGS_source},
                          {"target", FLAGS_target},
                          {"preset", FLAGS_preset}};
  report["parameters"].update(quatro::DescribeOptions(
      FLAGS_method, /*has_clouds=*/true, registered.options));
  report["version"] = quatro::Version();
  return report;
}

// The longest side of the cloud's box [m].
double Extent(const quatro::PointCloud& cloud) {
  return (cloud.points.rowwise().maxCoeff() - cloud.points.rowwise().minCoeff())
      .maxCoeff();
}

// Prints a hint if one cloud is so much wider than the other that their units
// probably differ.
void HintAtUnits(const quatro::PointCloud& source,
                 const quatro::PointCloud& target) {
  constexpr double kMinFactor = 50.0;
  const auto [narrow, wide] = std::minmax({Extent(source), Extent(target)});
  if (!(narrow > 0.0 && wide >= kMinFactor * narrow)) return;
  std::fprintf(stderr,
               "the clouds are %.6g m and %.6g m wide, a factor of %.0f: their "
               "units may differ; convert both to meters, or remove stray "
               "points\n",
               Extent(source),
               Extent(target),
               wide / narrow);
}

void PrintSummary(const Registered& registered) {
  const quatro::RegistrationSummary& summary = registered.summary;
  std::fprintf(stderr,
               "%-12s %9.1f ms\n%s\n",
               "total",
               summary.total_seconds * 1e3,
               quatro::VerdictLine(summary.verdict).c_str());
  std::error_code ignored;
  if (std::filesystem::equivalent(FLAGS_source, FLAGS_target, ignored)) {
    std::fprintf(stderr, "source and target are the same file\n");
  }
  if (!summary.verdict.IsRegistered()) {
    HintAtUnits(registered.source, registered.target);
  }
  if (!FLAGS_output.empty() && !summary.target_from_source()) {
    std::fprintf(stderr,
                 "%s: not written, because there is no pose\n",
                 quatro::OneLine(FLAGS_output).c_str());
  }
}

// The files that only this program writes.
std::optional<std::vector<quatro::OutputFile>> MakeFiles(
    const Registered& registered,
    const quatro::AlignedOutput& aligned,
    const std::optional<std::string>& report_template,
    const quatro::Json& report,
    std::string* error) {
  const auto& [source, target, options, summary] = registered;
  std::vector<quatro::OutputFile> files;
  if (!FLAGS_correspondences_out.empty()) {
    files.push_back({FLAGS_correspondences_out,
                     quatro::FormatMatches(summary.matched_source,
                                           summary.matched_target)});
  }
  if (!FLAGS_output.empty() && summary.target_from_source()) {
    const auto bytes =
        aligned.Format(source, target, *summary.target_from_source(), error);
    if (!bytes) return std::nullopt;
    files.push_back({FLAGS_output, *bytes});
  }
  if (report_template) {
    files.push_back({FLAGS_report,
                     quatro::FormatPairReport({PairName(),
                                               FLAGS_source,
                                               FLAGS_target,
                                               source.points,
                                               target.points,
                                               std::nullopt,
                                               options.noise_bound},
                                              options.front_end.voxel_size,
                                              {FLAGS_method, summary},
                                              ManifestOf(report),
                                              *report_template)});
  }
  return files;
}

int Main(int argc, char** argv) {
  using quatro::Fail;
  if (const auto exit_code = quatro::ParseFlags(kUsage, argc, argv)) {
    return *exit_code;
  }
  if (const auto exit_code =
          quatro::PrintLists(FLAGS_method, /*has_clouds=*/true)) {
    return *exit_code;
  }
  if (FLAGS_source.empty()) return Fail("--source is empty, must name a cloud");
  if (FLAGS_target.empty()) return Fail("--target is empty, must name a cloud");
  const quatro::AlignedOutput aligned{FLAGS_output, FLAGS_output_clouds};
  std::string error;
  if (!CheckFlags(aligned, &error)) return Fail(error);
  std::optional<std::string> report_template;
  if (!FLAGS_report.empty()) {
    report_template = quatro::ReadReportTemplate(&error);
    if (!report_template) return Fail("--report: " + error);
  }
  const auto registered = ReadAndRegister(&error);
  if (!registered) return Fail(error);
  const quatro::RegistrationSummary& summary = registered->summary;
  PrintSummary(*registered);
  const quatro::Json report = MakeReportOf(*registered);
  auto files = MakeFiles(*registered, aligned, report_template, report, &error);
  if (!files) return Fail(error);
  return quatro::WriteAnswer(report,
                             {registered->source.points,
                              registered->target.points,
                              summary.matched_source,
                              summary.matched_target,
                              summary.solution.translation_inliers,
                              summary.target_from_source(),
                              quatro::VerdictLine(summary.verdict)},
                             summary.verdict,
                             std::move(*files));
}

}  // namespace

int main(int argc, char** argv) { return quatro::RunProgram(Main, argc, argv); }
