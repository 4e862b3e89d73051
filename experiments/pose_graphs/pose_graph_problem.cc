// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/pose_graphs/pose_graph_problem.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "experiments/pose_graphs/information.h"
#include "features/base/stopwatch.h"
#include "robust/gnc/chi_square.h"
#include "solvers/ceres/manifolds.h"

namespace quatro {
namespace {

template <typename T>
using Vector2 = Eigen::Matrix<T, 2, 1>;
template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

// `Rows` is 3, or Eigen::Dynamic for fewer rows.
template <int Rows>
struct PlanarEdge {
  template <typename T>
  bool operator()(const T* r_i,
                  const T* t_i,
                  const T* r_j,
                  const T* t_j,
                  T* residual) const {
    const T x = t_j[0] - t_i[0];
    const T y = t_j[1] - t_i[1];
    // R_i^T R_j, then R_ij^T times that, as (cos, sin).
    const T c = r_i[0] * r_j[0] + r_i[1] * r_j[1];
    const T s = r_i[0] * r_j[1] - r_i[1] * r_j[0];
    using std::atan2;
    const Vector3<T> error(
        r_i[0] * x + r_i[1] * y - translation.x(),
        r_i[0] * y - r_i[1] * x - translation.y(),
        atan2(cos_yaw * s - sin_yaw * c, cos_yaw * c + sin_yaw * s));
    Eigen::Map<Eigen::Matrix<T, Rows, 1>> r(residual, root.rows());
    r = root * error;
    return true;
  }
  Eigen::Vector2d translation;
  double cos_yaw, sin_yaw;
  Eigen::Matrix<double, Rows, 3> root;  // U in (1).
};

// `Rows` is 6, or Eigen::Dynamic for fewer rows.
template <int Rows>
struct SpatialEdge {
  template <typename T>
  bool operator()(const T* r_i,
                  const T* t_i,
                  const T* r_j,
                  const T* t_j,
                  T* residual) const {
    using Quaternion = Eigen::Quaternion<T>;
    const Quaternion i_from_world =
        Eigen::Map<const Quaternion>(r_i).conjugate();
    const Vector3<T> step =
        Eigen::Map<const Vector3<T>>(t_j) - Eigen::Map<const Vector3<T>>(t_i);
    Quaternion turn = rotation.conjugate().template cast<T>() *
                      (i_from_world * Eigen::Map<const Quaternion>(r_j));
    // q and -q are the same rotation; the smaller angle is used.
    const T two = turn.w() < T{0.0} ? T{-2.0} : T{2.0};
    Eigen::Matrix<T, 6, 1> error;
    error.template head<3>() =
        i_from_world * step - translation.template cast<T>();
    error.template tail<3>() = two * turn.vec();
    Eigen::Map<Eigen::Matrix<T, Rows, 1>> r(residual, root.rows());
    r = root * error;
    return true;
  }
  Eigen::Vector3d translation;
  Eigen::Quaterniond rotation;
  Eigen::Matrix<double, Rows, 6> root;  // U in (1).
};

template <int Rows, int... BlockSizes, typename Edge>
ceres::CostFunction* MakeCost(Edge* edge) {
  if constexpr (Rows == Eigen::Dynamic) {
    return new ceres::AutoDiffCostFunction<Edge, ceres::DYNAMIC, BlockSizes...>(
        edge, static_cast<int>(edge->root.rows()));
  } else {
    return new ceres::AutoDiffCostFunction<Edge, Rows, BlockSizes...>(edge);
  }
}

template <int Rows>
ceres::CostFunction* MakePlanarEdge(const Rigid3& measured,
                                    const Eigen::MatrixXd& root) {
  return MakeCost<Rows, 2, 2, 2, 2>(
      new PlanarEdge<Rows>{measured.translation.head<2>(),
                           measured.rotation(0, 0),
                           measured.rotation(1, 0),
                           root});
}

template <int Rows>
ceres::CostFunction* MakeSpatialEdge(const Rigid3& measured,
                                     const Eigen::MatrixXd& root) {
  return MakeCost<Rows, 4, 3, 4, 3>(new SpatialEdge<Rows>{
      measured.translation, Eigen::Quaterniond(measured.rotation), root});
}

ceres::CostFunction* MakeEdge(const Rigid3& measured,
                              int dimension,
                              const Eigen::MatrixXd& root) {
  const bool is_full = root.rows() == root.cols();
  if (dimension == 2) {
    return is_full ? MakePlanarEdge<3>(measured, root)
                   : MakePlanarEdge<Eigen::Dynamic>(measured, root);
  }
  return is_full ? MakeSpatialEdge<6>(measured, root)
                 : MakeSpatialEdge<Eigen::Dynamic>(measured, root);
}

ceres::LossFunction* MakeLoss(LoopLoss loss, double bound) {
  switch (loss) {
    case LoopLoss::kHuber:
      return new ceres::HuberLoss(bound);
    case LoopLoss::kCauchy:
      return new ceres::CauchyLoss(bound);
    case LoopLoss::kTukey:
      return new ceres::TukeyLoss(bound);
    case LoopLoss::kGnc:
    case LoopLoss::kNone:
      break;
  }
  return nullptr;
}

// The weight that iteratively reweighted least squares would give an edge at
// the solution: the derivative of its loss at the squared residual.
double LossWeight(const ceres::Problem& problem, ceres::ResidualBlockId id) {
  const ceres::LossFunction* loss = problem.GetLossFunctionForResidualBlock(id);
  if (loss == nullptr) return 1.0;
  double half_squared = 0.0;
  if (!problem.EvaluateResidualBlock(
          id, false, &half_squared, nullptr, nullptr)) {
    return 0.0;
  }
  double value_and_slopes[3];
  loss->Evaluate(2.0 * half_squared, value_and_slopes);
  return value_and_slopes[1];
}

}  // namespace

std::optional<LoopLoss> ParseLoopLoss(const std::string& name) {
  if (name == "gnc") return LoopLoss::kGnc;
  if (name == "none") return LoopLoss::kNone;
  if (name == "huber") return LoopLoss::kHuber;
  if (name == "cauchy") return LoopLoss::kCauchy;
  if (name == "tukey") return LoopLoss::kTukey;
  return std::nullopt;
}

PoseGraphOptions::PoseGraphOptions() {
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = 100;
  solver.function_tolerance = 1e-14;
  solver.parameter_tolerance = 1e-12;
  solver.gradient_tolerance = 1e-12;
  solver.logging_type = ceres::SILENT;
}

PoseGraphProblem::PoseGraphProblem(const PoseGraph& graph,
                                   const PoseGraphOptions& options)
    : graph_(graph),
      rotations_(graph.world_from_pose.size()),
      translations_(graph.world_from_pose.size()) {
  const int n = graph.dimension;
  ceres::Manifold* manifold = nullptr;  // Shared by all; problem_ owns it.
  if (n == 2) {
    manifold = new UnitCircleManifold;
  } else {
    manifold = new ceres::EigenQuaternionManifold;
  }
  for (std::size_t i = 0; i < rotations_.size(); ++i) {
    const Rigid3& pose = graph.world_from_pose[i];
    const Eigen::Quaterniond q(pose.rotation);
    rotations_[i] =
        n == 2 ? std::array<double, 4>{pose.rotation(0, 0), pose.rotation(1, 0)}
               : std::array<double, 4>{q.x(), q.y(), q.z(), q.w()};
    Eigen::Vector3d::Map(translations_[i].data()) = pose.translation;
    problem_.AddParameterBlock(rotations_[i].data(), n == 2 ? 2 : 4, manifold);
    problem_.AddParameterBlock(translations_[i].data(), n);
  }
  for (const PoseEdge& edge : graph.edges) {
    const auto root = RootOfInformation(edge.information);
    const double bound = ChiSquareBound(options.inlier_probability,
                                        static_cast<int>(root->rows()));
    ids_.push_back(problem_.AddResidualBlock(
        MakeEdge(edge.from_from_to, n, *root),
        edge.IsOdometry() ? nullptr : MakeLoss(options.loss, bound),
        rotations_[edge.from].data(),
        translations_[edge.from].data(),
        rotations_[edge.to].data(),
        translations_[edge.to].data()));
  }
  std::vector<std::size_t> fixed = graph.fixed;
  if (fixed.empty()) fixed.push_back(0);
  for (const std::size_t i : fixed) {
    problem_.SetParameterBlockConstant(rotations_[i].data());
    problem_.SetParameterBlockConstant(translations_[i].data());
  }
}

std::vector<Rigid3> PoseGraphProblem::WorldFromPose() const {
  std::vector<Rigid3> poses(rotations_.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto& r = rotations_[i];
    poses[i].translation = Eigen::Vector3d::Map(translations_[i].data());
    poses[i].rotation =
        graph_.dimension == 2
            ? RotationZ(std::atan2(r[1], r[0]))
            : Eigen::Quaterniond(r[3], r[0], r[1], r[2]).toRotationMatrix();
  }
  return poses;
}

PoseGraphSummary SolvePoseGraph(const PoseGraphOptions& options,
                                PoseGraph* graph) {
  Stopwatch stopwatch;
  PoseGraphSummary summary;
  PoseGraphProblem problem(*graph, options);
  summary.weights.assign(graph->edges.size(), 1.0);
  if (options.loss == LoopLoss::kGnc) {
    CeresGncOptions gnc;
    gnc.gnc = options.gnc;
    gnc.solver = options.solver;
    gnc.plain_fit = options.solver;
    gnc.plain_fit->max_num_iterations = options.max_plain_fit_steps;
    gnc.loose = options.solver;
    gnc.loose->function_tolerance = options.inner_tolerance;
    gnc.inlier_probability = options.inlier_probability;
    gnc.candidates.emplace();
    for (std::size_t i = 0; i < graph->edges.size(); ++i) {
      if (!graph->edges[i].IsOdometry()) {
        gnc.candidates->push_back(problem.ids()[i]);
      }
    }
    summary.gnc = SolveCeresGnc(&problem.problem(), gnc);
    summary.is_usable = summary.gnc.IsUsable();
    summary.report = summary.gnc.BriefReport();
    for (std::size_t i = 0; summary.is_usable && i < graph->edges.size(); ++i) {
      summary.weights[i] = summary.gnc.blocks.at(problem.ids()[i]).weight;
    }
  } else {
    ceres::Solver::Summary solve;
    ceres::Solve(options.solver, &problem.problem(), &solve);
    summary.is_usable = solve.IsSolutionUsable();
    summary.report = solve.BriefReport();
    for (std::size_t i = 0; summary.is_usable && i < graph->edges.size(); ++i) {
      summary.weights[i] = LossWeight(problem.problem(), problem.ids()[i]);
    }
  }
  double cost = 0.0;
  if (summary.is_usable &&
      (!problem.problem().Evaluate({}, &cost, nullptr, nullptr, nullptr) ||
       !std::isfinite(cost))) {
    summary.is_usable = false;
    summary.report += "; failed, because the final cost is not finite";
  }
  if (summary.is_usable) graph->world_from_pose = problem.WorldFromPose();
  summary.seconds = stopwatch.Lap();
  return summary;
}

}  // namespace quatro
