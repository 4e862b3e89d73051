// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/base/outputs.h"
#include "experiments/base/progress_line.h"
#include "experiments/programs/flag_problems.h"
#include "experiments/programs/program.h"
#include "experiments/runner/stop_signal.h"
#include "experiments/simulator/drives.h"
#include "experiments/simulator/pair_files.h"
#include "experiments/simulator/pair_sets.h"
#include "experiments/simulator/simulator.h"
#include "experiments/simulator/worlds.h"
#include "features/base/degree.h"

DEFINE_string(output, "", "Output folder; its parents are created. Required");
DEFINE_uint64(seed,
              1,
              "Seed of world and noise; the same seed gives the same files");
DEFINE_int32(num_frames,
             100,
             "Scans to write; for a drive, 0: to the end of its path");
DEFINE_double(frame_spacing, 1.0, "Distance between scans [m]");
DEFINE_double(slope_deg, 0.0, "Slope of the street [deg]");
DEFINE_double(tilt_sigma_deg,
              0.3,
              "Standard deviation of the car's roll and pitch (suspension) "
              "[deg]");
DEFINE_int32(threads, 0, "Threads; 0: one per core. Does not affect the files");
DEFINE_string(
    protocol,
    "sequence",
    "sequence: along one street; drive: through a city or a building, "
    "see --drive; pairs: independent pairs of scans, each in "
    "its own world; calibration: 1500 pairs of all worlds, half "
    "of them without overlap");
DEFINE_string(world,
              "street",
              "For pairs: street, crossing, hill, corridor, hall, symmetric or "
              "room (--max_distance of at most 3)");
DEFINE_string(drive,
              "00",
              "For drives: 00, 02, 05, 06, 07, 08 (like KITTI's, in cities) or "
              "hd_b1 (in a building)");
DEFINE_bool(sweep_motion,
            false,
            "For drives: points as the moving sensor saw them, uncorrected");
DEFINE_string(layout,
              "kitti",
              "For drives: kitti (velodyne/, poses.txt, oxts/) or naver "
              "(sensors/, as in NAVER LABS' data sets)");
DEFINE_int32(moving_cars, 15, "For drives: number of other moving cars");
DEFINE_int32(pairs, 100, "For pairs: number of pairs");
DEFINE_double(scale, 1.0, "For calibration: factor on the 1500 pairs");
DEFINE_double(min_distance, 0.0, "For pairs: minimum distance [m]");
DEFINE_double(max_distance, 30.0, "For pairs: maximum distance [m]");
DEFINE_double(max_yaw_deg, 180.0, "For pairs: maximum yaw, either way [deg]");
DEFINE_double(min_tilt_deg, 2.0, "For pairs on hills: minimum tilt [deg]");
DEFINE_double(max_tilt_deg, 15.0, "For pairs on hills: maximum tilt [deg]");
DEFINE_bool(no_overlap,
            false,
            "For pairs: scans without overlap, of worlds that look alike");
DEFINE_int32(features,
             -1,
             "For pairs in corridors: number of doors, niches, passages and "
             "the like; negative: by the seed");
DEFINE_string(
    sensor,
    "auto",
    "For pairs and drives: hdl64e, vlp16, os1_64, os1_128, livox (narrow), "
    "tls (terrestrial, 11 million rays) or depth_camera; auto: the usual one");
DEFINE_double(ins_std_deg,
              0.5,
              "For pairs: standard deviation of each angle of the INS [deg]");
DEFINE_double(ins_noise_deg,
              0.05,
              "For drives: standard deviation of the INS error that changes "
              "in each frame [deg]");
DEFINE_double(ins_bias_deg,
              0.3,
              "For drives: standard deviation of the constant INS error [deg]");
DEFINE_bool(overwrite, false, "Replace an existing sequence in --output");

