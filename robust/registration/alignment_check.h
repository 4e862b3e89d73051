// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Checks whether two clouds are aligned by a pose from any source, for example
// another program or an edge of a pose graph.
//
// G-ICP (solvers/local/gicp.h) starts at the pose and ends at the nearest pose
// at which the surfaces fit. With v = (w, u) the motion from one to the other
// about the center of the contacts, and A the information of the surfaces
// (robust/verdict/surface_observability.h), the surfaces move along their
// normals by D and would by D_0 if the pose were off by the tolerances:
//
//   D^2 = v^T A v,   D_0^2 = (r^2 tr A_ww + t^2 tr A_uu) / 3.              (1)
//
// The pose is aligned if D < D_0 / 2. A motion along the surfaces, as in a
// corridor, does not count. The check answers for the vicinity of the pose
// only: an incorrect pose may be aligned, for example in a corridor or one bay
// further along a facade. The verdict (robust/verdict/verdict.h) asks for more.

#ifndef QUATRO_ROBUST_REGISTRATION_ALIGNMENT_CHECK_H_
#define QUATRO_ROBUST_REGISTRATION_ALIGNMENT_CHECK_H_

#include <Eigen/Core>
#include <string>

#include "features/base/rigid3.h"
#include "features/io/point_cloud.h"

namespace quatro {

// The tolerances, and how the clouds are sampled.
struct AlignmentCheckOptions {
  double translation = 0.1;  // t of (1) [m].
  double rotation = 0.01;    // r of (1) [rad].
  double voxel_size = 0.3;   // [m]
  int num_threads = 1;       // 0: all cores. Never changes the answer.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The answer, and the aligned pose nearest to the given one.
struct AlignmentCheck {
  // Why there is no answer: an option, the pose or a cloud is invalid.
  std::string error;

  bool is_aligned = false;
  std::string message;  // The answer in words, or why it is no.

  double ratio = 0.0;              // D / D_0; 0 if it was not computed.
  Rigid3 nearest;                  // The pose where G-ICP ended.
  double moved_translation = 0.0;  // |u| [m]
  double moved_rotation = 0.0;     // |w| [rad]
  Eigen::Index num_contacts = 0;   // Overlapping points of both clouds.
};

// Checks a pose of two clouds.
AlignmentCheck CheckAlignment(const PointCloud& source,
                              const PointCloud& target,
                              const Rigid3& target_from_source,
                              const AlignmentCheckOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_ALIGNMENT_CHECK_H_
