// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gflags/gflags.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/outputs.h"
#include "experiments/datasets/kitti_poses.h"
#include "experiments/datasets/sequence.h"
#include "experiments/metrics/kitti_metrics.h"
#include "experiments/odometry/odometry_methods.h"
#include "experiments/odometry/outside_drift.h"
#include "experiments/odometry/table_two.h"
#include "experiments/programs/flag_problems.h"
#include "experiments/programs/program.h"
#include "experiments/programs/progress_line.h"

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
    std::fprintf(stderr,
                 "frame %d lost: %s\n",
                 run.frames[i],
                 run.steps[i].message.c_str());
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

int Main(int argc, char** argv) {
  using quatro::Fail;
  if (const auto exit_code =
          quatro::ParseFlags(kUsage, "odometry_main", argc, argv)) {
    return *exit_code;
  }
  if (FLAGS_list_methods) {
    std::fputs(quatro::DescribeOdometries().c_str(), stdout);
    return quatro::kExitDone;
  }
  std::string error;
  if (FLAGS_input.empty()) return Fail("--input is empty, must name a folder");
  if (FLAGS_threads < 0) {
    return Fail(
        quatro::FlagProblem("threads", FLAGS_threads, ">= 0; 0: one per core"));
  }
  auto registration = quatro::FindPreset(FLAGS_preset, &error);
  if (!registration) return Fail(error);
  registration->num_threads = FLAGS_threads;
  const auto odometry =
      quatro::MakeOdometry(FLAGS_method, *registration, &error);
  if (!odometry) return Fail(error);
  quatro::SequenceOptions options;
  options.interval = FLAGS_interval;
  options.first_frame = FLAGS_first_frame;
  options.last_frame = FLAGS_last_frame;
  options.reading.point_floats = FLAGS_point_floats;
  if (!options.IsValid(&error)) return Fail(error);
  const auto outside = quatro::ParseOutside(FLAGS_outside, &error);
  if (!outside) return Fail(error);

  // Reads all inputs before a run that may take hours.
  const auto scans = quatro::ListScans(FLAGS_input, &error);
  if (!scans) return Fail(error);
  const std::string calib =
      FileOrDefault(FLAGS_calib, FLAGS_input, "calib.txt");
  std::optional<quatro::Rigid3> cam0_from_lidar;
  if (!calib.empty()) {
    cam0_from_lidar = quatro::ReadKittiCalibration(calib, &error);
    if (!cam0_from_lidar) return Fail(error);
  }
  const std::string truth_path =
      FileOrDefault(FLAGS_truth, FLAGS_input, "poses.txt");
  std::optional<std::vector<quatro::Rigid3>> truth;
  if (!truth_path.empty()) {
    truth = quatro::ReadKittiPoses(truth_path, &error);
    if (!truth) return Fail(error);
  }
  if (!truth && (!outside->empty() || FLAGS_quoted || !FLAGS_table.empty())) {
    return Fail(
        "--outside, --quoted and --table need true poses: name a poses.txt by "
        "--truth, because " +
        FLAGS_input + " has none");
  }
  const auto frames = quatro::FramesOf(*scans, options, &error);
  if (!frames) return Fail(error);
  std::vector<quatro::DriftEntry> entries;
  if (truth) {
    if (!quatro::SelectFrames(*truth, *frames, &error)) {
      return Fail(truth_path + ": " + error);
    }
    for (const quatro::OutsideResult& result : *outside) {
      const auto entry = quatro::DriftOfPoseFile(
          result.method, FLAGS_interval, result.path, *truth, *frames, &error);
      if (!entry) return Fail(error);
      entries.push_back(*entry);
    }
  }
  std::vector<std::string> inputs = {calib, truth_path};
  for (const auto& [frame, path] : *scans) inputs.push_back(path);
  for (const auto& result : *outside) inputs.push_back(result.path);
  if (!quatro::CanWriteAll(
          {{"output", FLAGS_output}, {"table", FLAGS_table}}, inputs, &error)) {
    return Fail(error);
  }

  const auto run = quatro::RunOdometry(
      *scans, options, odometry.get(), quatro::ProgressLine("scans"), &error);
  if (!run) return Fail(error);
  TellLostScans(*run);
  std::FILE* const out = quatro::SummaryStream({FLAGS_output, FLAGS_table});
  PrintSummary(out, *run);
  const std::vector<quatro::Rigid3> poses =
      cam0_from_lidar ? quatro::MoveToCam0(run->Poses(), *cam0_from_lidar)
                      : run->Poses();
  std::vector<quatro::OutputFile> files;
  if (!FLAGS_output.empty()) {
    files.push_back({FLAGS_output, quatro::FormatKittiPoses(poses)});
  }
  if (truth) {
    const auto drift = quatro::ComputeKittiDrift(
        *quatro::SelectFrames(*truth, run->frames, &error), poses, {}, &error);
    if (!drift) return Fail(error);
    PrintDrift(out, *drift);
    entries.insert(
        entries.begin(),
        quatro::MeasuredEntry(FLAGS_method, FLAGS_interval, *run, *drift));
    if (FLAGS_quoted) {
      const auto quoted = quatro::QuotedTableTwo();
      entries.insert(entries.end(), quoted.begin(), quoted.end());
    }
    const quatro::Table table = quatro::MakeTableTwo(entries);
    if (FLAGS_quoted || !outside->empty()) {
      std::fputs(quatro::FormatTable(table).c_str(), out);
    }
    if (!FLAGS_table.empty()) {
      files.push_back({FLAGS_table, quatro::FormatCsv(table)});
    }
  }
  if (!quatro::WriteOutputs(files, &error)) return Fail(error);
  return 2 * run->num_lost > static_cast<int>(run->steps.size())
             ? quatro::kExitNotVouchedFor
             : quatro::kExitDone;
}

}  // namespace

int main(int argc, char** argv) { return quatro::RunProgram(Main, argc, argv); }
