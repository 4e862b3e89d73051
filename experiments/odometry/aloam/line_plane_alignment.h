// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The pose that brings points onto given lines and planes,
//
//   R, t = argmin  sum_lines rho(|d x (R p + t - a)|^2)
//                + sum_planes rho((n . (R p + t - a))^2),                  (1)
//
// rho that of Huber, by Ceres on the quaternion manifold. Matches are held: the
// caller finds them again at the pose that comes out.
//
// No answer where the matches do not hold all six freedoms: with H the Hessian
// of (1) without rho, turns scaled by the points' root mean square distance
// from their middle, its least eigenvalue is below min_conditioning of the
// largest. Planes of one direction (open ground) or two (a straight tunnel) are
// such.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_LINE_PLANE_ALIGNMENT_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_LINE_PLANE_ALIGNMENT_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "experiments/odometry/aloam/line_plane_residuals.h"
#include "features/base/rigid3.h"

namespace quatro {

// The loss and the end of the search.
struct LinePlaneOptions {
  double huber_width = 0.1;  // [m]
  int max_num_iterations = 4;
  double min_conditioning = 1e-3;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The pose, or why there is none.
struct LinePlaneSummary {
  std::optional<Rigid3> target_from_source;
  std::string message = "nothing was tried";

  double cost = 0.0;          // (1) at the end [m^2].
  double conditioning = 0.0;  // Least eigenvalue of H over the largest.
};

// Both kinds of matches together must be finite.
LinePlaneSummary AlignToLinesAndPlanes(const std::vector<SurfaceMatch>& lines,
                                       const std::vector<SurfaceMatch>& planes,
                                       const Rigid3& initial_target_from_source,
                                       const LinePlaneOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_LINE_PLANE_ALIGNMENT_H_
