// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/experiment_program.h"

#include <gflags/gflags.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/open_dataset.h"
#include "experiments/gnc_film.h"
#include "experiments/ins_flags.h"
#include "experiments/methods.h"
#include "experiments/number_text.h"
#include "experiments/outputs.h"
#include "experiments/program.h"
#include "experiments/progress_line.h"
#include "experiments/protocols/loop_pairs.h"
#include "experiments/protocols/odometry_runs.h"
#include "experiments/protocols/protocols.h"
#include "experiments/protocols/tilt.h"
#include "experiments/report/report_template.h"
#include "experiments/runner/manifest.h"
#include "experiments/runner/pair_experiment.h"
#include "experiments/runner/stop_signal.h"
#include "experiments/synthetic_protocols.h"
#include "robust/presets.h"

DEFINE_string(
    protocol,
    "",
    "On scans: loop, interval, yaw, timing, pairs, odometry or tilt "
    "(of loops, no method). On matched points: tims (yaw from "
    "differences, 95-99 % outliers), "
    "degeneracy (1-5 true matches), quasi_inliers (right in xy, "
    "wrong in z), sizes (a thousand to a million matches), slopes "
    "(tilts of 2-15 deg with an INS), surrogates or film (numbers for "
    "draw_surrogates.py and draw_gnc_film.py). Required");
DEFINE_string(output,
              "",
              "On scans: folder of the run, new or to go on with, required. "
              "On matched points: CSV file for the table as well");
DEFINE_string(methods, "quatro", "On scans: a,b,c; --list_methods names them");
DEFINE_bool(list_methods, false, "Print the methods and end");
DEFINE_string(data, "", "Folder of a drive, or of a data set with drives");
DEFINE_string(sequences, "", "Drives of the data set, 00,02; empty: all");
DEFINE_string(poses, "", "File of true poses in place of the data set's own");
DEFINE_string(
    pairs,
    "",
    "Of pairs: the list, a .csv, or one of KITTI pairs (kitti_10m, kitti_lc) "
    "whose sequences --data holds");
DEFINE_string(preset,
              "kitti",
              "Parameters of all methods: kitti, paper, reference, indoor, or "
              "auto (from each pair of clouds)");
DEFINE_string(ins_mode,
              "fused",
              "What quatro_ins makes of the INS: relative, leveled or fused");
DEFINE_string(bins, "0-2,4-6,8-10", "Of loop, timing, tilt: distances [m]");
DEFINE_int32(min_frame_gap,
             100,
             "Of loop, timing, tilt: frames between visits");
DEFINE_double(min_path, 50.0, "Of loop, timing, tilt: way between visits [m]");
DEFINE_string(intervals,
              "1,3,5",
              "Of interval, odometry: frames apart; yaw: the last");
DEFINE_double(yaw_step_deg, 30.0, "Of yaw: from one turn to the next [deg]");
DEFINE_int32(max_pairs,
             100,
             "Of each drive and each bin or interval; 0: all there are");
DEFINE_int32(max_pairs_per_source,
             1,
             "Of loop and timing: pairs with one frame as the source; 0: all");
DEFINE_int32(max_frames, 0, "Of odometry: of each drive; 0: all there are");
DEFINE_uint64(seed, 1, "Of the choice of pairs and of the methods");
DEFINE_string(shard, "1/1", "On scans: do part k of n alone, k/n");
DEFINE_bool(merge, false, "On scans: put the parts in --output together");
DEFINE_double(outliers, 0.9, "Of film: share of wrong differences");
DEFINE_int32(seeds, 20, "On matched points: problems of each kind");
DEFINE_int64(max_matches, 1000000, "Of sizes: the largest problem");
DEFINE_int32(
    report_views,
    500,
    "On scans: so many pairs, the first of the list, can be seen in 3D "
    "in report.html");
DEFINE_int32(threads,
             0,
             "0: one per core. On scans so many pairs at a time; timing always "
             "takes one. Results do not depend on it");

