// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The consensus of the segments of two scans (features/segments.h): poses that
// it proposes, in addition to those of the matches, and how well it supports
// any pose. With yaw alone, a pose maps
//
//   a wall (n, d) to (R n, d + (R n) . t),   a post at c to R c + t,       (1)
//
// so a pair of walls determines the yaw, up to the error of a normal, and an
// interval of t along the normal; a pair of posts determines t for each yaw. At
// each step of yaw, every pair votes for the cells of t that it allows, a pair
// of walls only as far as the walls then overlap. The fullest cells are fitted
// by least squares to the pairs that agree with them.
//
// A pose with v votes is compared with the mean lambda of the cells with votes
// at its yaw,
//
//   v ln(v / lambda) - (v - lambda)  if v > lambda, else 0.                (2)
//
// The walls of a street are parallel, so they give many votes at two or four
// yaws by chance.

#ifndef QUATRO_ROBUST_REGISTRATION_SEGMENT_CONSENSUS_H_
#define QUATRO_ROBUST_REGISTRATION_SEGMENT_CONSENSUS_H_

#include <Eigen/Core>
#include <vector>

#include "features/base/rigid3.h"
#include "features/segments.h"

namespace quatro {

// A source and a target wall that may be the same.
struct WallPair {
  Wall source;
  Wall target;
  double yaw = 0.0;  // From the source's normal to the target's [rad].
};

// A source and a target post that may be the same.
struct PostPair {
  Post source;
  Post target;
};

// Counts votes once; afterwards its functions are thread-safe. z is up, and the
// origins are near the sensors: translations of more than 1,024 noise bounds in
// x or y are not found.
class SegmentConsensus {
 public:
  // Pairs agree with a pose within `noise_bound` [m].
  SegmentConsensus(const Segments& source,
                   const Segments& target,
                   double noise_bound);

  // At most `max_num` poses that differ, the best by (2) first. The height is
  // the median difference of the lower ends.
  std::vector<Rigid3> Propose(int max_num) const;

  // The ratio (2) for any pose [nat]. The tilt of the pose is ignored.
  double LogLikelihoodRatio(const Rigid3& target_from_source) const;

 private:
  // A pose in the plane.
  struct Planar {
    double yaw = 0.0;
    Eigen::Vector2d translation = Eigen::Vector2d::Zero();
    double ratio = 0.0;  // (2)
  };

  // The pairs that agree with a pose.
  struct Agreeing {
    std::vector<const WallPair*> walls;
    std::vector<const PostPair*> posts;
    double votes = 0.0;
  };

  class Ballot;

  Agreeing FindAgreeing(const Planar& pose, double noise_bound) const;

  // Fits the pose to pairs by least squares. Returns false if they do not
  // determine it.
  static bool Fit(const Agreeing& agreeing, Planar* pose);

  // (2), by the mean at the yaw.
  double RatioOf(double votes, double yaw) const;

  double noise_bound_;
  std::vector<WallPair> walls_;
  std::vector<PostPair> posts_;
  std::vector<double> means_;    // lambda at each step of yaw.
  std::vector<Planar> fullest_;  // The fullest cells, the best first.
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_SEGMENT_CONSENSUS_H_
