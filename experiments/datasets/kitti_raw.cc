// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/datasets/kitti_raw.h"

#include <cstdio>
#include <filesystem>
#include <system_error>

#include "experiments/datasets/oxts.h"
#include "experiments/datasets/sequence.h"

namespace quatro {

namespace fs = std::filesystem;

std::optional<SequenceData> ReadKittiRaw(const std::string& folder,
                                         std::string* error) {
  fs::path drive = fs::absolute(folder).lexically_normal();
  if (!drive.has_filename()) drive = drive.parent_path();
  SequenceData data;
  data.name = drive.filename().string();

  const fs::path velodyne = drive / "velodyne_points" / "data";
  auto scans = ListScans(velodyne.string(), error);
  if (!scans) return std::nullopt;
  data.scans = std::move(*scans);

  std::error_code ignored;
  fs::path calibration = drive / "calib_imu_to_velo.txt";
  if (!fs::exists(calibration, ignored)) {
    calibration = drive.parent_path() / "calib_imu_to_velo.txt";
  }
  const auto velodyne_from_imu = ReadImuToVelodyne(calibration.string(), error);
  if (!velodyne_from_imu) return std::nullopt;
  const auto readings = ReadOxts((drive / "oxts").string(), error);
  if (!readings) return std::nullopt;
  for (const auto& [frame, world_from_imu] : PosesOfOxts(*readings)) {
    data.world_from_sensor[frame] =
        world_from_imu * Inverse(*velodyne_from_imu);  // (1)
  }
  CountMissing(
      [&](int frame) {
        char name[32];
        std::snprintf(name, sizeof(name), "%010d.bin", frame);
        return (velodyne / name).string();
      },
      &data);
  return data;
}

}  // namespace quatro