namespace {

using quatro::Fail;

constexpr int kMaxInterval = 1'000'000;  // Frames; no drive has as many.

constexpr char kUsage[] =
    "compares methods on scans of a data set, or on problems with known "
    "answers.\n"
    "\n"
    "  quatro_experiment --protocol=loop --data=kitti --sequences=00,05\n"
    "      --methods=quatro,teaser,ransac10k --output=loops\n"
    "  quatro_experiment --protocol=degeneracy\n"
    "\n"
    "On scans, the folder gets results.csv, a line for each pair and method,\n"
    "tables, and report.html, a page to look at. A run that was stopped, by\n"
    "Ctrl-C or otherwise, is gone on with by the same command. Progress goes\n"
    "to standard error.\n"
    "Exits with 0; 2 if a flag or a file is wrong; 3 if it was stopped.";

std::optional<quatro::Table> RunSynthetic(const std::string& protocol) {
  const quatro::Progress progress = quatro::ProgressLine("problems");
  if (protocol == "tims") {
    return quatro::RunTimProtocol(FLAGS_seeds, progress);
  }
  if (protocol == "degeneracy") {
    return quatro::RunDegeneracyProtocol(FLAGS_seeds, progress);
  }
  if (protocol == "quasi_inliers") {
    return quatro::RunQuasiInlierProtocol(FLAGS_seeds, progress);
  }
  if (protocol == "sizes") {
    return quatro::RunSizeProtocol(
        FLAGS_seeds, FLAGS_max_matches, FLAGS_threads, progress);
  }
  if (protocol == "slopes") {
    return quatro::RunSlopeProtocol(FLAGS_seeds, progress);
  }
  if (protocol == "surrogates") return quatro::TabulateSurrogates();
  if (protocol == "film") {
    quatro::FilmOptions options;
    options.seed = FLAGS_seed;
    options.outlier_ratio = FLAGS_outliers;
    return quatro::TabulateFilm(quatro::FilmGnc(options));
  }
  return std::nullopt;
}

std::vector<std::string> SplitNames(const std::string& text) {
  std::vector<std::string> names;
  for (const std::string_view name : quatro::SplitFields(text, ",")) {
    names.emplace_back(name);
  }
  return names;
}

// Nullopt with *error set if the preset is not known.
std::optional<quatro::RegistrationOptions> OptionsOfFlags(std::string* error) {
  auto options =
      quatro::MakePreset(FLAGS_preset == "auto" ? "kitti" : FLAGS_preset);
  if (!options) {
    *error = "--preset=" + FLAGS_preset + ", must be auto";
    for (const std::string& name : quatro::PresetNames()) *error += ", " + name;
    return std::nullopt;
  }
  options->seed = FLAGS_seed;
  options->num_threads = 1;
  return options;
}

std::optional<std::vector<int>> IntervalsOfFlags(std::string* error) {
  std::vector<int> intervals;
  for (const std::string& text : SplitNames(FLAGS_intervals)) {
    const auto number = quatro::ParseFiniteNumber(text);
    if (!number || !(*number >= 1.0 && *number <= kMaxInterval) ||
        *number != static_cast<int>(*number)) {
      *error = "--intervals: '" + text + "' is no number of frames";
      return std::nullopt;
    }
    intervals.push_back(static_cast<int>(*number));
  }
  return intervals;
}

std::optional<quatro::RunMethods> MethodsOfFlags(
    const std::vector<quatro::OwnMethod>& own, std::string* error) {
  quatro::RunMethods methods;
  methods.own = own;
  methods.names = SplitNames(FLAGS_methods);
  methods.use_auto_options = FLAGS_preset == "auto";
  const auto options = OptionsOfFlags(error);
  if (!options) return std::nullopt;
  methods.options = *options;
  bool is_mode = false;
  for (const quatro::InsMode mode : {quatro::InsMode::kRelative,
                                     quatro::InsMode::kLeveled,
                                     quatro::InsMode::kFused}) {
    if (FLAGS_ins_mode != quatro::InsModeName(mode)) continue;
    methods.ins_mode = mode;
    is_mode = true;
  }
  if (!is_mode) {
    *error =
        "--ins_mode=" + FLAGS_ins_mode + ", must be relative, leveled or fused";
    return std::nullopt;
  }
  if (!methods.IsValid(error)) {
    *error = "--methods: " + *error;
    return std::nullopt;
  }
  return methods;
}

std::optional<std::vector<quatro::SequenceData>> DrivesOfFlags(
    std::string* error) {
  return quatro::OpenDataset(
      {FLAGS_data, SplitNames(FLAGS_sequences), FLAGS_poses}, error);
}

std::optional<quatro::PairSelection> TasksOfFlags(std::string* error) {
  if (FLAGS_protocol == "pairs") {
    return quatro::OpenPairList(FLAGS_pairs, FLAGS_data, error);
  }
  quatro::ProtocolOptions protocol;
  protocol.name = FLAGS_protocol;
  const auto bins = quatro::ParseBins(FLAGS_bins, error);
  if (!bins) {
    *error = "--bins: " + *error;
    return std::nullopt;
  }
  protocol.bins = *bins;
  protocol.min_frame_gap = FLAGS_min_frame_gap;
  protocol.min_path = FLAGS_min_path;
  const auto intervals = IntervalsOfFlags(error);
  if (!intervals) return std::nullopt;
  protocol.intervals = *intervals;
  protocol.yaw_step_deg = FLAGS_yaw_step_deg;
  protocol.max_pairs = FLAGS_max_pairs;
  protocol.max_pairs_per_source = FLAGS_max_pairs_per_source;
  protocol.seed = FLAGS_seed;
  if (!protocol.IsValid(error)) return std::nullopt;

  const auto drives = DrivesOfFlags(error);
  if (!drives) return std::nullopt;
  return quatro::SelectPairs(*drives, protocol, error);
}

quatro::Manifest ManifestOfFlags() {
  quatro::Manifest manifest = quatro::BeginManifest();
  manifest.seed = FLAGS_seed;
  // Those that choose pairs are in the checksum of the tasks, too.
  manifest.flags = {{"protocol", FLAGS_protocol},
                    {"methods", FLAGS_methods},
                    {"preset", FLAGS_preset},
                    {"ins_mode", FLAGS_ins_mode}};
  manifest.other_flags = {{"data", FLAGS_data},
                          {"sequences", FLAGS_sequences},
                          {"poses", FLAGS_poses},
                          {"pairs", FLAGS_pairs},
                          {"bins", FLAGS_bins},
                          {"intervals", FLAGS_intervals},
                          {"max_pairs", std::to_string(FLAGS_max_pairs)},
                          {"shard", FLAGS_shard},
                          {"report_views", std::to_string(FLAGS_report_views)},
                          {"threads", std::to_string(FLAGS_threads)}};
  return manifest;
}

// Once all pairs are done.
int LeaveTables() {
  std::string error, summary;
  const auto report_template = quatro::ReadReportTemplate(&error);
  if (!report_template) std::fprintf(stderr, "%s\n", error.c_str());
  if (!quatro::WriteTables(FLAGS_output, report_template, &summary, &error)) {
    return Fail(error);
  }
  std::fputs(summary.c_str(), stdout);
  return quatro::kExitDone;
}

int RunOnScans(const std::vector<quatro::OwnMethod>& own) {
  std::string error;
  if (FLAGS_output.empty())
    return Fail("--output is empty, must name a folder");
  const auto methods = MethodsOfFlags(own, &error);
  if (!methods) return Fail(error);
  const auto shard = quatro::ParseShard(FLAGS_shard, &error);
  if (!shard) return Fail("--shard: " + error);
  const auto selection = TasksOfFlags(&error);
  if (!selection) return Fail(error);
  for (const std::string& note : selection->notes) {
    std::fprintf(stderr, "%s\n", note.c_str());
  }
  if (selection->tasks.empty()) {
    return Fail("there are no pairs; see the flags that choose them");
  }
  quatro::PairExperiment experiment;
  experiment.tasks = selection->tasks;
  experiment.methods = *methods;
  experiment.output = FLAGS_output;
  experiment.shard = *shard;
  experiment.num_views = static_cast<std::size_t>(FLAGS_report_views);
  experiment.manifest = ManifestOfFlags();
  if (FLAGS_merge) {
    if (!quatro::MergeShards(experiment, &error)) return Fail(error);
    return LeaveTables();
  }

  quatro::ListenForStop();
  quatro::RunControl control;
  control.num_workers = FLAGS_protocol == "timing" ? 1 : FLAGS_threads;
  control.should_stop = quatro::WasAskedToStop;
  control.progress = quatro::ProgressLine("pairs");
  switch (quatro::RunPairExperiment(experiment, control, &error)) {
    case quatro::RunEnd::kDone:
      break;
    case quatro::RunEnd::kStopped:
      quatro::EndProgressLine();
      std::fprintf(stderr, "stopped; the same command goes on from here\n");
      return quatro::kExitStopped;
    case quatro::RunEnd::kFailed:
      return Fail(error);
  }
  return shard->IsWhole() ? LeaveTables() : quatro::kExitDone;
}

void TellNotes(const std::vector<quatro::SequenceData>& drives) {
  for (const quatro::SequenceData& drive : drives) {
    for (const std::string& note : drive.notes) {
      std::fprintf(stderr, "%s\n", note.c_str());
    }
  }
}

int RunOdometryProtocol() {
  std::string error;
  if (FLAGS_output.empty()) {
    return Fail("--output is empty, must name a folder");
  }
  quatro::OdometryRunOptions options;
  options.methods = SplitNames(FLAGS_methods);
  const auto intervals = IntervalsOfFlags(&error);
  if (!intervals) return Fail(error);
  options.intervals = *intervals;
  options.max_frames = FLAGS_max_frames;
  const auto registration = OptionsOfFlags(&error);
  if (!registration) return Fail(error);
  options.registration = *registration;
  options.registration.num_threads = FLAGS_threads;
  if (!options.IsValid(&error)) return Fail(error);
  const auto drives = DrivesOfFlags(&error);
  if (!drives) return Fail(error);
  TellNotes(*drives);
  const auto results = quatro::RunOdometries(
      *drives,
      options,
      FLAGS_output,
      [](const quatro::OdometryRunProgress& now) {
        std::fprintf(stderr,
                     "\r%s, %s, interval %d: %d of %d scans   %s",
                     now.drive.c_str(),
                     now.method.c_str(),
                     now.interval,
                     now.num_done,
                     now.num_scans,
                     now.num_done == now.num_scans ? "\n" : "");
      },
      &error);
  if (!results) return Fail(error);
  const auto quoted = quatro::QuotedTableTwo();
  std::vector<quatro::DriftEntry> entries = quatro::MeanDrifts(*results);
  entries.insert(entries.end(), quoted.begin(), quoted.end());
  const quatro::Table table = quatro::MakeTableTwo(entries);
  std::fputs(quatro::FormatTable(table).c_str(), stdout);
  if (!quatro::WriteOutputs(
          {{FLAGS_output + "/table_two.csv", quatro::FormatCsv(table)},
           {FLAGS_output + "/table_two.tex",
            quatro::FormatTableTwoLatex(entries)}},
          &error)) {
    return Fail(error);
  }
  return quatro::kExitDone;
}

int RunTiltProtocol() {
  std::string error;
  if (FLAGS_output.empty()) {
    return Fail("--output is empty, must name a folder");
  }
  const auto bins = quatro::ParseBins(FLAGS_bins, &error);
  if (!bins) return Fail("--bins: " + error);
  quatro::LoopOptions loop;
  loop.min_frame_gap = FLAGS_min_frame_gap;
  loop.min_path = FLAGS_min_path;
  if (!loop.IsValid(&error)) return Fail(error);
  const auto drives = DrivesOfFlags(&error);
  if (!drives) return Fail(error);
  TellNotes(*drives);
  std::vector<quatro::RelativeTilting> tilts;
  for (const quatro::SequenceData& drive : *drives) {
    for (const quatro::DistanceBin& bin : *bins) {
      const auto more = quatro::MeasureTilts(drive, bin, loop);
      tilts.insert(tilts.end(), more.begin(), more.end());
    }
  }
  std::error_code status;
  std::filesystem::create_directories(FLAGS_output, status);
  if (status) return Fail(FLAGS_output + ": " + status.message());
  if (!quatro::WriteOutputs(
          {{FLAGS_output + "/tilts.csv", quatro::FormatTilts(tilts)}},
          &error)) {
    return Fail(error);
  }
  std::printf(
      "%zu loops in %s/tilts.csv\n", tilts.size(), FLAGS_output.c_str());
  return quatro::kExitDone;
}

bool IsOnScans() {
  if (FLAGS_protocol == "pairs") return true;
  for (const std::string& name : quatro::DriveProtocolNames()) {
    if (FLAGS_protocol == name) return true;
  }
  return false;
}

int Run(int argc, char** argv, const std::vector<quatro::OwnMethod>& own) {
  if (const auto exit_code =
          quatro::ParseFlags(kUsage, "experiment_program", argc, argv)) {
    return *exit_code;
  }
  if (FLAGS_list_methods) {
    std::fputs(quatro::DescribeMethods(own).c_str(), stdout);
    return quatro::kExitDone;
  }
  std::string error;
  if (FLAGS_seeds < 1) return Fail("--seeds must be >= 1");
  if (FLAGS_max_matches < 1000) return Fail("--max_matches must be >= 1000");
  if (!(FLAGS_outliers >= 0.0 && FLAGS_outliers < 1.0)) {
    return Fail("--outliers must be in [0, 1)");
  }
  if (FLAGS_report_views < 0) return Fail("--report_views must be >= 0");
  if (FLAGS_threads < 0) return Fail("--threads must be >= 0");
  if (IsOnScans()) return RunOnScans(own);
  if (FLAGS_protocol == "odometry") return RunOdometryProtocol();
  if (FLAGS_protocol == "tilt") return RunTiltProtocol();
  if (!FLAGS_output.empty() && !quatro::CanWrite(FLAGS_output, &error)) {
    return Fail(error);
  }
  const auto table = RunSynthetic(FLAGS_protocol);
  if (!table) {
    return Fail(
        "--protocol=" + FLAGS_protocol +
        ", must be loop, interval, yaw, timing, pairs, odometry, tilt, tims, "
        "degeneracy, quasi_inliers, sizes, slopes, surrogates or film");
  }
  std::fputs(quatro::FormatTable(*table).c_str(), stdout);
  if (!FLAGS_output.empty() &&
      !quatro::WriteOutputs({{FLAGS_output, quatro::FormatCsv(*table)}},
                            &error)) {
    return Fail(error);
  }
  return quatro::kExitDone;
}

}  // namespace

namespace quatro {

int RunExperimentProgram(int argc,
                         char** argv,
                         const std::vector<OwnMethod>& own) {
  return RunProgram(
      [&own](int count, char** values) { return Run(count, values, own); },
      argc,
      argv);
}

}  // namespace quatro
