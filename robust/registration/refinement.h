// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Refines a global pose by local registration of the clouds
// (solvers/local/icp.h, gicp.h, vgicp.h).
//
// Local registration always converges to something nearby, so its result is
// checked. The refined pose is accepted only if
//
//   the alignment converged and the surfaces constrain every direction,
//   the pose moved by at most max_translation and max_rotation, and
//   the number of matches with a residual |q_i - R p_i - t| of at most two
//   noise bounds is at least min_kept_matches times that of the unrefined pose.
//
// Otherwise the unrefined pose is kept, and the message says why.

#ifndef QUATRO_ROBUST_REGISTRATION_REFINEMENT_H_
#define QUATRO_ROBUST_REGISTRATION_REFINEMENT_H_

#include <Eigen/Core>
#include <string>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "solvers/local/gicp.h"
#include "solvers/local/local_alignment.h"

namespace quatro {

// The method that refines the pose.
enum class RefinementMethod { kNone, kIcp, kGicp, kVgicp };

// "none", "icp", "gicp" or "vgicp".
const char* RefinementName(RefinementMethod method);

// The method, and when its result is rejected.
struct RefinementOptions {
  RefinementMethod method = RefinementMethod::kNone;
  LocalAlignmentOptions alignment;
  double epsilon = 1e-3;    // For G-ICP and VG-ICP.
  double voxel_size = 1.0;  // For VG-ICP [m].

  double max_translation = 2.0;   // Largest motion of the middle [m].
  double max_rotation = 0.3;      // [rad]
  double min_kept_matches = 0.5;  // In [0, 1].

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The refined pose, and why it was accepted or rejected.
struct RefinementSummary {
  RefinementMethod method = RefinementMethod::kNone;
  AlignmentSummary alignment;

  bool is_accepted = false;
  std::string message;  // "refined", or why not.

  Rigid3 target_from_source;            // The refined pose iff accepted.
  Rigid3 unrefined_target_from_source;  // As given.

  // The motion from the unrefined to the refined pose, accepted or not; 0
  // without a refined pose.
  double moved_translation = 0.0;  // Motion of the source's middle [m].
  double moved_rotation = 0.0;     // [rad]

  // Sets the motion from unrefined_target_from_source to `found`.
  void SetMoved(const Eigen::Vector3d& source_middle, const Rigid3& found);
};

// Runs local registration from a pose. kNone gives no pose.
AlignmentSummary Align(const DescribedCloud& source,
                       const DescribedCloud& target,
                       const Rigid3& initial_target_from_source,
                       const RefinementOptions& options);

// Column i of `matched_source` is matched with column i of `matched_target`;
// `noise_bound` is that of the matches [m].
RefinementSummary Refine(const DescribedCloud& source,
                         const DescribedCloud& target,
                         const PointsRef& matched_source,
                         const PointsRef& matched_target,
                         double noise_bound,
                         const Rigid3& target_from_source,
                         const RefinementOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_REFINEMENT_H_