namespace {

constexpr char kUsage[] =
    "simulates lidar scans and their true poses.\n"
    "\n"
    "  quatro_simulate --output=street --num_frames=50 --slope_deg=5\n"
    "\n"
    "A car drives along a street with a Velodyne HDL-64E. Writes the layout "
    "of\n"
    "KITTI odometry:\n"
    "        velodyne/000000.bin ...  float32 x y z intensity\n"
    "        poses.txt calib.txt times.txt\n"
    "Points of frame i are moved into frame j by Tr^-1 P_j^-1 P_i Tr.\n"
    "\n"
    "  quatro_simulate --output=05 --protocol=drive --drive=05 --num_frames=0\n"
    "\n"
    "Writes the same layout, and the INS in oxts/data/0000000000.txt ... as\n"
    "in KITTI raw. --layout=naver writes the layout of NAVER LABS' data sets,\n"
    "in sensors/.\n"
    "\n"
    "  quatro_simulate --output=halls --protocol=pairs --world=hall "
    "--pairs=50\n"
    "  quatro_simulate --output=calibration --protocol=calibration "
    "--scale=0.1\n"
    "\n"
    "Simulates pairs of scans, each in its own world. Writes\n"
    "        <set>/000000_source.bin <set>/000000_target.bin ...\n"
    "        pairs.csv, pairs_negative.csv (for --no_overlap) for "
    "run_pairs.py\n"
    "Run the same command again to add missing pairs.\n"
    "\n"
    "Exits with 0 if everything was written; 2 if a flag is invalid or a file\n"
    "cannot be written; 3 if a sequence was interrupted. Its folder is then\n"
    "restored.";

constexpr std::string_view kProtocols = "sequence, drive, pairs, calibration";

constexpr quatro::FlagUse kFlagUses[] = {
    {"num_frames", "sequence, drive"},
    {"frame_spacing", "sequence, drive"},
    {"overwrite", "sequence, drive"},
    {"slope_deg", "sequence"},
    {"tilt_sigma_deg", "sequence, drive, pairs"},
    {"drive", "drive"},
    {"sweep_motion", "drive"},
    {"layout", "drive"},
    {"moving_cars", "drive"},
    {"ins_noise_deg", "drive"},
    {"ins_bias_deg", "drive"},
    {"sensor", "drive, pairs"},
    {"world", "pairs"},
    {"pairs", "pairs"},
    {"min_distance", "pairs"},
    {"max_distance", "pairs"},
    {"max_yaw_deg", "pairs"},
    {"min_tilt_deg", "pairs"},
    {"max_tilt_deg", "pairs"},
    {"no_overlap", "pairs"},
    {"features", "pairs"},
    {"ins_std_deg", "pairs"},
    {"scale", "calibration"}};

// Returns whether the protocol is known and takes every given flag.
bool IsProtocolValid(std::string* error) {
  if (!quatro::IsListed(kProtocols, FLAGS_protocol)) {
    *error = "--protocol=" + FLAGS_protocol + ", must be one of " +
             std::string(kProtocols);
    return false;
  }
  return quatro::UsesAllFlags(FLAGS_protocol, kFlagUses, error);
}

// Angles are flags in degrees but options in radians, so their ranges are
// checked here; the options check the same ranges again.
bool AreAnglesValid(std::string* error) {
  struct Angle {
    const char* flag;
    double value;
    double lowest, highest;  // [deg]
  };
  const Angle angles[] = {
      {"slope_deg", FLAGS_slope_deg, -20.0, 20.0},
      {"tilt_sigma_deg", FLAGS_tilt_sigma_deg, 0.0, 11.0},
      {"ins_std_deg", FLAGS_ins_std_deg, 0.0, 11.0},
      {"ins_noise_deg", FLAGS_ins_noise_deg, 0.0, 11.0},
      {"ins_bias_deg", FLAGS_ins_bias_deg, 0.0, 11.0},
      {"max_yaw_deg", FLAGS_max_yaw_deg, 0.0, 180.0},
      {"max_tilt_deg", FLAGS_max_tilt_deg, 0.0, 17.0},
      {"min_tilt_deg", FLAGS_min_tilt_deg, 0.0, FLAGS_max_tilt_deg}};
  for (const auto& [flag, value, lowest, highest] : angles) {
    if (value >= lowest && value <= highest) continue;
    std::ostringstream range;
    range << "in [" << lowest << ", " << highest << "]";
    if (flag == std::string_view("min_tilt_deg")) {
      range << ", at most --max_tilt_deg";
    }
    *error = quatro::FlagProblem(flag, value, range.str());
    return false;
  }
  return true;
}

// For a sequence that was not completed.
int FailOrStop(const std::string& error) {
  if (!quatro::WasAskedToStop()) return quatro::Fail(error);
  quatro::EndProgressLine();
  std::fprintf(stderr, "interrupted; the partial sequence was removed\n");
  return quatro::kExitStopped;
}

std::optional<quatro::PairSetOptions> SetOfFlags() {
  const auto world = quatro::WorldByName(FLAGS_world);
  if (!world) return std::nullopt;
  quatro::PairSetOptions set;
  set.world = *world;
  set.num_pairs = FLAGS_pairs;
  set.seed = FLAGS_seed;
  set.min_distance = FLAGS_min_distance;
  set.max_distance = FLAGS_max_distance;
  set.max_yaw = FLAGS_max_yaw_deg * quatro::kDegree;
  set.min_tilt = FLAGS_min_tilt_deg * quatro::kDegree;
  set.max_tilt = FLAGS_max_tilt_deg * quatro::kDegree;
  set.no_overlap = FLAGS_no_overlap;
  set.num_features = FLAGS_features;
  set.sensor = FLAGS_sensor;
  set.tilt_sigma = FLAGS_tilt_sigma_deg * quatro::kDegree;
  set.ins_sigma = FLAGS_ins_std_deg * quatro::kDegree;
  return set;
}

int WriteDrive() {
  const auto names = quatro::DriveNames();
  if (std::ranges::find(names, FLAGS_drive) == names.end()) {
    std::string all;
    for (const std::string& name : names) all += " " + name;
    return quatro::Fail(
        quatro::FlagProblem("drive", FLAGS_drive, "one of" + all));
  }
  quatro::DriveOptions options;
  options.name = FLAGS_drive;
  options.seed = FLAGS_seed;
  options.num_frames = FLAGS_num_frames;
  options.frame_spacing = FLAGS_frame_spacing;
  options.sensor = FLAGS_sensor;
  options.has_sweep_motion = FLAGS_sweep_motion;
  options.num_moving_cars = FLAGS_moving_cars;
  options.tilt_sigma = FLAGS_tilt_sigma_deg * quatro::kDegree;
  options.ins_sigma = FLAGS_ins_noise_deg * quatro::kDegree;
  options.ins_bias_sigma = FLAGS_ins_bias_deg * quatro::kDegree;
  options.layout = FLAGS_layout;
  options.num_threads = FLAGS_threads;
  options.overwrite = FLAGS_overwrite;
  std::string error;
  if (!quatro::SimulateDrive(
          options, FLAGS_output, quatro::ProgressLine("scans"), &error)) {
    return FailOrStop(error);
  }
  return 0;
}

int WriteSets(const std::vector<quatro::PairSetOptions>& sets) {
  std::string error;
  if (!quatro::WritePairSets(sets,
                             FLAGS_output,
                             FLAGS_threads,
                             quatro::ProgressLine("pairs"),
                             &error)) {
    return quatro::Fail(error);
  }
  return 0;
}

int Main(int argc, char** argv) {
  using quatro::Fail;
  if (const auto exit_code = quatro::ParseFlags(kUsage, argc, argv)) {
    return *exit_code;
  }
  std::string error;
  if (!quatro::CanBeFolder({"output", FLAGS_output}, &error)) {
    return Fail(error);
  }
  if (!IsProtocolValid(&error) || !AreAnglesValid(&error)) return Fail(error);
  if (FLAGS_protocol == "pairs") {
    const auto set = SetOfFlags();
    if (set) return WriteSets({*set});
    std::string all;
    for (const std::string& name : quatro::WorldNames()) all += " " + name;
    return Fail(quatro::FlagProblem("world", FLAGS_world, "one of" + all));
  }
  if (FLAGS_protocol == "calibration") {
    if (!(FLAGS_scale > 0.0 && FLAGS_scale <= 100.0)) {
      return Fail(quatro::FlagProblem("scale", FLAGS_scale, "in (0, 100]"));
    }
    return WriteSets(quatro::CalibrationSets(FLAGS_seed, FLAGS_scale));
  }
  quatro::ListenForStop();
  if (FLAGS_protocol == "drive") return WriteDrive();

  quatro::SimulateSequenceOptions options;
  options.seed = FLAGS_seed;
  options.num_frames = FLAGS_num_frames;
  options.frame_spacing = FLAGS_frame_spacing;
  options.slope = FLAGS_slope_deg * quatro::kDegree;
  options.tilt_sigma = FLAGS_tilt_sigma_deg * quatro::kDegree;
  options.num_threads = FLAGS_threads;
  options.overwrite = FLAGS_overwrite;
  if (!quatro::SimulateSequence(
          options, FLAGS_output, quatro::ProgressLine("scans"), &error)) {
    return FailOrStop(error);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return quatro::RunProgram(Main, argc, argv); }
