// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Drift of an odometry as defined by the KITTI benchmark. With the true poses
// P_i, the estimated poses Q_i, and the length s_i of the true path up to frame
// i, a segment of length L starts at every step-th frame f and ends at the
// first frame l with s_l > s_f + L. Its error is
//
//   E = (Q_f^-1 Q_l)^-1 (P_f^-1 P_l),                                      (1)
//   t = |translation of E| / L,   r = angle of E / L,
//
// for L = 100, 200, ... 800 m as far as the path goes. t_rel and r_rel are the
// means over all segments of all lengths. Swapping truth and estimate changes
// neither |translation| nor angle, only the ends of the segments.
//
// Source: evaluate_odometry.cpp of the benchmark's development kit, for the
// definition (Geiger et al., CVPR 2012).

#ifndef QUATRO_EXPERIMENTS_METRICS_KITTI_METRICS_H_
#define QUATRO_EXPERIMENTS_METRICS_KITTI_METRICS_H_

#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"

namespace quatro {

struct KittiDriftOptions {
  std::vector<double> lengths = {
      100.0, 200.0, 300.0, 400.0, 500.0, 600.0, 700.0, 800.0};  // [m]
  int step = 10;  // Frames between starts of segments.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

struct KittiSegment {
  std::size_t first = 0, last = 0;  // Frames.
  double length = 0.0;              // L [m]
  double translation_error = 0.0;   // t [m/m]
  double rotation_error = 0.0;      // r [rad/m]
};

struct KittiDrift {
  std::vector<KittiSegment> segments;  // Empty for paths below 100 m.

  // The means over the segments; NaN if there are none.
  double translation_percent = 0.0;
  double rotation_deg_per_100m = 0.0;

  // The error from the first to the last frame, for paths of any length.
  double path_length = 0.0;            // [m]
  double end_translation_error = 0.0;  // [m]
  double end_rotation_error = 0.0;     // [rad]
};

// Returns nullopt with *error set if there are no poses, if the numbers of
// poses differ, or if an option is out of range.
std::optional<KittiDrift> ComputeKittiDrift(
    const std::vector<Rigid3>& true_poses,
    const std::vector<Rigid3>& estimated_poses,
    const KittiDriftOptions& options,
    std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_METRICS_KITTI_METRICS_H_
