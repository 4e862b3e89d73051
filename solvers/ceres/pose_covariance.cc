// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/ceres/pose_covariance.h"

#include <ceres/covariance.h>
#include <ceres/problem.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "solvers/ceres/ceres_residuals.h"
#include "solvers/closed_form/centroid.h"
#include "solvers/closed_form/gravity.h"
#include "solvers/closed_form/valid_matches.h"

namespace quatro {
namespace {

constexpr double kMinConditioning = 1e-6;  // Least lever arm over extent.
constexpr double kMaxRoundings = 8.0;

// The matches of (3) relative to the centroids: x_i = R p_i' and y_i = q_i - c.
struct CenteredMatches {
  Points x;
  Points y;
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();  // R mean(p) [m]
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double extent = 1.0;    // RMS of |x_i|, or 1 if zero [m].
  double rounding = 0.0;  // Rounding of the coordinates as given [m].
};

CenteredMatches Centered(const PointsRef& source,
                         const PointsRef& target,
                         const Rigid3& pose) {
  CenteredMatches matches;
  if (source.cols() == 0) return matches;
  const CenteredPoints p = Center(source, Weights::Ones(source.cols()));
  matches.x = pose.rotation * p.points;
  matches.arm = pose.rotation * p.centroid;
  matches.center = matches.arm + pose.translation;
  matches.y = target.colwise() - matches.center;
  matches.rounding = p.rounding;
  const double extent =
      std::sqrt(matches.x.squaredNorm() / static_cast<double>(source.cols()));
  if (extent > kMaxRoundings * p.rounding) matches.extent = extent;
  return matches;
}

// J^T J of (3) from the matches alone. The off-diagonal blocks are zero,
// because the x_i sum to zero.
Matrix6 MatchInformation(const CenteredMatches& matches, double sigma) {
  const Eigen::Matrix3d scatter = matches.x * matches.x.transpose();
  Matrix6 information = Matrix6::Zero();
  information.topLeftCorner<3, 3>() =
      scatter.trace() * Eigen::Matrix3d::Identity() - scatter;
  information.bottomRightCorner<3, 3>() =
      static_cast<double>(matches.x.cols()) * Eigen::Matrix3d::Identity();
  return information / (sigma * sigma);
}

// J^T J of |R u - v|^2 / angle_std^2 over w.
Eigen::Matrix3d PriorInformation(const VerticalPrior& prior,
                                 const Eigen::Matrix3d& rotation) {
  const Eigen::Vector3d up = rotation * prior.up_in_source / prior.angle_std;
  return up.squaredNorm() * Eigen::Matrix3d::Identity() - up * up.transpose();
}

// J^T r of (3), r = y_i - exp([w]x) x_i - u.
Vector6 Gradient(const CenteredMatches& matches,
                 const PoseCovarianceOptions& options,
                 double sigma,
                 const Eigen::Matrix3d& rotation) {
  Vector6 gradient = Vector6::Zero();
  for (Eigen::Index i = 0; i < matches.x.cols(); ++i) {
    const Eigen::Vector3d x = matches.x.col(i);
    const Eigen::Vector3d r = matches.y.col(i) - x;
    gradient.head<3>() -= x.cross(r) / (sigma * sigma);
    gradient.tail<3>() -= r / (sigma * sigma);
  }
  if (options.model == PoseModel::kRigid && options.prior) {
    const VerticalPrior& prior = *options.prior;
    const Eigen::Vector3d up = rotation * prior.up_in_source;
    gradient.head<3>() +=
        up.cross(up - prior.up_in_target) / (prior.angle_std * prior.angle_std);
  }
  return gradient;
}

// The residual of (1) as a function of the parameters of (3): delta is w, of
// which a rotation about z has only the last coordinate.
template <typename Group>
struct PerturbedPair {
  using CostFunction =
      ceres::AutoDiffCostFunction<PerturbedPair, 3, Group::kFreedoms, 3>;

