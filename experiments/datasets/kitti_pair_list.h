// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Published lists of pairs of KITTI odometry, kitti_10m and kitti_lc: a line of
// names, then one a pair,
//
//   seq i seq j m1 ... m16,
//
// where the 4x4 matrix m, row by row, moves velodyne points of frame i (the
// source) into frame j. kitti_lc_0_10, _10_20 and _20_30 hold loops more than
// 250 frames apart by their distance [m], kitti_10m neighbours 10 m apart. The
// sequences are folders as kitti_odometry.h finds them.

#ifndef QUATRO_EXPERIMENTS_DATASETS_KITTI_PAIR_LIST_H_
#define QUATRO_EXPERIMENTS_DATASETS_KITTI_PAIR_LIST_H_

#include <optional>
#include <string>

#include "experiments/datasets/pair_selection.h"

namespace quatro {

struct KittiPairListOptions {
  std::string list;

  // That holds the sequences, as sequences/00 or the like. Empty: tasks name no
  // scans, which does for looking at their poses.
  std::string folder;

  // Each pair gets the INS that kitti_odometry.h finds, where it finds any.
  bool has_ins = true;
  double ins_std = 0.0087;  // [rad]

  // 8 15 8 58 of kitti_10m is off by 35 m, and left out.
  bool keeps_known_wrong = false;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// In the order of the file; sets "00", bins "10-20 m" by the list's name or
// that name itself ("kitti_10m"). Nullopt with one line in *error, which names
// file and line, for anything else than the above. Scans that are missing are
// counted and noted, and so are pairs left out.
std::optional<PairSelection> ReadKittiPairList(
    const KittiPairListOptions& options, std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_KITTI_PAIR_LIST_H_
