// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The comparison of the least-squares closed forms in a run with their Ceres
// twins (solvers/ceres/ceres_twins.h).
//
// CrossChecked<Subproblem> wraps a subproblem of robust/gnc/gnc.h. It returns
// the closed-form estimates, and records their largest difference from those of
// Ceres, which solves the same problem with the same weights on the manifold,
// started half a radian away.

#ifndef QUATRO_ROBUST_ESTIMATORS_CROSSCHECK_H_
#define QUATRO_ROBUST_ESTIMATORS_CROSSCHECK_H_

#include <Eigen/Core>
#include <algorithm>
#include <optional>

#include "features/base/types.h"
#include "robust/estimators/pose_summary.h"
#include "robust/gnc/quasi_so3.h"
#include "robust/gnc/so3.h"

namespace quatro {

constexpr double kCrosscheckStart = 0.5;  // Offset of the start [rad].

// The angle between the closed form and Ceres [rad], infinite if Ceres fails.
double CrosscheckDifference(const QuasiSo3& subproblem,
                            const WeightsRef& weights,
                            const YawEstimate& closed_form);
double CrosscheckDifference(const So3& subproblem,
                            const WeightsRef& weights,
                            const RotationEstimate& closed_form);

// A subproblem that solves everything twice and records the largest difference.
template <typename Subproblem>
class CrossChecked {
 public:
  using Estimate = typename Subproblem::Estimate;

  // `subproblem` must outlive this object.
  explicit CrossChecked(const Subproblem& subproblem)
      : subproblem_(subproblem) {}

  Eigen::Index NumMeasurements() const { return subproblem_.NumMeasurements(); }
  Estimate Identity() const { return subproblem_.Identity(); }
  Eigen::VectorXd SquaredResiduals(const Estimate& estimate) const {
    return subproblem_.SquaredResiduals(estimate);
  }
  std::optional<Estimate> Solve(const WeightsRef& weights) const {
    std::optional<Estimate> estimate = subproblem_.Solve(weights);
    if (estimate) {
      ++report_.num_subproblems;
      report_.max_rotation_difference =
          std::max(report_.max_rotation_difference,
                   CrosscheckDifference(subproblem_, weights, *estimate));
    }
    return estimate;
  }

  // The number of solves so far, and the largest difference.
  const CrosscheckReport& report() const { return report_; }

 private:
  const Subproblem& subproblem_;
  mutable CrosscheckReport report_;
};

// Compares the joint yaw and translation and the full pose on the given
// inliers, as far as the inliers constrain them. Adds to *report, which it
// creates if needed.
void CrosscheckPose(const PointsRef& source,
                    const PointsRef& target,
                    std::optional<CrosscheckReport>* report);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_CROSSCHECK_H_