  template <typename T>
  bool operator()(const T* delta, const T* shift, T* residual) const {
    T identity[Group::kSize];
    for (T& number : identity) number = Constant<T>(0.0);
    identity[Group::kSize == 4 ? 3 : 0] = Constant<T>(1.0);
    T turn[Group::kSize];
    Group::Perturb(identity, delta, turn);
    return pair(turn, shift, residual);
  }

  PairResidual<Group> pair;
};

struct PerturbedVertical {
  using CostFunction = ceres::AutoDiffCostFunction<PerturbedVertical, 3, 3>;

  template <typename T>
  bool operator()(const T* delta, T* residual) const {
    const T zero = Constant<T>(0.0);
    const T identity[4] = {zero, zero, zero, Constant<T>(1.0)};
    T turn[4];
    Turn::Perturb(identity, delta, turn);
    const Eigen::Vector3<T> turned = Turn::Rotate<T>(turn, up.cast<T>());
    for (int i = 0; i < 3; ++i) {
      residual[i] = (turned[i] - prior.up_in_target[i]) / prior.angle_std;
    }
    return true;
  }

  Eigen::Vector3d up;  // R u
  VerticalPrior prior;
};

// The covariance of (delta, u) by Ceres, which is zero in directions that the
// data do not constrain. Lengths are in units of the extent, so that the rank
// does not depend on the unit. The points are in a frame whose z axis is the
// axis of TurnAboutZ.
template <typename Group>
std::optional<Eigen::MatrixXd> CeresCovariance(
    const Points& x,
    const Points& y,
    double extent,
    double sigma,
    const PerturbedVertical* vertical) {
  constexpr int kFreedoms = Group::kFreedoms;
  double delta[kFreedoms] = {};
  double shift[3] = {};
  ceres::Problem problem;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    problem.AddResidualBlock(
        new typename PerturbedPair<Group>::CostFunction(
            new PerturbedPair<Group>{PairResidual<Group>{
                x.col(i) / extent, y.col(i) / extent, extent / sigma}}),
        nullptr,
        delta,
        shift);
  }
  if (vertical != nullptr) {
    problem.AddResidualBlock(
        new PerturbedVertical::CostFunction(new PerturbedVertical(*vertical)),
        nullptr,
        delta);
  }
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  // Accepts any rank. The covariance of unobservable directions is then zero.
  options.null_space_rank = -1;
  ceres::Covariance covariance(options);
  const std::vector<const double*> blocks = {delta, shift};
  Eigen::Matrix<double, kFreedoms + 3, kFreedoms + 3, Eigen::RowMajor> scaled;
  if (!covariance.Compute(blocks, &problem) ||
      !covariance.GetCovarianceMatrix(blocks, scaled.data()) ||
      !scaled.allFinite()) {
    return std::nullopt;
  }
  Eigen::Vector<double, kFreedoms + 3> units;
  units.head(kFreedoms).setOnes();
  units.tail(3).setConstant(extent);
  return Eigen::MatrixXd(units.asDiagonal() * scaled * units.asDiagonal());
}

// The estimated degrees of freedom as columns in the order (w, u).
Eigen::MatrixXd Freedoms(const PoseCovarianceOptions& options) {
  if (options.model == PoseModel::kRigid) return Matrix6::Identity();
  Eigen::MatrixXd freedoms = Eigen::MatrixXd::Zero(6, 4);
  freedoms.topLeftCorner<3, 1>() = options.up_in_target;
  freedoms.bottomRightCorner<3, 3>().setIdentity();
  return freedoms;
}

// The covariance of the estimated degrees of freedom in the order (w, u).
std::optional<Matrix6> EstimatedCovariance(const CenteredMatches& matches,
                                           const PoseCovarianceOptions& options,
                                           double sigma,
                                           const Eigen::Matrix3d& rotation,
                                           const Matrix6& information) {
  if (matches.x.cols() > options.max_ceres_matches) {
    const Eigen::MatrixXd B = Freedoms(options);
    const Eigen::LDLT<Eigen::MatrixXd> ldlt(B.transpose() * information * B);
    return Matrix6(B * ldlt.solve(B.transpose()));
  }
  if (options.model == PoseModel::kRigid) {
    const PerturbedVertical vertical{
        options.prior ? Eigen::Vector3d(rotation * options.prior->up_in_source)
                      : Eigen::Vector3d::UnitZ(),
        options.prior.value_or(VerticalPrior())};
    const auto covariance =
        CeresCovariance<Turn>(matches.x,
                              matches.y,
                              matches.extent,
                              sigma,
                              options.prior ? &vertical : nullptr);
    if (!covariance) return std::nullopt;
    return Matrix6(*covariance);
  }
  const Eigen::Matrix3d level_from_target =
      RotationBetween(options.up_in_target, Eigen::Vector3d::UnitZ());
  const auto covariance =
      CeresCovariance<TurnAboutZ>(level_from_target * matches.x,
                                  level_from_target * matches.y,
                                  matches.extent,
                                  sigma,
                                  nullptr);
  if (!covariance) return std::nullopt;
  Eigen::MatrixXd target_from_level = Freedoms(options);
  target_from_level.bottomRightCorner<3, 3>() = level_from_target.transpose();
  return Matrix6(target_from_level * *covariance *
                 target_from_level.transpose());
}

// The effect of an error E s of the assumed tilt, s ~ N(0, tilt_std^2 I), where
// the columns of E are two level axes. It is the error itself and the shift of
// the best yaw that it causes, -(up^T A_ww E s) / (up^T A_ww up).
Eigen::Matrix3d TiltCovariance(const Matrix6& information,
                               const PoseCovarianceOptions& options) {
  const Eigen::Matrix3d A_ww = information.topLeftCorner<3, 3>();
  const Eigen::Vector3d& up = options.up_in_target;
  const Eigen::Matrix3d level =
      Eigen::Matrix3d::Identity() - up * up.transpose();  // E E^T
  const Eigen::Matrix3d error =
      level - up * (up.transpose() * A_ww * level) / (up.dot(A_ww * up));
  return options.tilt_std * options.tilt_std * error * error.transpose();
}

// Returns why a direction is unobservable, or nullopt if it is observable. A
// rotation is constrained by points away from its axis or by a prior.
std::optional<UnobservableReason> WhyUnobservable(
    const DirectionInformation& direction,
    const Matrix6& match_information,
    const Matrix6& information,
    const CenteredMatches& matches,
    const PoseCovarianceOptions& options,
    double sigma) {
  const auto n = static_cast<double>(matches.x.cols());
  if (direction.freedom == Freedom::kTranslation) {
    return n > 0.0 ? std::nullopt : std::optional(UnobservableReason::kNoData);
  }
  const Eigen::Vector3d& w = direction.axis;
  const double by_matches = w.dot(match_information.topLeftCorner<3, 3>() * w);
  const double by_prior =
      w.dot(information.topLeftCorner<3, 3>() * w) - by_matches;
  // Root mean square distance of the points from the axis [m].
  const double lever = sigma * std::sqrt(by_matches / std::max(1.0, n));
  if (by_prior > 1.0 && by_prior >= by_matches) return std::nullopt;
  if (!(lever > std::max(kMinConditioning * matches.extent,
                         kMaxRoundings * matches.rounding))) {
    return UnobservableReason::kNoData;
  }
  if (!(lever > options.min_lever * sigma))
    return UnobservableReason::kWithinNoise;
  return std::nullopt;
}

// The directions that are estimated: all six, or translation and yaw.
std::vector<DirectionInformation> EstimatedDirections(
    const Matrix6& information,
    const Eigen::Vector3d& center,
    const PoseCovarianceOptions& options) {
  std::vector<DirectionInformation> directions =
      SplitInformation(information, center, 0.0);
  if (options.model == PoseModel::kRigid) return directions;
  directions.resize(3);
  const Eigen::Vector3d& up = options.up_in_target;
  directions.push_back({Freedom::kRotation,
                        up,
                        center,
                        up.dot(information.topLeftCorner<3, 3>() * up)});
  return directions;
}

// The standard deviation of (w, u) along the direction.
double StandardDeviation(const DirectionInformation& direction,
                         const Matrix6& covariance) {
  const int place = direction.freedom == Freedom::kRotation ? 0 : 3;
  const Eigen::Matrix3d block = covariance.block<3, 3>(place, place);
  return std::sqrt(std::max(0.0, direction.axis.dot(block * direction.axis)));
}

double EstimateSigma(const CenteredMatches& matches,
                     Eigen::Index num_freedoms) {
  const auto num_spare =
      static_cast<double>(3 * matches.x.cols() - num_freedoms);
  return std::sqrt((matches.y - matches.x).squaredNorm() / num_spare);
}

// For example "2 matches constrain 5 of 6 degrees of freedom; ...".
std::string DescribeMissing(Eigen::Index num_matches,
                            Eigen::Index num_freedoms,
                            const PoseCovariance& result) {
  std::ostringstream message;
  message << num_matches << " matches constrain " << result.rank << " of "
          << num_freedoms << " degrees of freedom";
  for (const UnobservableDirection& direction : result.unobservable) {
    message << "; " << direction.Describe();
  }
  return message.str();
}

// Adds the directions whose standard deviation exceeds the limit.
void AddUncertain(const std::vector<DirectionInformation>& directions,
                  const Matrix6& covariance,
                  const PoseCovarianceOptions& options,
                  PoseCovariance* result) {
  for (const DirectionInformation& direction : directions) {
    const double deviation = StandardDeviation(direction, covariance);
    const double limit = direction.freedom == Freedom::kRotation
                             ? options.max_rotation_std
                             : options.max_translation_std;
    if (deviation <= limit) continue;
    result->unobservable.push_back({direction.freedom,
                                    UnobservableReason::kUncertain,
                                    direction.axis,
                                    direction.point,
                                    deviation});
  }
}

// Appends the two axes of the tilt, which was assumed and not estimated.
void AddAssumedTilt(const Eigen::Vector3d& center,
                    const PoseCovarianceOptions& options,
                    PoseCovariance* result) {
  const Eigen::Matrix3d target_from_level =
      RotationBetween(Eigen::Vector3d::UnitZ(), options.up_in_target);
  for (const int axis : {0, 1}) {
    result->unobservable.push_back({Freedom::kRotation,
                                    UnobservableReason::kAssumed,
                                    target_from_level.col(axis),
                                    center,
                                    options.tilt_std});
  }
}

}  // namespace

