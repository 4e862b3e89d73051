// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gflags/gflags.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/one_line.h"
#include "experiments/base/outputs.h"
#include "experiments/base/progress_line.h"
#include "experiments/datasets/kitti_poses.h"
#include "experiments/datasets/sequence.h"
#include "experiments/metrics/kitti_metrics.h"
#include "experiments/odometry/odometry_methods.h"
#include "experiments/odometry/outside_drift.h"
#include "experiments/odometry/table_two.h"
#include "experiments/programs/bad_flag.h"
#include "experiments/programs/flag_problems.h"
#include "experiments/programs/program.h"

DEFINE_string(input,
              "",
              "Folder of a drive in KITTI's layout, or of its scans: .bin, "
              ".ply, .pcd or .npy, also with .gz, named by frame number. "
              "Required");
DEFINE_string(method, "aloam", "See --list_methods");
DEFINE_bool(list_methods, false, "Tell the methods and stop");
DEFINE_int32(point_floats,
             0,
             "Numbers of a point of a .bin: x, y, z, the intensity, others; 0: "
             "told by the file");
DEFINE_int32(interval, 1, "Every how many frames");
DEFINE_int32(first_frame, -1, "The frame to start at; -1: of the first file");
DEFINE_int32(last_frame,
             -1,
             "Last frame; -1 or too large: that of the last file");
DEFINE_string(preset, "kitti", "Preset of the scan-to-scan methods");
DEFINE_string(output, "", "Output file with KITTI poses, one line per frame");
DEFINE_string(calib,
              "",
              "calib.txt whose Tr moves the poses into cam0; empty: that of "
              "--input, if there is one; otherwise poses of the lidar");
DEFINE_string(truth,
              "",
              "poses.txt for measuring the drift, with a line for every frame "
              "of the drive; empty: that of --input, if there is one");
DEFINE_string(outside,
              "",
              "Rows of other programs for the table: NAME=POSES,... where "
              "POSES is a file of KITTI poses for the same or for all frames");
DEFINE_bool(quoted,
            false,
            "Add the paper's rows to the table, marked as quoted");
DEFINE_string(table, "", "CSV file for the table as well");
DEFINE_int32(threads, 0, "Threads; 0: one per core. Does not affect the poses");

namespace {

constexpr char kUsage[] =
    "estimates the path of a lidar from its scans.\n"
    "\n"
    "  quatro_odometry --input=drive --method=suma --output=poses.txt\n"
    "\n"
    "If true poses are available, prints the drift as defined by KITTI, t_rel\n"
    "[%] and r_rel [deg/100 m]. A missing or unreadable scan, or one that\n"
    "cannot be registered, is reported on standard error and counted, and its\n"
    "pose is extrapolated at constant velocity. Exits with 0; 1 if more than\n"
    "half of the scans were lost; 2 if a flag or a file is invalid.";

// Returns `given`, or `folder`/`name` if this file exists, or an empty string.
std::string FileOrDefault(const std::string& given,
                          const std::string& folder,
                          const std::string& name) {
  if (!given.empty()) return given;
  const auto path = std::filesystem::path(folder) / name;
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored) ? path.string() : "";
}

void TellLostScans(const quatro::OdometryRun& run) {
  for (std::size_t i = 0; i < run.steps.size(); ++i) {
    if (run.steps[i].status != quatro::OdometryStatus::kLost) continue;
    std::fprintf(
        stderr,
        "frame %d lost: %s\n",
        run.frames[i],
        quatro::SpellAsFlags(quatro::OneLine(run.steps[i].message)).c_str());
  }
}

void PrintSummary(std::FILE* out, const quatro::OdometryRun& run) {
  std::fprintf(out,
               "%zu scans, %d lost (%d unreadable), %.0f ms a scan\n",
               run.steps.size(),
               run.num_lost,
               run.num_unreadable,
               1e3 * run.MedianSeconds());
}

