// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/experiment_flags.h"

#include "experiments/base/number_text.h"
#include "experiments/datasets/open_dataset.h"
#include "experiments/programs/flag_problems.h"
#include "experiments/programs/ins_flags.h"
#include "experiments/protocols/problem_families.h"
#include "experiments/runner/run_problem.h"
#include "robust/registration/presets.h"

DEFINE_string(
    protocol,
    "",
    "On scans: loop, interval, yaw, timing, pairs, odometry or tilt "
    "(of loops, without a method). On matched points: synthetic (families of "
    "problems, any methods), tims (yaw from "
    "differences, 95-99 % outliers), "
    "degeneracy (1-5 inliers), quasi_inliers (correct in xy, not in z), "
    "sizes (a thousand to a million matches), slopes "
    "(tilts of 2-15 deg with an INS), surrogates or film (numbers for "
    "draw_surrogates.py and draw_gnc_film.py). Required");
DEFINE_string(output,
              "",
              "On scans and for synthetic: folder of the run, new or to "
              "resume, required. Otherwise CSV file for the table as well");
DEFINE_string(methods,
              "quatro",
              "On scans and for synthetic: a,b,c; see --list_methods");
DEFINE_bool(list_methods, false, "List the methods and exit");
DEFINE_string(data,
              "",
              "Folder of a drive, or of a data set with several drives");
DEFINE_string(sequences, "", "Drives of the data set, e.g. 00,02; empty: all");
DEFINE_string(poses, "", "File of true poses instead of the data set's own");
DEFINE_string(
    pairs,
    "",
    "Of pairs: the list, a .csv, or one of KITTI pairs (kitti_10m, kitti_lc) "
    "whose sequences --data holds");
DEFINE_int32(point_floats,
             0,
             "On scans: numbers of a point of a .bin: x, y, z, the intensity, "
             "others; 0: told by the file");
DEFINE_string(preset,
              "kitti",
              "Parameters of all methods: kitti, paper, reference, indoor, or "
              "auto (from each pair of clouds)");
DEFINE_string(ins_mode,
              "fused",
              "How quatro_ins uses the INS: relative, leveled or fused");
DEFINE_string(bins, "0-2,4-6,8-10", "For loop, timing, tilt: distances [m]");
DEFINE_int32(min_frame_gap,
             100,
             "For loop, timing, tilt: frames between visits");
DEFINE_double(min_path,
              50.0,
              "For loop, timing, tilt: path between visits [m]");
DEFINE_double(min_pair_spacing,
              0.0,
              "For loop, timing, tilt: least path between frames that are "
              "used [m]; 0: all frames");
DEFINE_string(intervals,
              "1,3,5",
              "For interval, odometry: frame intervals; yaw uses the last");
DEFINE_double(yaw_step_deg, 30.0, "For yaw: step of the added yaw [deg]");
DEFINE_int32(max_pairs, 100, "Pairs per drive and bin or interval; 0: all");
DEFINE_int32(max_pairs_per_source,
             1,
             "For loop and timing: pairs per source frame; 0: all");
DEFINE_int32(max_frames, 0, "For odometry: frames per drive; 0: all");
DEFINE_string(limits,
              "2/10,2/5,0.6/5",
              "On scans and for synthetic: error limits of a success [m/deg]. "
              "Tables with one limit use the first. Run the same command with "
              "other limits to recompute the tables of a finished run");
DEFINE_uint64(seed, 1, "Seed for selecting pairs and for the methods");
DEFINE_string(shard,
              "1/1",
              "On scans and for synthetic: run only part k of n, k/n");
DEFINE_bool(merge,
            false,
            "On scans and for synthetic: merge the parts in --output");
DEFINE_double(outliers,
              0.9,
              "For film: share of outliers among the differences");
DEFINE_string(families,
              "outliers,noise,matches,degeneracy,quasi_inliers",
              "For synthetic: families, a,b,c");
DEFINE_int32(seeds, 20, "On matched points: problems per kind");
DEFINE_int64(max_matches, 1000000, "For sizes: matches of the largest problem");
DEFINE_int32(
    report_views,
    500,
    "On scans: the number of pairs, from the start of the list, that can be "
    "viewed in 3D in report.html");
DEFINE_int32(threads,
             0,
             "Threads; 0: one per core. On scans, pairs that run at a time; "
             "timing always runs one. Does not affect the results");

namespace quatro {
namespace {

constexpr int kMaxInterval = 1'000'000;  // Frames; exceeds every drive.

// The noise is proportional to the noise bound of the methods.
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
    *error = UnknownPreset(FLAGS_preset, /*has_auto=*/true);
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
      *error = "--intervals: '" + text + "' is not a number of frames";
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
  methods.reading.point_floats = FLAGS_point_floats;
  if (!methods.reading.IsValid(error)) return std::nullopt;
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
  protocol.min_pair_spacing = FLAGS_min_pair_spacing;
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
  // Flags that select pairs are also covered by the checksum of the tasks.
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
