// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gflags/gflags.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "experiments/programs/bound_flags.h"
#include "experiments/programs/flag_problems.h"
#include "experiments/programs/json_report.h"
#include "experiments/programs/program.h"
#include "features/base/degree.h"
#include "features/io/cloud_io.h"
#include "robust/registration/alignment_check.h"
#include "robust/registration/presets.h"

DEFINE_string(source,
              "",
              "The cloud that the pose moves: .bin (KITTI), .ply, .pcd, .npy, "
              ".xyz, .txt or .csv, or one of these with .gz");
DEFINE_string(target, "", "The cloud that it is moved onto");
DEFINE_string(pose,
              "",
              "target_from_source: 12 or 16 numbers, the rows of a matrix, or "
              "x,y,z,yaw_deg; or a file with these or the JSON of "
              "quatro_register");
DEFINE_double(max_translation,
              0.1,
              "Translation by which an aligned pose may be off [m]");
DEFINE_double(max_rotation_deg,
              0.573,
              "Rotation by which an aligned pose may be off [deg]");
DEFINE_double(voxel_size, 0.0, "Voxel size [m]; 0: from the clouds");
DEFINE_int32(threads, 0, "Threads; 0: one per core. Never change the answer");

namespace {

constexpr char kUsage[] =
    "checks whether two clouds are aligned by a pose from any source.\n"
    "\n"
    "  quatro_check_alignment --source=a.bin --target=b.bin "
    "--pose=1,0,0,2.5\n"
    "\n"
    "Prints JSON. Exits with 0 if the clouds are aligned; 1 if not (the JSON\n"
    "says how far away the surfaces fit); 2 if a flag or a file is invalid.";

quatro::Json Report(const quatro::AlignmentCheck& check, double voxel_size) {
  return {{"aligned", check.is_aligned},
          {"message", check.message},
          {"ratio", check.ratio},
          {"moved_m", check.moved_translation},
          {"moved_deg", check.moved_rotation * quatro::kRadian},
          {"contacts", check.num_contacts},
          {"nearest_target_from_source", quatro::Rows(check.nearest)},
          {"parameters",
           {{"source", FLAGS_source},
            {"target", FLAGS_target},
            {"pose", FLAGS_pose},
            {"max_translation", FLAGS_max_translation},
            {"max_rotation_deg", FLAGS_max_rotation_deg},
            {"voxel_size", voxel_size}}},
          {"version", quatro::Version()}};
}

int Main(int argc, char** argv) {
  using quatro::Fail;
  if (const auto exit_code = quatro::ParseFlags(kUsage, argc, argv)) {
    return *exit_code;
  }
  if (FLAGS_source.empty()) return Fail("--source is empty, must name a cloud");
  if (FLAGS_target.empty()) return Fail("--target is empty, must name a cloud");
  if (FLAGS_pose.empty()) return Fail("--pose is empty, must be a pose");
  const auto check_flag = [](const char* name, double value, bool is_positive) {
    return is_positive && std::isfinite(value)
               ? std::string()
               : quatro::FlagProblem(name, value, "> 0 and finite");
  };
  for (const std::string& problem :
       {check_flag("max_translation",
                   FLAGS_max_translation,
                   FLAGS_max_translation > 0.0),
        check_flag("max_rotation_deg",
                   FLAGS_max_rotation_deg,
                   FLAGS_max_rotation_deg > 0.0),
        check_flag("voxel_size", FLAGS_voxel_size, FLAGS_voxel_size >= 0.0)}) {
    if (!problem.empty()) return Fail(problem);
  }
  if (FLAGS_threads < 0) {
    return Fail(quatro::FlagProblem("threads", FLAGS_threads, ">= 0"));
  }
  std::string error;
  const auto pose = quatro::ParsePose("pose", FLAGS_pose, &error);
  if (!pose) return Fail(error);
  const auto source = quatro::ReadCloud(FLAGS_source, &error);
  if (!source) return Fail(error);
  const auto target = quatro::ReadCloud(FLAGS_target, &error);
  if (!target) return Fail(error);
  quatro::AlignmentCheckOptions options;
  options.translation = FLAGS_max_translation;
  options.rotation = FLAGS_max_rotation_deg * quatro::kDegree;
  options.voxel_size =
      FLAGS_voxel_size > 0.0
          ? FLAGS_voxel_size
          : quatro::MakeAutoOptions(*source, *target).front_end.voxel_size;
  options.num_threads = FLAGS_threads;
  const quatro::AlignmentCheck check =
      quatro::CheckAlignment(*source, *target, *pose, options);
  if (!check.error.empty()) return Fail(check.error);
  std::fprintf(stderr, "%s\n", check.message.c_str());
  std::printf("%s\n",
              Report(check, options.voxel_size)
                  .dump(2, ' ', false, quatro::Json::error_handler_t::replace)
                  .c_str());
  return check.is_aligned ? quatro::kExitDone : quatro::kExitNotVouchedFor;
}

}  // namespace

int main(int argc, char** argv) { return quatro::RunProgram(Main, argc, argv); }
