// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Which directions of a pose are held, from the 6x6 information A of a small
// motion of the target about a point c,
//
//   x -> exp([w]x) (x - c) + c + u,   A = [ A_ww  A_wu ; A_uw  A_uu ],     (1)
//
// rotation w [rad] first, then translation u [m], along the target's axes.
// Translations are told apart with the rotation given, rotations with whatever
// translation goes best with each,
//
//   A_uu  and  A_ww - A_wu A_uu^+ A_uw,                                    (2)
//
// so that what no data hold has a name: a translation where an eigenvalue of
// the first is nothing, and where one of the second is, a turn w about the axis
// through c + w x u, u = -A_uu^+ A_uw w.

#ifndef QUATRO_SOLVERS_CERES_OBSERVABILITY_H_
#define QUATRO_SOLVERS_CERES_OBSERVABILITY_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace quatro {

// Rotation, then translation.
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Vector<double, 6>;

// Of a direction: a turn about it or a shift along it.
enum class Freedom { kRotation, kTranslation };

// One of the six of (2), in the target frame.
struct DirectionInformation {
  Freedom freedom = Freedom::kRotation;
  // Unit; its largest coordinate is > 0.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  // Of a rotation: where the axis passes [m].
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double information = 0.0;  // [1/rad^2] or [1/m^2]
};

// The translations, the least held first, then the rotations. Translations with
// less than `min_information` are left out of A_uu^+. A is positive
// semidefinite and finite.
std::vector<DirectionInformation> SplitInformation(
    const Matrix6& information,
    const Eigen::Vector3d& center,
    double min_information);

// Why a direction is not known.
enum class UnobservableReason {
  kNoData,       // Nothing depends on it.
  kWithinNoise,  // What depends on it is no larger than the noise.
  kUncertain,    // Held, but with a standard deviation above the limit.
  kAssumed,      // Not estimated: an assumption with a standard deviation.
  kNoSurface,    // No surface stands across it
                 // (robust/verdict/surface_observability.h).
};

// A direction that is not known, and why.
struct UnobservableDirection {
  Freedom freedom = Freedom::kRotation;
  UnobservableReason reason = UnobservableReason::kNoData;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // Unit, in the target.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // On the axis [m].
  std::optional<double> standard_deviation;  // [rad] or [m]; none: unbounded.

  // "position along the axis (0.94, 0.34, 0.00): no surface stands across it".
  // In degrees and metres.
  std::string Describe() const;
};

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CERES_OBSERVABILITY_H_
