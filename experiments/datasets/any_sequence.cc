// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/datasets/any_sequence.h"

#include <filesystem>
#include <system_error>

#include "experiments/datasets/kitti_odometry.h"
#include "experiments/datasets/kitti_raw.h"
#include "experiments/datasets/naver.h"

namespace quatro {

namespace fs = std::filesystem;

std::optional<SequenceData> ReadAnySequence(const AnySequenceOptions& options,
                                            std::string* error) {
  const fs::path folder = options.sequence.empty()
                              ? fs::path(options.folder)
                              : fs::path(options.folder) / options.sequence;
  const auto has = [&](const char* below) {
    std::error_code ignored;
    return fs::is_directory(folder / below, ignored);
  };
  if (has("velodyne_points")) return ReadKittiRaw(folder.string(), error);
  if (has("sensors") || has("mapping/sensors") ||
      has("release/mapping/sensors")) {
    NaverOptions naver;
    naver.folder = folder.string();
    naver.ins_std = options.ins_std;
    return ReadNaver(naver, error);
  }
  KittiOdometryOptions kitti;
  kitti.folder = options.folder;
  kitti.sequence = options.sequence;
  kitti.ins_std = options.ins_std;
  return ReadKittiOdometry(kitti, error);
}

}  // namespace quatro
