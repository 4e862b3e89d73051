// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gflags/gflags.h>

#include <cmath>
#include <string>

#include "experiments/program.h"
#include "experiments/progress_line.h"
#include "experiments/simulator.h"

DEFINE_string(output, "", "Folder to write; its parents are created. Required");
DEFINE_uint64(seed, 1, "Of the street and the noise; same seed, same files");
DEFINE_int32(num_frames, 100, "Scans to write");
DEFINE_double(frame_spacing, 1.0, "From one scan to the next [m]");
DEFINE_double(slope_deg, 0.0, "Climb of the street [deg]");
DEFINE_double(tilt_sigma_deg,
              0.3,
              "Standard deviation of the car's roll and pitch on its springs "
              "[deg]");
DEFINE_int32(threads, 0, "0: one per core. The files don't depend on it");
DEFINE_bool(overwrite, false, "Replace the sequence that --output holds");

namespace {

constexpr char kUsage[] =
    "simulates a car that drives along a street with a Velodyne HDL-64E and\n"
    "writes its scans and their true poses in the layout of KITTI odometry.\n"
    "\n"
    "  quatro_simulate --output=street --num_frames=50 --slope_deg=5\n"
    "\n"
    "Writes  velodyne/000000.bin ...  float32 x y z intensity\n"
    "        poses.txt calib.txt times.txt\n"
    "Points of frame i are moved into frame j by Tr^-1 P_j^-1 P_i Tr.\n"
    "Exits with 0 if all was written, 2 if a flag is wrong or a file can't be\n"
    "written; the folder is then as it was before.";

constexpr double kDegree = M_PI / 180.0;

}  // namespace

int main(int argc, char** argv) {
  using quatro::Fail;
  if (const auto exit_code =
          quatro::ParseFlags(kUsage, "simulate_main", argc, argv)) {
    return *exit_code;
  }
  if (FLAGS_output.empty())
    return Fail("--output is empty, must name a folder");

  quatro::SimulateSequenceOptions options;
  options.seed = FLAGS_seed;
  options.num_frames = FLAGS_num_frames;
  options.frame_spacing = FLAGS_frame_spacing;
  options.slope = FLAGS_slope_deg * kDegree;
  options.tilt_sigma = FLAGS_tilt_sigma_deg * kDegree;
  options.num_threads = FLAGS_threads;
  options.overwrite = FLAGS_overwrite;
  std::string error;
  if (!quatro::SimulateSequence(
          options, FLAGS_output, quatro::ProgressLine("scans"), &error)) {
    return Fail(error);
  }
  return 0;
}
