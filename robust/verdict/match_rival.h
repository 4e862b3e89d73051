// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The match rival: the other pose with the most inliers.
//
// There are two kinds of rivals. D is the motion from the pose to the rival:
//
//   same matches   most inliers of the pose are also inliers of the rival. They
//                  lie on one pole or close together, where a yaw moves them
//                  little: D rotates about them.
//   other matches  a consensus among the matches far from being inliers: a twin
//                  of the place, by symmetry or repetition, or the correct pose
//                  if the given one is a twin. D is any yaw and translation.
//
// If the pose has k inliers and the rival l, the margin
//
//   z = (k - l) / sqrt(k + l)                                              (1)
//
// is the difference of the counts in units of its standard deviation under the
// assumption that both are Poisson with the same rate. Below about 2 the
// matches prefer neither pose.

#ifndef QUATRO_ROBUST_VERDICT_MATCH_RIVAL_H_
#define QUATRO_ROBUST_VERDICT_MATCH_RIVAL_H_

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "robust/estimators/pose_bounds.h"

namespace quatro {

// Which poses count as rivals, and how thorough the search is.
struct MatchRivalOptions {
  // A rival differs from the pose in rotation by at least min_rotation [rad],
  // or moves the mean of the inliers by at least min_shift_factor noise bounds.
  // Closer poses count as the same pose.
  double min_rotation = 0.1745;
  double min_shift_factor = 6.0;

  // The number of random pairs and of matches in the search
  // (robust/estimators/arc_consensus.h). A rival with a share e of the matches
  // as inliers is found if num_pairs * e^2 >= 50.
  Eigen::Index num_pairs = 200'000;
  Eigen::Index max_num_matches = 20'000;

  // A pose outside of the bounds is not a rival.
  PoseBounds bounds;

  std::uint64_t seed = 0;
  int num_threads = 1;  // 0: all cores. Never changes the answer.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The other pose with the most inliers.
struct MatchRival {
  Rigid3 target_from_source;
  Eigen::Index num_inliers = 0;  // l
  bool has_same_matches = false;
  double margin = 0.0;  // (1)
};

// Returns the rival with the most inliers, or nullopt if none has two.
// `noise_bound` is the bound on each axis of the target frame (half the edge of
// a box) [m]. Columns are matches without duplicates.
std::optional<MatchRival> FindMatchRival(const PointsRef& source,
                                         const PointsRef& target,
                                         const Rigid3& target_from_source,
                                         double noise_bound,
                                         const MatchRivalOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_MATCH_RIVAL_H_
