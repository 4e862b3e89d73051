// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/ceres/ceres_twins.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <vector>

#include "solvers/ceres/ceres_residuals.h"
#include "solvers/ceres/second_derivative.h"

namespace quatro {
namespace {

constexpr int kMaxNewtonSteps = 5;

// The motion x -> R x + shift, with R as the numbers of its group.
template <typename Group>
struct Motion {
  Eigen::Vector<double, Group::kSize> rotation;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
};

// The problem as given to Ceres. Pairs without weight are left out. Weights are
// divided by their sum, because Ceres' gradient tolerance has a unit. Motions
// map x - source_origin to y - target_origin.
template <typename Group>
struct PairProblem {
  std::vector<PairResidual<Group>> pairs;
  double total_weight = 0.0;
  Eigen::Vector3d source_origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_origin = Eigen::Vector3d::Zero();
};

template <typename Group>
PairProblem<Group> MakeProblem(const PointsRef& source,
                               const PointsRef& target,
                               const WeightsRef& weights) {
  CHECK_EQ(source.cols(), target.cols());
  CHECK_EQ(source.cols(), weights.size());
  PairProblem<Group> problem;
  problem.total_weight = weights.sum();
  for (Eigen::Index i = 0; i < source.cols(); ++i) {
    if (weights[i] == 0.0) continue;
    problem.pairs.push_back({source.col(i),
                             target.col(i),
                             std::sqrt(weights[i] / problem.total_weight)});
  }
  return problem;
}

// Moves the origins if the translation is free. The minimum does not depend on
// them, but its digits do. The source's origin is the weighted mean, about
// which `curvature` is defined. The target's origin is the plain mean, so that
// the solution is not t = 0, unless all weights are equal.
template <typename Group>
void MoveOrigins(PairProblem<Group>& problem) {
  if (problem.pairs.empty()) return;
  const Eigen::Vector3d source_guess = problem.pairs.front().source;
  const Eigen::Vector3d target_guess = problem.pairs.front().target;
  Eigen::Vector3d source_mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_mean = Eigen::Vector3d::Zero();
  const double n = static_cast<double>(problem.pairs.size());
  for (auto& pair : problem.pairs) {
    pair.source -= source_guess;
    pair.target -= target_guess;
    source_mean += pair.sqrt_weight * pair.sqrt_weight * pair.source;
    target_mean += pair.target / n;
  }
  for (auto& pair : problem.pairs) {
    pair.source -= source_mean;
    pair.target -= target_mean;
  }
  problem.source_origin = source_guess + source_mean;
  problem.target_origin = target_guess + target_mean;
}

// The derivatives of the mean cost with respect to delta in R -> exp([delta]x)
// R, followed by tau in shift -> shift + tau if N > kFreedoms.
template <int N, typename Group>
SecondDerivative<N> DerivativeAt(const PairProblem<Group>& problem,
                                 const Motion<Group>& motion) {
  constexpr int kFreedoms = Group::kFreedoms;
  return ComputeSecondDerivative<N>([&]<typename T>(const T* x) {
    T rotation[Group::kSize];
    T shift[3];
    for (int i = 0; i < Group::kSize; ++i) {
      rotation[i] = Constant<T>(motion.rotation[i]);
    }
    for (int i = 0; i < 3; ++i) {
      shift[i] = Constant<T>(motion.shift[i]);
      if constexpr (N > kFreedoms) shift[i] += x[kFreedoms + i];
    }
    T perturbed[Group::kSize];
    Group::Perturb(rotation, x, perturbed);

    T cost = Constant<T>(0.0);
    for (const auto& pair : problem.pairs) {
      T residual[3];
      pair(perturbed, shift, residual);
      for (const T& r : residual) cost += r * r;
    }
    return cost;
  });
}

template <int N, typename Group>
struct Minimum {
  bool is_usable = false;
  std::string message = "not solved";
  Motion<Group> motion;
  double cost = std::numeric_limits<double>::infinity();
  Eigen::Matrix<double, N, N> curvature;
};

// The shift is free if N > Group::kFreedoms.
template <int N, typename Group>
Minimum<N, Group> Minimize(const PairProblem<Group>& problem,
                           const std::vector<Motion<Group>>& starts) {
  Minimum<N, Group> minimum;
  bool is_finite = std::isfinite(problem.total_weight);
  for (const auto& pair : problem.pairs) {
    is_finite = is_finite && pair.source.allFinite() &&
                pair.target.allFinite() && std::isfinite(pair.sqrt_weight);
  }
  if (problem.pairs.empty() || !is_finite) {
    minimum.message = is_finite ? "all weights are zero, so nothing is solved"
                                : "a point or a weight is not finite";
    return minimum;
  }

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 200;
  options.function_tolerance = 0.0;
  options.gradient_tolerance = 1e-15;
  options.parameter_tolerance = 1e-15;
  // Steps are invalid once the digits of the cost are exhausted. That is not a
  // failure.
  options.max_num_consecutive_invalid_steps = options.max_num_iterations;
  options.logging_type = ceres::SILENT;
  for (const Motion<Group>& start : starts) {
    Motion<Group> motion = start;
    ceres::Problem ceres_problem;
    ceres_problem.AddParameterBlock(
        motion.rotation.data(), Group::kSize, new typename Group::Manifold);
    ceres_problem.AddParameterBlock(motion.shift.data(), 3);
    if constexpr (N == Group::kFreedoms) {
      ceres_problem.SetParameterBlockConstant(motion.shift.data());
    }
    for (const auto& pair : problem.pairs) {
      ceres_problem.AddResidualBlock(new
                                     typename PairResidual<Group>::CostFunction(
                                         new PairResidual<Group>(pair)),
                                     nullptr,
                                     motion.rotation.data(),
                                     motion.shift.data());
    }
    ceres::Solver::Summary summary;
    ceres::Solve(options, &ceres_problem, &summary);
    if (summary.IsSolutionUsable() && summary.final_cost < minimum.cost) {
      minimum.is_usable = true;
      minimum.cost = summary.final_cost;
      minimum.motion = motion;
      minimum.motion.rotation.normalize();
    }
    if (!minimum.is_usable || summary.final_cost == minimum.cost) {
      minimum.message = summary.message;
    }
  }
  if (!minimum.is_usable) return minimum;

  SecondDerivative<N> at = DerivativeAt<N>(problem, minimum.motion);
  for (int k = 0; k < kMaxNewtonSteps; ++k) {
    const Eigen::LLT<Eigen::Matrix<double, N, N>> llt(at.hessian);
    if (llt.info() != Eigen::Success) break;
    const Eigen::Vector<double, N> step = -llt.solve(at.gradient);
    Motion<Group> next = minimum.motion;
    Group::Perturb(
        minimum.motion.rotation.data(), step.data(), next.rotation.data());
    next.rotation.normalize();
    if constexpr (N > Group::kFreedoms) next.shift += step.template tail<3>();

    const SecondDerivative<N> at_next = DerivativeAt<N>(problem, next);
    if (!(at_next.gradient.norm() < at.gradient.norm())) break;
    minimum.motion = next;
    at = at_next;
  }
  minimum.cost = problem.total_weight * at.value;
  minimum.curvature = problem.total_weight * at.hessian;
  return minimum;
}

std::vector<Motion<TurnAboutZ>> YawStarts(double yaw) {
  std::vector<Motion<TurnAboutZ>> starts(2);
  starts[0].rotation << std::cos(yaw), std::sin(yaw);
  starts[1].rotation << -std::sin(yaw), std::cos(yaw);
  return starts;
}

std::vector<Motion<Turn>> RotationStarts(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  std::vector<Motion<Turn>> starts(4);
  for (int i = 0; i < 4; ++i) {
    // (x, y, z, w): half rotations about x, y and z, and the identity.
    const Eigen::Quaterniond turn(Eigen::Vector4d(Eigen::Vector4d::Unit(i)));
    starts[static_cast<std::size_t>(i)].rotation = (turn * q).coeffs();
  }
  return starts;
}

// Sets the shift of every start so that it moves the source's origin as
// `initial` does.
template <typename Group>
void SetShifts(const PairProblem<Group>& problem,
               const Rigid3& initial,
               std::vector<Motion<Group>>& starts) {
  for (Motion<Group>& start : starts) {
    start.shift = initial * problem.source_origin - problem.target_origin;
  }
}

// The pose of `motion`, which is relative to the origins. R is its rotation.
template <typename Group>
Rigid3 ToRigid3(const PairProblem<Group>& problem,
                const Eigen::Matrix3d& R,
                const Motion<Group>& motion) {
  return {R, problem.target_origin + motion.shift - R * problem.source_origin};
}

double YawOf(const Motion<TurnAboutZ>& motion) {
  return std::atan2(motion.rotation[1], motion.rotation[0]);
}

Eigen::Matrix3d RotationOf(const Motion<Turn>& motion) {
  return Eigen::Quaterniond(motion.rotation).toRotationMatrix();
}

}  // namespace

CeresTwin<YawEstimate> SolveYawByCeres(const PointsRef& source,
                                       const PointsRef& target,
                                       const WeightsRef& weights,
                                       double initial_target_from_source) {
  auto problem = MakeProblem<TurnAboutZ>(source, target, weights);
  for (auto& pair : problem.pairs) {
    pair.source.z() = 0.0;
    pair.target.z() = 0.0;
  }
  const auto minimum =
      Minimize<1>(problem, YawStarts(initial_target_from_source));

  CeresTwin<YawEstimate> twin{minimum.is_usable, {}, minimum.message};
  if (!minimum.is_usable) return twin;
  twin.estimate.target_from_source = YawOf(minimum.motion);
  twin.estimate.cost = minimum.cost;
  twin.estimate.curvature = minimum.curvature(0, 0);
  return twin;
}

CeresTwin<RotationEstimate> SolveRotationByCeres(
    const PointsRef& source,
    const PointsRef& target,
    const WeightsRef& weights,
    const Eigen::Matrix3d& initial_target_from_source) {
  const auto problem = MakeProblem<Turn>(source, target, weights);
  const auto minimum =
      Minimize<3>(problem, RotationStarts(initial_target_from_source));

  CeresTwin<RotationEstimate> twin{minimum.is_usable, {}, minimum.message};
  if (!minimum.is_usable) return twin;
  twin.estimate.target_from_source = RotationOf(minimum.motion);
  twin.estimate.cost = minimum.cost;
  twin.estimate.curvature = minimum.curvature;
  return twin;
}

CeresTwin<YawTranslationEstimate> SolveYawTranslationByCeres(
    const PointsRef& source,
    const PointsRef& target,
    const WeightsRef& weights,
    const Rigid3& initial_target_from_source) {
  auto problem = MakeProblem<TurnAboutZ>(source, target, weights);
  MoveOrigins(problem);
  auto starts = YawStarts(Yaw(initial_target_from_source.rotation));
  SetShifts(problem, initial_target_from_source, starts);
  const auto minimum = Minimize<4>(problem, starts);

  CeresTwin<YawTranslationEstimate> twin{
      minimum.is_usable, {}, minimum.message};
  if (!minimum.is_usable) return twin;
  twin.estimate.yaw = YawOf(minimum.motion);
  twin.estimate.target_from_source =
      ToRigid3(problem, RotationZ(twin.estimate.yaw), minimum.motion);
  twin.estimate.cost = minimum.cost;
  twin.estimate.curvature = minimum.curvature;
  return twin;
}

CeresTwin<RigidEstimate> SolvePoseByCeres(
    const PointsRef& source,
    const PointsRef& target,
    const WeightsRef& weights,
    const Rigid3& initial_target_from_source) {
  auto problem = MakeProblem<Turn>(source, target, weights);
  MoveOrigins(problem);
  auto starts = RotationStarts(initial_target_from_source.rotation);
  SetShifts(problem, initial_target_from_source, starts);
  const auto minimum = Minimize<6>(problem, starts);

  CeresTwin<RigidEstimate> twin{minimum.is_usable, {}, minimum.message};
  if (!minimum.is_usable) return twin;
  twin.estimate.target_from_source =
      ToRigid3(problem, RotationOf(minimum.motion), minimum.motion);
  twin.estimate.cost = minimum.cost;
  twin.estimate.curvature = minimum.curvature;
  return twin;
}

}  // namespace quatro
