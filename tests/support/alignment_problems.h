// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// For tests of local registration: (1) of solvers/local/local_alignment.h by
// its definition, and as a Ceres problem.

#ifndef QUATRO_TESTS_SUPPORT_ALIGNMENT_PROBLEMS_H_
#define QUATRO_TESTS_SUPPORT_ALIGNMENT_PROBLEMS_H_

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "features/base/rigid3.h"
#include "solvers/ceres/ceres_residuals.h"
#include "solvers/local/local_alignment.h"

namespace quatro {

struct FixedTerm {
  Eigen::Vector3d source;
  AlignmentTerm term;
};

inline std::vector<FixedTerm> FixTerms(const Rigid3& pose,
                                       AlignmentTerms* terms) {
  std::vector<FixedTerm> terms_at_pose;
  for (Eigen::Index i = 0; i < terms->source().cols(); ++i) {
    FixedTerm one{terms->source().col(i), {}};
    if (terms->Find(i, pose, &one.term)) terms_at_pose.push_back(one);
  }
  return terms_at_pose;
}

// R <- exp(w) R, t <- t + d.
inline Rigid3 Perturbed(const Rigid3& pose, const Vector6& delta) {
  const double angle = delta.head<3>().norm();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (angle > 0.0) {
    turn = Eigen::AngleAxisd(angle, delta.head<3>() / angle).toRotationMatrix();
  }
  return {turn * pose.rotation, pose.translation + delta.tail<3>()};
}

inline double FixedCost(const std::vector<FixedTerm>& terms_at_pose,
                        const Rigid3& pose,
                        const RobustKernel& kernel = {}) {
  double cost = 0.0;
  for (const FixedTerm& one : terms_at_pose) {
    const Eigen::Vector3d e = one.term.target - pose * one.source;
    cost += kernel.Cost(e.dot(one.term.information * e));
  }
  return cost;
}

// L^T (q - R p - t), where W = L L^T.
struct FixedTermResidual {
  using CostFunction = ceres::AutoDiffCostFunction<FixedTermResidual, 3, 4, 3>;

  template <typename T>
  bool operator()(const T* r, const T* t, T* residual) const {
    const Eigen::Vector3<T> moved = Turn::Rotate<T>(r, source.cast<T>()) +
                                    Eigen::Map<const Eigen::Vector3<T>>(t);
    Eigen::Map<Eigen::Vector3<T>> whitened(residual);
    whitened = root.cast<T>() * (target.cast<T>() - moved);
    return true;
  }

  Eigen::Vector3d source;
  Eigen::Vector3d target;
  Eigen::Matrix3d root;  // L^T
};

class GemanMcClureLoss final : public ceres::LossFunction {
 public:
  explicit GemanMcClureLoss(double width) : c2_(width * width) {}
  void Evaluate(double s, double* out) const override {
    const double share = c2_ / (c2_ + s);
    out[0] = s * share;
    out[1] = share * share;
    out[2] = -2.0 * share * share * share / c2_;
  }

 private:
  double c2_;
};

inline ceres::LossFunction* MakeCeresLoss(const RobustKernel& kernel) {
  switch (kernel.type) {
    case RobustKernelType::kHuber:
      return new ceres::HuberLoss(kernel.width);
    case RobustKernelType::kCauchy:
      return new ceres::CauchyLoss(kernel.width);
    case RobustKernelType::kGemanMcClure:
      return new GemanMcClureLoss(kernel.width);
    case RobustKernelType::kNone:
      break;
  }
  return nullptr;
}

// The minimum of (1) with the terms fixed, from a pose.
inline Rigid3 SolveFixedByCeres(const std::vector<FixedTerm>& terms_at_pose,
                                const Rigid3& pose,
                                const RobustKernel& kernel) {
  Eigen::Quaterniond rotation(pose.rotation);
  Eigen::Vector3d translation = pose.translation;
  ceres::Problem problem;
  problem.AddParameterBlock(
      rotation.coeffs().data(), 4, new ceres::EigenQuaternionManifold);
  for (const FixedTerm& one : terms_at_pose) {
    const Eigen::Matrix3d root = one.term.information.llt().matrixU();
    problem.AddResidualBlock(
        new FixedTermResidual::CostFunction(
            new FixedTermResidual{one.source, one.term.target, root}),
        MakeCeresLoss(kernel),
        rotation.coeffs().data(),
        translation.data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-16;
  options.gradient_tolerance = 1e-12;
  options.parameter_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return {rotation.normalized().toRotationMatrix(), translation};
}

}  // namespace quatro

#endif  // QUATRO_TESTS_SUPPORT_ALIGNMENT_PROBLEMS_H_
