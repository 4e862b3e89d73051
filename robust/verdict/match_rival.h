// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The best other pose: is there a second consensus nearly as good elsewhere?
//
// Two kinds are looked for, with D the motion that takes one pose to the other:
//
//   same matches   most of those that agree with the pose agree with D, too.
//                  They lie on one pole or crowd in one place, where a yaw
//                  moves little: D turns about them.
//   other matches  a consensus among those far from agreeing: a twin of the
//                  place, by symmetry or repetition, or the right pose where
//                  the one given is a twin. D is any yaw and translation.
//
// Of k matches that agree with the pose and l with the rival, the margin
//
//   z = (k - l) / sqrt(k + l)                                              (1)
//
// is the difference of two counts in units of its standard deviation, had both
// poses the same rate (counts are Poisson): below 2 or so, neither is preferred
// by the matches.

#ifndef QUATRO_ROBUST_VERDICT_MATCH_RIVAL_H_
#define QUATRO_ROBUST_VERDICT_MATCH_RIVAL_H_

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

// From where on another pose is another answer, and how hard it is looked for.
struct MatchRivalOptions {
  // A rival turns by this [rad], or moves the middle of the matches that agree
  // by this many noise bounds. Nearer poses are the same answer.
  double min_rotation = 0.1745;
  double min_shift_factor = 6.0;

  // Pairs of matches and matches looked at (robust/estimators/arc_consensus.h):
  // a rival with a share of e of them is found if the first times e^2 is 50 or
  // more.
  Eigen::Index num_pairs = 200'000;
  Eigen::Index max_num_matches = 20'000;

  std::uint64_t seed = 0;
  int num_threads = 1;  // 0: all cores. Never changes the answer.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The best other pose by matches.
struct MatchRival {
  Rigid3 target_from_source;
  Eigen::Index num_inliers = 0;  // l
  bool has_same_matches = false;
  double margin = 0.0;  // (1)
};

// The rival with which most matches agree. `noise_bound` [m], on each axis.
// Columns are matches, each there once. Nullopt if no two matches agree with
// any.
std::optional<MatchRival> FindMatchRival(const PointsRef& source,
                                         const PointsRef& target,
                                         const Rigid3& target_from_source,
                                         double noise_bound,
                                         const MatchRivalOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_MATCH_RIVAL_H_
