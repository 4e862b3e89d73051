// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The pose that aligns points with given lines and planes,
//
//   R, t = argmin  sum_lines rho(|d x (R p + t - a)|^2)
//                + sum_planes rho((n . (R p + t - a))^2),                  (1)
//
// with Huber's rho, solved by Ceres on the quaternion manifold. Matches are
// fixed; the caller updates them at the new pose.
//
// There is no answer if the matches do not constrain all six degrees of
// freedom. Let H be the Hessian of (1) without rho, with rotations scaled by
// the root mean square distance of the points from their centroid. The matches
// are degenerate if the smallest eigenvalue of H is below min_conditioning
// times the largest. Examples are planes of one direction (open ground) or two
// (a straight tunnel).

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_LINE_PLANE_ALIGNMENT_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_LINE_PLANE_ALIGNMENT_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "experiments/odometry/aloam/line_plane_residuals.h"
#include "features/base/rigid3.h"

namespace quatro {

// The loss and the stopping criteria.
struct LinePlaneOptions {
  double huber_width = 0.1;  // [m]
  int max_num_iterations = 4;
  double min_conditioning = 1e-3;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The pose, or the reason why there is none.
struct LinePlaneSummary {
  std::optional<Rigid3> target_from_source;
  std::string message = "nothing was tried";

  double cost = 0.0;          // (1) at the end [m^2].
  double conditioning = 0.0;  // Smallest eigenvalue of H over largest.
};

// The matches of both kinds must be finite.
LinePlaneSummary AlignToLinesAndPlanes(const std::vector<SurfaceMatch>& lines,
                                       const std::vector<SurfaceMatch>& planes,
                                       const Rigid3& initial_target_from_source,
                                       const LinePlaneOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_LINE_PLANE_ALIGNMENT_H_
