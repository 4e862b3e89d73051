// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The directions of a pose that are observable, from the 6x6 information matrix
// A of a small motion of the target about a point c,
//
//   x -> exp([w]x) (x - c) + c + u,   A = [ A_ww  A_wu ; A_uw  A_uu ],     (1)
//
// with the rotation w [rad] first and then the translation u [m], along the
// axes of the target. Translations are analyzed with the rotation fixed, and
// rotations with the best translation for each, by the eigenvectors of
//
//   A_uu  and  A_ww - A_wu A_uu^+ A_uw.                                    (2)
//
// respectively. This gives each unobservable direction a name. A zero
// eigenvalue of the first matrix means that a translation is unobservable. A
// zero eigenvalue of the second, with eigenvector w and u = -A_uu^+ A_uw w,
// means that the rotation about the axis along w through c + w x u is
// unobservable.

#ifndef QUATRO_SOLVERS_CERES_OBSERVABILITY_H_
#define QUATRO_SOLVERS_CERES_OBSERVABILITY_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace quatro {

// Rotation first, then translation.
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Vector<double, 6>;

// A direction is a rotation about an axis or a translation along it.
enum class Freedom { kRotation, kTranslation };

// One of the six eigenvectors of (2), in the target frame.
struct DirectionInformation {
  Freedom freedom = Freedom::kRotation;
  // A unit vector, whose coordinate of largest magnitude is > 0.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  // A point on the axis of a rotation; c for a translation [m].
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double information = 0.0;  // The eigenvalue, [1/rad^2] or [1/m^2].
};

// Returns the three translations and then the three rotations, each in
// ascending order of information. Translations with information below
// `min_information` are left out of A_uu^+. A must be positive semidefinite and
// finite.
std::vector<DirectionInformation> SplitInformation(
    const Matrix6& information,
    const Eigen::Vector3d& center,
    double min_information);

// Why a direction is unobservable or uncertain.
enum class UnobservableReason {
  kNoData,       // No match depends on it.
  kWithinNoise,  // Its effect on the matches is within the noise.
  kUncertain,    // Its standard deviation is above the limit.
  kAssumed,      // Assumed with a standard deviation, not estimated.
  kNoSurface,    // No surface constrains it
                 // (robust/verdict/surface_observability.h).
};

// An unobservable or uncertain direction, and the reason.
struct UnobservableDirection {
  Freedom freedom = Freedom::kRotation;
  UnobservableReason reason = UnobservableReason::kNoData;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // Unit, target frame.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // A point on it [m].
  std::optional<double> standard_deviation;  // [rad] or [m], if it is known.

  // The direction and the reason in words, in degrees and meters. For example
  // "position along the axis (0.94, 0.34, 0.00): no surface constrains it".
  std::string Describe() const;
};

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CERES_OBSERVABILITY_H_
