// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/experiment_program.h"

#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "experiments/base/one_line.h"
#include "experiments/base/outputs.h"
#include "experiments/base/progress_line.h"
#include "experiments/metrics/registration_metrics.h"
#include "experiments/programs/experiment_flags.h"
#include "experiments/programs/flag_problems.h"
#include "experiments/programs/methods.h"
#include "experiments/programs/program.h"
#include "experiments/protocols/gnc_film.h"
#include "experiments/protocols/loop_pairs.h"
#include "experiments/protocols/odometry_runs.h"
#include "experiments/protocols/protocols.h"
#include "experiments/protocols/synthetic_protocols.h"
#include "experiments/protocols/tilt.h"
#include "experiments/report/report_template.h"
#include "experiments/runner/data_checksum.h"
#include "experiments/runner/manifest.h"
#include "experiments/runner/pair_experiment.h"
#include "experiments/runner/stop_signal.h"

namespace {

using quatro::Fail;

constexpr char kUsage[] =
    "compares methods on scans of a data set, or on problems with known "
    "answers.\n"
    "\n"
    "  quatro_experiment --protocol=loop --data=kitti --sequences=00,05\n"
    "      --methods=quatro,teaser,ransac10k --output=loops\n"
    "  quatro_experiment --protocol=synthetic --methods=quatro,fgr "
    "--output=points\n"
    "  quatro_experiment --protocol=degeneracy\n"
    "\n"
    "On scans and for synthetic, the folder gets results.csv (a line per pair\n"
    "and method), tables, and report.html, an interactive page. Run the same\n"
    "command again to resume an interrupted run.\n"
    "Progress is printed on standard error.\n"
    "Exits with 0; 2 if a flag or a file is invalid; 3 if it was interrupted.";

// Flags that the other protocols would ignore.
constexpr quatro::FlagUse kFlagUses[] = {
    {"bins", "loop, timing, tilt"},
    {"min_frame_gap", "loop, timing, tilt"},
    {"min_path", "loop, timing, tilt"},
    {"min_pair_spacing", "loop, timing, tilt"},
    {"intervals", "interval, yaw, odometry"},
    {"yaw_step_deg", "yaw"},
    {"max_pairs", "loop, interval, yaw, timing"},
    {"max_pairs_per_source", "loop, timing"},
    {"max_frames", "odometry"},
    {"pairs", "pairs"},
    {"families", "synthetic"},
    {"max_matches", "sizes"},
    {"outliers", "film"}};

constexpr long kMaxMatches = 1'000'000'000;  // 48 GB of points.

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

// Writes the tables once all pairs are done.
int LeaveTables(const quatro::TableOptions& options) {
  std::string error, summary;
  const auto report_template = quatro::ReadReportTemplate(&error);
  if (!report_template)
    std::fprintf(stderr, "%s\n", quatro::OneLine(error).c_str());
  if (!quatro::WriteTables(
          FLAGS_output, options, report_template, &summary, &error)) {
    return Fail(error);
  }
  std::fputs(summary.c_str(), stdout);
  return quatro::kExitDone;
}

int RunPairs(const std::vector<quatro::OwnMethod>& own) {
  std::string error;
  if (!quatro::CanBeFolder({"output", FLAGS_output}, &error)) {
    return Fail(error);
  }
  const auto methods = quatro::MethodsOfFlags(own, &error);
  if (!methods) return Fail(error);
  const auto limits = quatro::ParseLimits(FLAGS_limits, &error);
  if (!limits) return Fail("--limits: " + error);
  quatro::TableOptions tables;
  tables.limits = *limits;
  tables.are_scans = FLAGS_protocol != "synthetic";
  const auto shard = quatro::ParseShard(FLAGS_shard, &error);
  if (!shard) return Fail("--shard: " + error);
  const auto selection = quatro::TasksOfFlags(&error);
  if (!selection) return Fail(error);
  for (const std::string& note : selection->notes) {
    std::fprintf(stderr, "%s\n", quatro::OneLine(note).c_str());
  }
  if (selection->tasks.empty()) {
    return Fail(
        "there are no pairs to run: no two scans are as far apart as asked "
        "for; see --sequences, --bins, --intervals, --min_frame_gap, "
        "--min_path and --min_pair_spacing");
  }
  quatro::PairExperiment experiment;
  experiment.tasks = selection->tasks;
  experiment.methods = *methods;
  experiment.output = FLAGS_output;
  experiment.shard = *shard;
  experiment.num_views = static_cast<std::size_t>(FLAGS_report_views);
  experiment.manifest = quatro::ManifestOfFlags();
  if (FLAGS_merge) {
    if (!quatro::MergeShards(experiment, &error)) return Fail(error);
    return LeaveTables(tables);
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
      std::fprintf(stderr,
                   "interrupted; run the same command again to resume\n");
      return quatro::kExitStopped;
    case quatro::RunEnd::kFailed:
      return Fail(error);
  }
  return shard->IsWhole() ? LeaveTables(tables) : quatro::kExitDone;
}

void TellNotes(const std::vector<quatro::SequenceData>& drives) {
  for (const quatro::SequenceData& drive : drives) {
    for (const std::string& note : drive.notes) {
      std::fprintf(stderr, "%s\n", quatro::OneLine(note).c_str());
    }
  }
}

// Methods and intervals are separate runs; more can be added later.
bool TakeOdometryManifest(const std::vector<quatro::SequenceData>& drives,
                          std::string* error) {
  quatro::Manifest manifest = quatro::ManifestOfFlags();
  manifest.flags.erase("ins_mode");
  manifest.flags.erase("methods");
  manifest.flags["max_frames"] = std::to_string(FLAGS_max_frames);
  manifest.other_flags["methods"] = FLAGS_methods;
  std::vector<std::string> scans;
  for (const quatro::SequenceData& drive : drives) {
    for (const auto& [frame, path] : drive.scans) scans.push_back(path);
  }
  const auto data = quatro::SummarizeData("", scans, {}, error);
  if (!data) return false;
  manifest.data = *data;
  std::error_code status;
  std::filesystem::create_directories(FLAGS_output, status);
  if (status) {
    *error = FLAGS_output + ": " + status.message();
    return false;
  }
  return quatro::TakeManifest(FLAGS_output, manifest, error);
}

// Whether --output is new, empty or the folder of a run of this protocol.
bool CanBeRunFolder(std::string* error) {
  namespace fs = std::filesystem;
  if (!quatro::CanBeFolder({"output", FLAGS_output}, error)) return false;
  std::error_code ignored;
  if (!fs::exists(FLAGS_output, ignored) ||
      (fs::is_directory(FLAGS_output, ignored) &&
       fs::is_empty(FLAGS_output, ignored))) {
    return true;
  }
  auto manifest = quatro::ReadManifest(FLAGS_output + "/manifest.json", error);
  if (manifest && manifest->flags["protocol"] == FLAGS_protocol) return true;
  *error = FLAGS_output +
           ": holds other files, must be new, empty or the folder of a run of "
           "--protocol=" +
           FLAGS_protocol;
  return false;
}

int RunOdometryProtocol() {
  std::string error;
  if (!CanBeRunFolder(&error)) {
    return Fail(error);
  }
  quatro::OdometryRunOptions options;
  options.methods = quatro::SplitNames(FLAGS_methods);
  const auto intervals = quatro::IntervalsOfFlags(&error);
  if (!intervals) return Fail(error);
  options.intervals = *intervals;
  options.max_frames = FLAGS_max_frames;
  options.reading.point_floats = FLAGS_point_floats;
  const auto registration = quatro::OptionsOfFlags(&error);
  if (!registration) return Fail(error);
  options.registration = *registration;
  options.registration.num_threads = FLAGS_threads;
  if (!options.IsValid(&error)) return Fail(error);
  const auto drives = quatro::DrivesOfFlags(&error);
  if (!drives) return Fail(error);
  if (!TakeOdometryManifest(*drives, &error)) return Fail(error);
  TellNotes(*drives);
  // A line for each run.
  std::map<std::string, quatro::ProgressLine> lines;
  const auto results = quatro::RunOdometries(
      *drives,
      options,
      FLAGS_output,
      [&lines](const quatro::OdometryRunProgress& now) {
        const std::string run = now.drive + ", " + now.method + ", interval " +
                                std::to_string(now.interval) + ": ";
        lines.try_emplace(run, "scans", run)
            .first->second(now.num_done, now.num_scans);
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
  if (!CanBeRunFolder(&error)) {
    return Fail(error);
  }
  const auto bins = quatro::ParseBins(FLAGS_bins, &error);
  if (!bins) return Fail("--bins: " + error);
  quatro::LoopOptions loop;
  loop.min_frame_gap = FLAGS_min_frame_gap;
  loop.min_path = FLAGS_min_path;
  loop.min_pair_spacing = FLAGS_min_pair_spacing;
  if (!loop.IsValid(&error)) return Fail(error);
  const auto drives = quatro::DrivesOfFlags(&error);
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
          {{FLAGS_output + "/manifest.json",
            quatro::FormatManifest(quatro::ManifestOfFlags())},
           {FLAGS_output + "/tilts.csv", quatro::FormatTilts(tilts)}},
          &error)) {
    return Fail(error);
  }
  std::printf(
      "%zu loops in %s/tilts.csv\n", tilts.size(), FLAGS_output.c_str());
  return quatro::kExitDone;
}

bool IsOfPairs() {
  if (FLAGS_protocol == "pairs" || FLAGS_protocol == "synthetic") return true;
  for (const std::string& name : quatro::DriveProtocolNames()) {
    if (FLAGS_protocol == name) return true;
  }
  return false;
}

int Run(int argc, char** argv, const std::vector<quatro::OwnMethod>& own) {
  if (const auto exit_code = quatro::ParseFlags(kUsage, argc, argv)) {
    return *exit_code;
  }
  if (FLAGS_list_methods) {
    std::fputs(quatro::DescribePairMethods(own).c_str(), stdout);
    return quatro::kExitDone;
  }
  std::string error;
  if (FLAGS_seeds < 1 || FLAGS_seeds > quatro::kMaxSeeds) {
    return Fail(quatro::FlagProblem(
        "seeds", FLAGS_seeds, "1 to " + std::to_string(quatro::kMaxSeeds)));
  }
  if (FLAGS_max_matches < 1000 || FLAGS_max_matches > kMaxMatches) {
    return Fail(quatro::FlagProblem("max_matches",
                                    FLAGS_max_matches,
                                    "1000 to " + std::to_string(kMaxMatches)));
  }
  if (!(FLAGS_outliers >= 0.0 && FLAGS_outliers < 1.0)) {
    return Fail(quatro::FlagProblem("outliers", FLAGS_outliers, "in [0, 1)"));
  }
  if (FLAGS_report_views < 0) {
    return Fail(
        quatro::FlagProblem("report_views", FLAGS_report_views, ">= 0"));
  }
  if (FLAGS_threads < 0) {
    return Fail(
        quatro::FlagProblem("threads", FLAGS_threads, ">= 0; 0: one per core"));
  }
  if (!quatro::UsesAllFlags(FLAGS_protocol, kFlagUses, &error)) {
    return Fail(error);
  }
  if (IsOfPairs()) return RunPairs(own);
  if (FLAGS_protocol == "odometry") return RunOdometryProtocol();
  if (FLAGS_protocol == "tilt") return RunTiltProtocol();
  if (!quatro::CanWriteAll({{"output", FLAGS_output}}, {}, &error)) {
    return Fail(error);
  }
  const auto table = RunSynthetic(FLAGS_protocol);
  if (!table) {
    return Fail("--protocol=" + FLAGS_protocol +
                ", must be loop, interval, yaw, timing, pairs, odometry, tilt, "
                "synthetic, tims, degeneracy, quasi_inliers, sizes, slopes, "
                "surrogates or film");
  }
  std::fputs(quatro::FormatTable(*table).c_str(),
             quatro::SummaryStream({FLAGS_output}));
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