void PrintDrift(std::FILE* out, const quatro::KittiDrift& drift) {
  std::fprintf(out,
               "path %.1f m, %.3f m and %.3f deg off at its end\n",
               drift.path_length,
               drift.end_translation_error,
               drift.end_rotation_error * 180.0 / M_PI);
  if (drift.segments.empty()) {
    std::fprintf(out, "no segment of 100 m: no t_rel and r_rel\n");
  } else {
    std::fprintf(out,
                 "t_rel %.3f %%, r_rel %.3f deg/100 m over %zu segments\n",
                 drift.translation_percent,
                 drift.rotation_deg_per_100m,
                 drift.segments.size());
  }
}

quatro::SequenceOptions SequenceFromFlags() {
  quatro::SequenceOptions options;
  options.interval = FLAGS_interval;
  options.first_frame = FLAGS_first_frame;
  options.last_frame = FLAGS_last_frame;
  options.reading.point_floats = FLAGS_point_floats;
  return options;
}

// All inputs. They are read before a run that may take hours.
struct Inputs {
  std::unique_ptr<quatro::Odometry> odometry;
  quatro::SequenceOptions options;
  std::map<int, std::string> scans;  // By frame.
  std::optional<quatro::Rigid3> cam0_from_lidar;
  std::optional<std::vector<quatro::Rigid3>> truth;
  std::vector<quatro::OutsideResult> outside;
  std::vector<quatro::DriftEntry> outside_entries;
  std::vector<std::string> paths;  // All files that are read.
};

// Reads the calibration and the true poses, if there are any.
bool ReadPoseFiles(const std::string& calib,
                   const std::string& truth_path,
                   Inputs* inputs,
                   std::string* error) {
  if (!calib.empty()) {
    inputs->cam0_from_lidar = quatro::ReadKittiCalibration(calib, error);
    if (!inputs->cam0_from_lidar) return false;
  }
  if (!truth_path.empty()) {
    inputs->truth = quatro::ReadKittiPoses(truth_path, error);
    if (!inputs->truth) return false;
  }
  if (inputs->truth ||
      (inputs->outside.empty() && !FLAGS_quoted && FLAGS_table.empty())) {
    return true;
  }
  *error =
      "--outside, --quoted and --table need true poses: name a poses.txt by "
      "--truth, because " +
      FLAGS_input + " has none";
  return false;
}

// Computes the drift of the poses that --outside names.
bool MeasureOutside(const std::string& truth_path,
                    Inputs* inputs,
                    std::string* error) {
  const auto frames = quatro::FramesOf(inputs->scans, inputs->options, error);
  if (!frames) return false;
  if (!inputs->truth) return true;
  if (!quatro::SelectFrames(*inputs->truth, *frames, error)) {
    *error = truth_path + ": " + *error;
    return false;
  }
  for (const quatro::OutsideResult& result : inputs->outside) {
    const auto entry = quatro::DriftOfPoseFile(result.method,
                                               FLAGS_interval,
                                               result.path,
                                               *inputs->truth,
                                               *frames,
                                               error);
    if (!entry) return false;
    inputs->outside_entries.push_back(*entry);
  }
  return true;
}

std::optional<Inputs> ReadInputs(std::string* error) {
  if (FLAGS_input.empty()) {
    *error = "--input is empty, must name a folder";
    return std::nullopt;
  }
  if (FLAGS_threads < 0) {
    *error =
        quatro::FlagProblem("threads", FLAGS_threads, ">= 0; 0: one per core");
    return std::nullopt;
  }
  auto registration = quatro::FindPreset(FLAGS_preset, error);
  if (!registration) return std::nullopt;
  registration->num_threads = FLAGS_threads;
  Inputs inputs;
  inputs.odometry = quatro::MakeOdometry(FLAGS_method, *registration, error);
  if (!inputs.odometry) return std::nullopt;
  inputs.options = SequenceFromFlags();
  if (!inputs.options.IsValid(error)) return std::nullopt;
  const auto outside = quatro::ParseOutside(FLAGS_outside, error);
  if (!outside) return std::nullopt;
  inputs.outside = *outside;
  const auto scans = quatro::ListScans(FLAGS_input, error);
  if (!scans) return std::nullopt;
  inputs.scans = *scans;
  const std::string calib =
      FileOrDefault(FLAGS_calib, FLAGS_input, "calib.txt");
  const std::string truth =
      FileOrDefault(FLAGS_truth, FLAGS_input, "poses.txt");
  if (!ReadPoseFiles(calib, truth, &inputs, error) ||
      !MeasureOutside(truth, &inputs, error)) {
    return std::nullopt;
  }
  inputs.paths = {calib, truth};
  for (const auto& [frame, path] : inputs.scans) inputs.paths.push_back(path);
  for (const auto& result : inputs.outside) {
    inputs.paths.push_back(result.path);
  }
  return inputs;
}

