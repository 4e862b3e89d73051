// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Point-to-plane alignment of a scan with a rendered model. Matches are found
// by projection instead of a search:
//
//   R, t = argmin  sum_i rho( (n_i . (R p_i + t - q_i))^2 ),                (1)
//
// where q_i and n_i are the model's vertex and normal in the pixel into which R
// p_i + t falls, if the points are close enough and the normals similar. rho is
// Huber's. Matches and weights are updated at each Gauss-Newton step,
//
//   (J^T W J) (w, d) = -J^T W r,   R <- exp(w) R,  t <- exp(w) t + d.      (2)
//
// There is no answer if fewer than min_num_matches points have a match, or if
// the matches do not constrain all six degrees of freedom: the smallest
// eigenvalue of J^T W J is below min_conditioning times the largest, with
// rotations scaled by the mean distance of the points.
//
// Source: SuMa (see experiments/odometry/suma/vertex_map.h), Section III.C,
// equations (8)-(11).

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_SUMA_PROJECTIVE_ICP_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_SUMA_PROJECTIVE_ICP_H_

#include <Eigen/Core>
#include <optional>
#include <string>

#include "experiments/odometry/suma/vertex_map.h"
#include "features/base/rigid3.h"

namespace quatro {

// Criteria for matches and for convergence.
struct ProjectiveIcpOptions {
  double max_distance = 2.0;  // Between matched points [m].
  double max_angle = 0.52;    // Between their normals [rad].
  double huber_width = 0.1;   // [m]
  int max_num_iterations = 30;
  Eigen::Index min_num_matches = 100;
  double min_conditioning = 1e-3;

  // Converged once a step is within both tolerances.
  double translation_tolerance = 1e-4;  // [m]
  double rotation_tolerance = 1e-5;     // [rad]

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The pose, or the reason why there is none.
struct ProjectiveIcpSummary {
  std::optional<Rigid3> model_from_scan;
  std::string message = "nothing was tried";

  int num_iterations = 0;
  Eigen::Index num_matches = 0;  // In the last iteration.
  double rms = 0.0;              // Root mean square of r [m].
  double conditioning = 0.0;
};

// Aligns the scan with the model, starting from the given pose.
ProjectiveIcpSummary AlignProjectively(const VertexMap& scan,
                                       const VertexMap& model,
                                       const Rigid3& initial_model_from_scan,
                                       const ProjectiveIcpOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_SUMA_PROJECTIVE_ICP_H_
