// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/datasets/open_dataset.h"

#include "experiments/datasets/kitti_odometry.h"

namespace quatro {

std::optional<std::vector<SequenceData>> OpenDataset(
    const DatasetOptions& options, std::string* error) {
  if (options.folder.empty()) {
    *error = "--data is empty, must name a folder";
    return std::nullopt;
  }
  std::vector<std::string> names = options.sequences;
  if (names.empty()) names = ListKittiSequences(options.folder);
  if (names.empty()) names = {""};
  if (names.size() > 1 && !options.poses.empty()) {
    *error = "--poses is of one drive, but there are " +
             std::to_string(names.size());
    return std::nullopt;
  }
  std::vector<SequenceData> drives;
  for (const std::string& name : names) {
    KittiOdometryOptions kitti;
    kitti.folder = options.folder;
    kitti.sequence = name;
    kitti.poses = options.poses;
    auto drive = ReadKittiOdometry(kitti, error);
    if (!drive) return std::nullopt;
    drives.push_back(std::move(*drive));
  }
  return drives;
}

}  // namespace quatro