bool CovarianceOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  const auto check = [&](const char* name, double value) {
    if (problem.tellp() != 0 || (value > 0.0 && std::isfinite(value))) return;
    problem << "covariance." << name << " = " << value
            << ", must be > 0 and finite";
  };
  check("tilt_std", tilt_std);
  check("max_rotation_std", max_rotation_std);
  check("max_translation_std", max_translation_std);
  if (problem.tellp() != 0) {
  } else if (!(min_lever >= 0.0 && std::isfinite(min_lever))) {
    problem << "covariance.min_lever = " << min_lever
            << ", must be >= 0 and finite";
  } else if (max_ceres_matches < 0) {
    problem << "covariance.max_ceres_matches = " << max_ceres_matches
            << ", must be >= 0";
  }
  *error = problem.str();
  return error->empty();
}

bool PoseCovarianceOptions::IsValid(std::string* error) const {
  if (!CovarianceOptions::IsValid(error)) return false;
  std::ostringstream problem;
  const auto is_positive = [](double x) { return x > 0.0 && std::isfinite(x); };
  if (!is_positive(sigma)) {
    problem << "covariance.sigma = " << sigma << ", must be > 0 and finite";
  } else if (prior && !is_positive(prior->angle_std)) {
    problem << "covariance.prior.angle_std = " << prior->angle_std
            << ", must be > 0 and finite";
  } else if (!(std::abs(up_in_target.norm() - 1.0) <= 1e-6)) {
    problem << "covariance.up_in_target = (" << up_in_target.transpose()
            << "), must be a unit vector";
  }
  *error = problem.str();
  return error->empty();
}

