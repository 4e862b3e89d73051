// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/experiment_flags.h"

#include "experiments/base/number_text.h"
#include "experiments/datasets/open_dataset.h"
#include "experiments/programs/ins_flags.h"
#include "experiments/protocols/problem_families.h"
#include "experiments/runner/run_problem.h"
#include "robust/registration/presets.h"

DEFINE_string(
    protocol,
    "",
    "On scans: loop, interval, yaw, timing, pairs, odometry or tilt "
    "(of loops, no method). On matched points: synthetic (families of "
    "problems by any methods), tims (yaw from "
    "differences, 95-99 % outliers), "
    "degeneracy (1-5 true matches), quasi_inliers (right in xy, "
    "wrong in z), sizes (a thousand to a million matches), slopes "
    "(tilts of 2-15 deg with an INS), surrogates or film (numbers for "
    "draw_surrogates.py and draw_gnc_film.py). Required");
DEFINE_string(output,
              "",
              "On scans and of synthetic: folder of the run, new or to go on "
              "with, required. Otherwise CSV file for the table as well");
DEFINE_string(methods,
              "quatro",
              "On scans and of synthetic: a,b,c; --list_methods names them");
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
DEFINE_string(limits,
              "2/10,2/5,0.6/5",
              "On scans and of synthetic: a pair is a success within so much "
              "[m/deg]; the first is that of tables of one. The same command "
              "with others makes the tables of a finished run anew");
DEFINE_uint64(seed, 1, "Of the choice of pairs and of the methods");
DEFINE_string(shard,
              "1/1",
              "On scans and of synthetic: do part k of n alone, k/n");
DEFINE_bool(merge,
            false,
            "On scans and of synthetic: put the parts in --output together");
DEFINE_double(outliers, 0.9, "Of film: share of wrong differences");
DEFINE_string(families,
              "outliers,noise,matches,degeneracy,quasi_inliers",
              "Of synthetic: a,b,c");
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

namespace quatro {
namespace {

constexpr int kMaxInterval = 1'000'000;  // Frames; no drive has as many.

// Noise goes by the noise bound of the methods.
std::optional<PairSelection> ProblemsOfFlags(std::string* error) {
  const auto registration = OptionsOfFlags(error);
  if (!registration) return std::nullopt;
  FamilyOptions families;
  families.families = SplitNames(FLAGS_families);
  families.num_problems = FLAGS_seeds;
  families.noise_bound = registration->noise_bound;
  families.seed = FLAGS_seed;
  auto selection = SelectProblems(families, error);
  if (!selection) *error = "--families: " + *error;
  return selection;
}

}  // namespace

std::vector<std::string> SplitNames(const std::string& text) {
  std::vector<std::string> names;
  for (const std::string_view name : SplitFields(text, ",")) {
    names.emplace_back(name);
  }
  return names;
}

std::optional<RegistrationOptions> OptionsOfFlags(std::string* error) {
  auto options = MakePreset(FLAGS_preset == "auto" ? "kitti" : FLAGS_preset);
  if (!options) {
    *error = "--preset=" + FLAGS_preset + ", must be auto";
    for (const std::string& name : PresetNames()) *error += ", " + name;
    return std::nullopt;
  }
  options->seed = FLAGS_seed;
  options->num_threads = 1;
  return options;
}

std::optional<std::vector<int>> IntervalsOfFlags(std::string* error) {
  std::vector<int> intervals;
  for (const std::string& text : SplitNames(FLAGS_intervals)) {
    const auto number = ParseFiniteNumber(text);
    if (!number || !(*number >= 1.0 && *number <= kMaxInterval) ||
        *number != static_cast<int>(*number)) {
      *error = "--intervals: '" + text + "' is no number of frames";
      return std::nullopt;
    }
    intervals.push_back(static_cast<int>(*number));
  }
  return intervals;
}

std::optional<RunMethods> MethodsOfFlags(const std::vector<OwnMethod>& own,
                                         std::string* error) {
  RunMethods methods;
  methods.own = own;
  methods.names = SplitNames(FLAGS_methods);
  methods.use_auto_options = FLAGS_preset == "auto";
  const auto options = OptionsOfFlags(error);
  if (!options) return std::nullopt;
  methods.options = *options;
  bool is_mode = false;
  for (const InsMode mode :
       {InsMode::kRelative, InsMode::kLeveled, InsMode::kFused}) {
    if (FLAGS_ins_mode != InsModeName(mode)) continue;
    methods.ins_mode = mode;
    is_mode = true;
  }
  if (!is_mode) {
    *error =
        "--ins_mode=" + FLAGS_ins_mode + ", must be relative, leveled or fused";
    return std::nullopt;
  }
  if (!(FLAGS_protocol == "synthetic" ? CanRunProblems(methods, error)
                                      : methods.IsValid(error))) {
    *error = "--methods: " + *error;
    return std::nullopt;
  }
  return methods;
}

std::optional<std::vector<SequenceData>> DrivesOfFlags(std::string* error) {
  return OpenDataset({FLAGS_data, SplitNames(FLAGS_sequences), FLAGS_poses},
                     error);
}

std::optional<PairSelection> TasksOfFlags(std::string* error) {
  if (FLAGS_protocol == "pairs") {
    return OpenPairList(FLAGS_pairs, FLAGS_data, error);
  }
  if (FLAGS_protocol == "synthetic") return ProblemsOfFlags(error);
  ProtocolOptions protocol;
  protocol.name = FLAGS_protocol;
  const auto bins = ParseBins(FLAGS_bins, error);
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
  return SelectPairs(*drives, protocol, error);
}

Manifest ManifestOfFlags() {
  Manifest manifest = BeginManifest();
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
                          {"families", FLAGS_families},
                          {"seeds", std::to_string(FLAGS_seeds)},
                          {"max_pairs", std::to_string(FLAGS_max_pairs)},
                          {"shard", FLAGS_shard},
                          {"report_views", std::to_string(FLAGS_report_views)},
                          {"threads", std::to_string(FLAGS_threads)}};
  return manifest;
}

}  // namespace quatro