// Prints the drift, and the table if there are rows of others. Returns nullopt
// and sets *error if there is no drift to compute.
std::optional<quatro::Table> PrintTable(
    std::FILE* out,
    const Inputs& inputs,
    const quatro::OdometryRun& run,
    const std::vector<quatro::Rigid3>& poses,
    std::string* error) {
  const auto drift = quatro::ComputeKittiDrift(
      *quatro::SelectFrames(*inputs.truth, run.frames, error),
      poses,
      {},
      error);
  if (!drift) return std::nullopt;
  PrintDrift(out, *drift);
  std::vector<quatro::DriftEntry> entries = {
      quatro::MeasuredEntry(FLAGS_method, FLAGS_interval, run, *drift)};
  entries.insert(entries.end(),
                 inputs.outside_entries.begin(),
                 inputs.outside_entries.end());
  if (FLAGS_quoted) {
    const auto quoted = quatro::QuotedTableTwo();
    entries.insert(entries.end(), quoted.begin(), quoted.end());
  }
  quatro::Table table = quatro::MakeTableTwo(entries);
  if (FLAGS_quoted || !inputs.outside.empty()) {
    std::fputs(quatro::FormatTable(table).c_str(), out);
  }
  return table;
}

int Main(int argc, char** argv) {
  using quatro::Fail;
  if (const auto exit_code = quatro::ParseFlags(kUsage, argc, argv)) {
    return *exit_code;
  }
  if (FLAGS_list_methods) {
    std::fputs(quatro::DescribeOdometries().c_str(), stdout);
    return quatro::kExitDone;
  }
  std::string error;
  const auto inputs = ReadInputs(&error);
  if (!inputs ||
      !quatro::CanWriteAll({{"output", FLAGS_output}, {"table", FLAGS_table}},
                           inputs->paths,
                           &error)) {
    return Fail(error);
  }

  const auto run = quatro::RunOdometry(inputs->scans,
                                       inputs->options,
                                       inputs->odometry.get(),
                                       quatro::ProgressLine("scans"),
                                       &error);
  if (!run) return Fail(error);
  TellLostScans(*run);
  std::FILE* const out = quatro::SummaryStream({FLAGS_output, FLAGS_table});
  PrintSummary(out, *run);
  const std::vector<quatro::Rigid3> poses =
      inputs->cam0_from_lidar
          ? quatro::MoveToCam0(run->Poses(), *inputs->cam0_from_lidar)
          : run->Poses();
  std::vector<quatro::OutputFile> files;
  if (!FLAGS_output.empty()) {
    files.push_back({FLAGS_output, quatro::FormatKittiPoses(poses)});
  }
  if (inputs->truth) {
    const auto table = PrintTable(out, *inputs, *run, poses, &error);
    if (!table) return Fail(error);
    if (!FLAGS_table.empty()) {
      files.push_back({FLAGS_table, quatro::FormatCsv(*table)});
    }
  }
  if (!quatro::WriteOutputs(files, &error)) return Fail(error);
  return 2 * run->num_lost > static_cast<int>(run->steps.size())
             ? quatro::kExitNotVouchedFor
             : quatro::kExitDone;
}

}  // namespace

int main(int argc, char** argv) { return quatro::RunProgram(Main, argc, argv); }
