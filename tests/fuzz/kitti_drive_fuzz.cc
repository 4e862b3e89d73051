// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A drive of KITTI odometry and one of KITTI raw, in the text of their files:
// "== calib.txt", "== oxts/data/0000000000.txt", ... (SplitFiles).

#include "experiments/datasets/kitti_odometry.h"
#include "experiments/datasets/kitti_raw.h"
#include "tests/fuzz/fuzz.h"

namespace quatro {
namespace {

const std::vector<std::string> kNames = {"calib.txt",
                                         "poses.txt",
                                         "ins.txt",
                                         "calib_imu_to_velo.txt",
                                         "oxts/data/0000000000.txt",
                                         "oxts/data/0000000001.txt"};

// With two scans, which are not read.
const std::string& Folder() {
  static const ScratchFolder folder;
  static const bool is_new = [] {
    for (const char* name : {"velodyne", "velodyne_points/data", "oxts/data"}) {
      std::filesystem::create_directories(folder.path() + "/" + name);
    }
    for (const char* name : {"velodyne/000000.bin",
                             "velodyne/000001.bin",
                             "velodyne_points/data/0000000000.bin",
                             "velodyne_points/data/0000000001.bin"}) {
      folder.Write(name, "");
    }
    return true;
  }();
  CHECK(is_new);
  return folder.path();
}

void Check(const std::optional<SequenceData>& data, const std::string& error) {
  if (!data) {
    CheckIsOneLine(error);
    return;
  }
  for (const auto& [frame, pose] : data->world_from_sensor) {
    CHECK_GE(frame, 0);
    CHECK(pose.ToMatrix().allFinite()) << frame;
  }
  for (const std::string& note : data->notes) CheckIsOneLine(note);
}

}  // namespace
}  // namespace quatro

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const std::string& folder = quatro::Folder();
  const auto files =
      quatro::SplitFiles(quatro::AsText(data, size), quatro::kNames);
  for (const std::string& name : quatro::kNames) {
    const std::string path = folder + "/" + name;
    const auto file = files.find(name);
    if (file == files.end()) {
      std::filesystem::remove(path);
    } else {
      std::ofstream(path, std::ios::binary) << file->second;
    }
  }
  std::string error;
  quatro::KittiOdometryOptions options;
  options.folder = folder;
  if (files.contains("ins.txt")) options.ins_poses = folder + "/ins.txt";
  quatro::Check(quatro::ReadKittiOdometry(options, &error), error);
  quatro::Check(quatro::ReadKittiRaw(folder, &error), error);
  return 0;
}
