// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/datasets/open_dataset.h"

#include "experiments/datasets/any_sequence.h"
#include "experiments/datasets/kitti_odometry.h"
#include "experiments/datasets/kitti_pair_list.h"
#include "experiments/datasets/pairs_csv.h"

namespace quatro {
namespace {

std::optional<SequenceData> OpenDrive(const DatasetOptions& options,
                                      const std::string& name,
                                      std::string* error) {
  if (options.poses.empty()) {
    return ReadAnySequence({options.folder, name}, error);
  }
  KittiOdometryOptions kitti;
  kitti.folder = options.folder;
  kitti.sequence = name;
  kitti.poses = options.poses;
  return ReadKittiOdometry(kitti, error);
}

}  // namespace

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
    auto drive = OpenDrive(options, name, error);
    if (!drive) return std::nullopt;
    drives.push_back(std::move(*drive));
  }
  return drives;
}

std::optional<PairSelection> OpenPairList(const std::string& list,
                                          const std::string& folder,
                                          std::string* error) {
  if (list.empty()) {
    *error = "--pairs is empty, must name a list";
    return std::nullopt;
  }
  if (list.ends_with(".csv")) return ReadPairsCsv(list, error);
  if (folder.empty()) {
    *error =
        "--data is empty, must name the folder of the sequences in " + list;
    return std::nullopt;
  }
  KittiPairListOptions options;
  options.list = list;
  options.folder = folder;
  return ReadKittiPairList(options, error);
}

}  // namespace quatro
