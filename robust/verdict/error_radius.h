// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// How far a registered pose may be off: meters and degrees that both hold for
// 95 % of the poses, by split conformal prediction,
//
//   meters = m sqrt(tr P_tt + v^2),   degrees = d sqrt(tr P_ww + (v / l)^2),
//   (1)
//
// with P of robust/verdict/contact_covariance.h, v a tenth of the voxel size,
// for the motion and the calibration of real sensors, and l the extent of the
// contacts. m and d are those of the pair's regime. For calibration pairs with
// a true pose, experiments/scripts/calibrate_radius.py takes as factors the
// quantiles of the errors over these deviations, so that coverage does not
// depend on whether P is correct. It holds for pairs like those.

#ifndef QUATRO_ROBUST_VERDICT_ERROR_RADIUS_H_
#define QUATRO_ROBUST_VERDICT_ERROR_RADIUS_H_

#include <Eigen/Core>

#include "features/described_cloud.h"
#include "solvers/ceres/observability.h"

namespace quatro {

// Kinds of pairs whose errors differ; the first that applies.
enum class Regime {
  kNarrow,  // A scan sees less than 180 deg around the vertical.
  kSparse,  // A scan has few beams: 45 % of the elevations between its 5 % and
            // 95 % quantiles, in steps of half a degree, are empty or nearly
            // so.
  kFar,     // The pose was searched for (robust/registration/ladder.h).
  kIndoor,  // Half of the points of both scans are within 8 m.
  kStreet,  // All others.
};

// "narrow", "sparse", "far", "indoor" or "street".
const char* RegimeName(Regime regime);

// The regime of two clouds with z up.
Regime FindRegime(const DescribedCloud& source,
                  const DescribedCloud& target,
                  bool is_searched);

// The factor on (4) of robust/verdict/contact_covariance.h with which 95 % of
// the ellipsoids of 95 % cover the true pose; at least 1.
double CovarianceFactor(Regime regime);

// Errors that are not exceeded with a confidence of 95 %, both at once.
struct ErrorRadius {
  double translation = 0.0;  // How far the source's origin may be off [m].
  double rotation = 0.0;     // [rad]
  Regime regime = Regime::kStreet;

  // The roots of (1).
  double translation_deviation = 0.0;  // [m]
  double rotation_deviation = 0.0;     // [rad]
};

// Equation (1). `covariance` is P, of rotation [rad] and translation [m] of the
// pose, without the factor of the regime; `voxel_size` and `extent` are in [m].
ErrorRadius RadiusOf(const Matrix6& covariance,
                     double voxel_size,
                     double extent,
                     Regime regime);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_ERROR_RADIUS_H_
