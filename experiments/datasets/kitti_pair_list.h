// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Published lists of pairs of KITTI odometry, kitti_10m and kitti_lc. After a
// header line, each line describes one pair,
//
//   seq i seq j m1 ... m16,
//
// where the 4x4 matrix m, row by row, moves velodyne points of frame i (the
// source) into frame j. kitti_lc_0_10, _10_20 and _20_30 contain loops more
// than 250 frames apart, by distance [m]; kitti_10m contains neighbors 10 m
// apart. The sequences are folders as in kitti_odometry.h.

#ifndef QUATRO_EXPERIMENTS_DATASETS_KITTI_PAIR_LIST_H_
#define QUATRO_EXPERIMENTS_DATASETS_KITTI_PAIR_LIST_H_

#include <optional>
#include <string>

#include "experiments/datasets/pair_selection.h"

namespace quatro {

struct KittiPairListOptions {
  std::string list;

  // The folder with the sequences as sequences/00 and so on. If it is empty,
  // tasks name no scans, which suffices for an analysis of the poses.
  std::string folder;

  // Adds to each pair the INS that kitti_odometry.h finds, if any.
  bool has_ins = true;
  double ins_std = 0.0087;  // [rad]

  // Pair 8 15 8 58 of kitti_10m has a pose error of 35 m and is left out unless
  // this is set.
  bool keeps_known_wrong = false;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Pairs in the order of the file. Sets are "00" and so on; bins come from the
// list's name ("10-20 m") or are that name ("kitti_10m"). Returns nullopt with
// one line in *error, which names file and line, if the list is invalid.
// Missing scans are counted and noted, and so are omitted pairs.
std::optional<PairSelection> ReadKittiPairList(
    const KittiPairListOptions& options, std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_KITTI_PAIR_LIST_H_
