// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// From a global answer to a precise one: local registration of the clouds
// (solvers/local/icp.h, gicp.h, vgicp.h) from the pose that matched points
// gave.
//
// Local registration always finds something near, so it is not trusted blindly.
// The refined pose takes the place of the other only if it
//
//   converged, held by the surfaces in every direction,
//   moved no farther than max_translation and max_rotation, and
//   is no stranger to the matches: of those within two noise bounds of the pose
//   before, q_i = R p_i + t, at least min_kept_matches times as many are so
//   after.
//
// Otherwise the pose before stands, and the message says why.

#ifndef QUATRO_ROBUST_REGISTRATION_REFINEMENT_H_
#define QUATRO_ROBUST_REGISTRATION_REFINEMENT_H_

#include <Eigen/Core>
#include <string>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "solvers/local/gicp.h"
#include "solvers/local/local_alignment.h"

namespace quatro {

// What refines the pose.
enum class RefinementMethod { kNone, kIcp, kGicp, kVgicp };

// "none", "icp", "gicp" or "vgicp".
const char* RefinementName(RefinementMethod method);

// The method, and when its answer is refused.
struct RefinementOptions {
  RefinementMethod method = RefinementMethod::kNone;
  LocalAlignmentOptions alignment;
  double epsilon = 1e-3;    // Of G-ICP and VG-ICP.
  double voxel_size = 1.0;  // Of VG-ICP [m].

  double max_translation = 2.0;   // Of the source's middle [m].
  double max_rotation = 0.3;      // [rad]
  double min_kept_matches = 0.5;  // In [0, 1].

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The pose after, and why it was taken or refused.
struct RefinementSummary {
  RefinementMethod method = RefinementMethod::kNone;
  AlignmentSummary alignment;

  bool is_accepted = false;
  std::string message;  // "refined", or why not.

  Rigid3 target_from_source;            // The refined pose iff accepted.
  Rigid3 unrefined_target_from_source;  // As given.

  // From the pose given to the one found, accepted or not; 0 without one.
  double moved_translation = 0.0;  // Of the source's middle [m].
  double moved_rotation = 0.0;     // [rad]

  // From unrefined_target_from_source.
  void SetMoved(const Eigen::Vector3d& source_middle, const Rigid3& found);
};

// Local registration by the method, from a pose. kNone gives no answer.
AlignmentSummary Align(const DescribedCloud& source,
                       const DescribedCloud& target,
                       const Rigid3& initial_target_from_source,
                       const RefinementOptions& options);

// Column i of `matched_source` is matched with column i of `matched_target`;
// `noise_bound` [m] is theirs.
RefinementSummary Refine(const DescribedCloud& source,
                         const DescribedCloud& target,
                         const PointsRef& matched_source,
                         const PointsRef& matched_target,
                         double noise_bound,
                         const Rigid3& target_from_source,
                         const RefinementOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_REFINEMENT_H_
