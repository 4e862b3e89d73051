// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A scan onto a picture of a model, point to plane, partners found by
// projection in place of a search:
//
//   R, t = argmin  sum_i rho( (n_i . (R p_i + t - q_i))^2 ),                (1)
//
// q_i, n_i the model's vertex and normal in the pixel that R p_i + t falls
// into, if they are near enough and their normals agree; rho that of Huber.
// Both found anew at each step of Gauss and Newton,
//
//   (J^T W J) (w, d) = -J^T W r,   R <- exp(w) R,  t <- exp(w) t + d.      (2)
//
// No answer where fewer than min_num_matches have a partner, and where these do
// not hold all six freedoms: the least eigenvalue of J^T W J is below
// min_conditioning of the largest, turns scaled by the points' mean distance.
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

// Who may be whose partner, and when to stop.
struct ProjectiveIcpOptions {
  double max_distance = 2.0;  // From partner to partner [m].
  double max_angle = 0.52;    // Between their normals [rad].
  double huber_width = 0.1;   // [m]
  int max_num_iterations = 30;
  Eigen::Index min_num_matches = 100;
  double min_conditioning = 1e-3;

  // It has converged once a step is within both.
  double translation_tolerance = 1e-4;  // [m]
  double rotation_tolerance = 1e-5;     // [rad]

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The pose, or why there is none.
struct ProjectiveIcpSummary {
  std::optional<Rigid3> model_from_scan;
  std::string message = "nothing was tried";

  int num_iterations = 0;
  Eigen::Index num_matches = 0;  // In the last iteration.
  double rms = 0.0;              // Of r over them [m].
  double conditioning = 0.0;
};

// Moves the scan onto the model, from the given pose on.
ProjectiveIcpSummary AlignProjectively(const VertexMap& scan,
                                       const VertexMap& model,
                                       const Rigid3& initial_model_from_scan,
                                       const ProjectiveIcpOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_SUMA_PROJECTIVE_ICP_H_