Matrix6 CovarianceAtOrigin(const Matrix6& covariance_at_center,
                           const Eigen::Vector3d& arm) {
  Matrix6 from_center = Matrix6::Identity();
  for (int i = 0; i < 3; ++i) {
    from_center.block<3, 1>(3, i) = arm.cross(Eigen::Vector3d::Unit(i));
  }
  const Matrix6 covariance =
      from_center * covariance_at_center * from_center.transpose();
  return 0.5 * (covariance + covariance.transpose());
}

PoseCovariance ComputePoseCovariance(const PointsRef& source,
                                     const PointsRef& target,
                                     const Rigid3& target_from_source,
                                     const PoseCovarianceOptions& options) {
  PoseCovariance result;
  if (!options.IsValid(&result.message) ||
      !AreValidMatches(source, target, &result.message)) {
    return result;
  }
  if (!target_from_source.ToMatrix().allFinite()) {
    result.message = "the pose is not finite";
    return result;
  }
  const Eigen::Matrix3d& R = target_from_source.rotation;
  const CenteredMatches matches = Centered(source, target, target_from_source);
  const Eigen::MatrixXd B = Freedoms(options);
  result.center = matches.center;
  result.sigma = options.sigma;
  if (3 * source.cols() > B.cols()) {
    result.estimated_sigma = EstimateSigma(matches, B.cols());
    if (options.sigma_from_residuals) {
      result.sigma = std::max(*result.estimated_sigma, options.sigma / 3.0);
    }
  }

  const Matrix6 by_matches = MatchInformation(matches, result.sigma);
  Matrix6 information = by_matches;
  if (options.model == PoseModel::kRigid && options.prior) {
    information.topLeftCorner<3, 3>() += PriorInformation(*options.prior, R);
  }
  const auto directions =
      EstimatedDirections(information, matches.center, options);
  bool is_observable = true;
  for (const DirectionInformation& direction : directions) {
    const auto why_not = WhyUnobservable(
        direction, by_matches, information, matches, options, result.sigma);
    if (!why_not) continue;
    is_observable = false;
    result.unobservable.push_back(
        {direction.freedom, *why_not, direction.axis, direction.point, {}});
  }

  std::optional<Matrix6> estimated;
  if (source.cols() > 0) {
    estimated =
        EstimatedCovariance(matches, options, result.sigma, R, information);
    // The trace is the number of directions in which the covariance is the
    // inverse of the information.
    if (estimated) {
      result.rank =
          static_cast<int>(std::lround((*estimated * information).trace()));
    }
  }
  if (options.model == PoseModel::kYawTranslation) {
    AddAssumedTilt(matches.center, options, &result);
  }
  if (!is_observable || !estimated || result.rank < B.cols()) {
    result.message = DescribeMissing(source.cols(), B.cols(), result);
    return result;
  }

  const Vector6 gradient = Gradient(matches, options, result.sigma, R);
  result.offset = std::sqrt(std::max(0.0, gradient.dot(*estimated * gradient)));
  if (options.model == PoseModel::kYawTranslation) {
    estimated->topLeftCorner<3, 3>() += TiltCovariance(information, options);
  }
  *estimated = (0.5 * (*estimated + estimated->transpose())).eval();
  AddUncertain(directions, *estimated, options, &result);
  result.covariance_at_center = *estimated;
  result.covariance = CovarianceAtOrigin(*estimated, matches.arm);
  result.message = "computed";
  return result;
}

}  // namespace quatro
