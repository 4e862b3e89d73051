// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Recognizes files of poses, which could be taken for clouds because their rows
// are numbers, too.

#ifndef QUATRO_FEATURES_IO_TRAJECTORY_ROWS_H_
#define QUATRO_FEATURES_IO_TRAJECTORY_ROWS_H_

#include <string_view>
#include <vector>

namespace quatro {

// Collects the rows of a file of numbers and recognizes two formats:
//   TUM     time tx ty tz qx qy qz qw, times increase and |q| = 1
//   KITTI   the first three rows of [R t; 0 1], R a rotation
// A cloud whose every row looks like this by chance is not expected.
class TrajectoryRows {
 public:
  // All rows have as many numbers as the first.
  void Add(const std::vector<double>& row);

  // Whether the rows so far can be those of a trajectory.
  bool MayBeTrajectory() const { return is_tum_ || is_kitti_; }

  // "TUM" or "KITTI"; empty for other numbers, or with fewer than two rows.
  std::string_view Format() const;

 private:
  int num_rows_ = 0;
  bool is_tum_ = true;
  bool is_kitti_ = true;
  double time_ = 0;
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_TRAJECTORY_ROWS_H_
