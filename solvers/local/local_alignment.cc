// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/local/local_alignment.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <sstream>
#include <utility>

#include "features/base/parallel.h"

namespace quatro {
namespace {

constexpr Eigen::Index kMinCorrespondences = 3;

// Each piece of this size is summed on its own, and then the pieces in order.
constexpr Eigen::Index kPiece = 256;

// Conditioning below which a step is only rounding error.
constexpr double kSingular = 1e-10;

constexpr int kMaxNumDampings = 12;

// The relative rounding error of (1).
constexpr double kCostError = 1e-12;

Eigen::Matrix3d Skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d skew;
  skew << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return skew;
}

// The cost (1), and the derivatives of half of it, at one pose.
struct System {
  Matrix6 hessian = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  double cost = 0.0;
  Eigen::Index num_inliers = 0;

  // `moved` is R p + t relative to the moved centroid. A step changes e to e -
  // w x moved - d.
  void Add(const Eigen::Vector3d& moved,
           const Eigen::Vector3d& error,
           const Eigen::Matrix3d& information,
           const RobustKernel& kernel) {
    const Eigen::Vector3d force = information * error;
    const double s = error.dot(force);
    const double weight = kernel.Weight(s);
    const Eigen::Matrix3d W = weight * information;
    Eigen::Matrix3d turned;  // [moved]x W
    for (int k = 0; k < 3; ++k) turned.col(k) = moved.cross(W.col(k));
    for (int k = 0; k < 3; ++k) {
      hessian.block<1, 3>(k, 0) += moved.cross(turned.row(k).transpose());
    }
    hessian.topRightCorner<3, 3>() += turned;
    hessian.bottomRightCorner<3, 3>() += W;
    gradient.head<3>() -= weight * moved.cross(force);
    gradient.tail<3>() -= weight * force;
    cost += kernel.Cost(s);
    ++num_inliers;
  }

  void Add(const System& other) {
    hessian += other.hessian;
    gradient += other.gradient;
    cost += other.cost;
    num_inliers += other.num_inliers;
  }
};

// The correspondences at one pose, and the cost that they define.
class Problem {
 public:
  Problem(const LocalAlignmentOptions& options, AlignmentTerms* terms)
      : options_(options),
        finder_(*terms),
        source_(terms->source()),
        centroid_(source_.rowwise().mean()),
        terms_(static_cast<std::size_t>(source_.cols())),
        is_found_(terms_.size()),
        systems_((terms_.size() + kPiece - 1) / kPiece) {}

  const Eigen::Vector3d& centroid() const { return centroid_; }

  System Linearize(const Rigid3& pose) {
    const Eigen::Vector3d moved_centroid = pose * centroid_;
    ForEachPiece([&](std::size_t piece, std::size_t begin, std::size_t end) {
      System system;
      for (std::size_t i = begin; i < end; ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        is_found_[i] = finder_.Find(column, pose, &terms_[i]);
        if (!is_found_[i]) continue;
        const Eigen::Vector3d moved =
            pose * Eigen::Vector3d(source_.col(column));
        system.Add(moved - moved_centroid,
                   terms_[i].target - moved,
                   terms_[i].information,
                   options_.kernel);
      }
      systems_[piece] = system;
    });
    System sum;
    for (const System& system : systems_) sum.Add(system);
    sum.hessian.bottomLeftCorner<3, 3>() =
        sum.hessian.topRightCorner<3, 3>().transpose().eval();
    return sum;
  }

  // The cost (1) at another pose, with the terms of the last Linearize().
  double Cost(const Rigid3& pose) {
    ForEachPiece([&](std::size_t piece, std::size_t begin, std::size_t end) {
      double cost = 0.0;
      for (std::size_t i = begin; i < end; ++i) {
        if (!is_found_[i]) continue;
        const Eigen::Vector3d error =
            terms_[i].target -
            pose * Eigen::Vector3d(source_.col(static_cast<Eigen::Index>(i)));
        cost += options_.kernel.Cost(error.dot(terms_[i].information * error));
      }
      systems_[piece].cost = cost;
    });
    double sum = 0.0;
    for (const System& system : systems_) sum += system.cost;
    return sum;
  }

 private:
  template <typename Body>
  void ForEachPiece(const Body& body) const {
    ParallelFor(options_.num_threads,
                source_.cols(),
                kPiece,
                [&](Eigen::Index begin, Eigen::Index end) {
                  body(static_cast<std::size_t>(begin / kPiece),
                       static_cast<std::size_t>(begin),
                       static_cast<std::size_t>(end));
                });
  }

  const LocalAlignmentOptions& options_;
  AlignmentTerms& finder_;
  const Points& source_;
  Eigen::Vector3d centroid_;
  std::vector<AlignmentTerm> terms_;
  std::vector<std::uint8_t> is_found_;
  std::vector<System> systems_;
};

// `pose` after a rotation about the moved centroid and a translation.
Rigid3 Moved(const Rigid3& pose,
             const Eigen::Vector3d& centroid,
             const Vector6& step) {
  const double angle = step.head<3>().norm();
  const Eigen::Quaterniond turn(
      angle > 0.0 ? Eigen::AngleAxisd(angle, step.head<3>() / angle)
                  : Eigen::AngleAxisd::Identity());
  const Eigen::Matrix3d rotation = (turn * Eigen::Quaterniond(pose.rotation))
                                       .normalized()
                                       .toRotationMatrix();
  return {rotation, pose * centroid + step.tail<3>() - rotation * centroid};
}

// The eigenvalues, with w multiplied by the length that gives both blocks the
// same trace.
using Spectrum = Eigen::SelfAdjointEigenSolver<Matrix6>;

Spectrum ScaledSpectrum(const Matrix6& hessian) {
  const double length = std::sqrt(hessian.topLeftCorner<3, 3>().trace() /
                                  hessian.bottomRightCorner<3, 3>().trace());
  Vector6 scale = Vector6::Ones();
  if (length > 0.0) scale.head<3>().setConstant(1.0 / length);
  return Spectrum(scale.asDiagonal() * hessian * scale.asDiagonal());
}

// Describes the rotation or the translation of a direction, whichever is
// larger.
std::string Describe(const Vector6& direction) {
  const bool is_turn = direction.head<3>().norm() > direction.tail<3>().norm();
  Eigen::Vector3d axis =
      (is_turn ? direction.head<3>() : direction.tail<3>()).normalized();
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  if (axis[largest] < 0.0) axis = -axis;
  std::ostringstream text;
  text << std::fixed << std::setprecision(2)
       << (is_turn ? "a rotation about (" : "a translation along (") << axis.x()
       << ", " << axis.y() << ", " << axis.z() << ")";
  return text.str();
}

// Sets the results at the last pose.
void Conclude(const System& system,
              const Eigen::Vector3d& lever,
              double min_conditioning,
              AlignmentSummary* summary) {
  Matrix6 about_origin = Matrix6::Identity();
  about_origin.bottomLeftCorner<3, 3>() = -Skew(lever);
  const Matrix6 hessian =
      about_origin.transpose() * system.hessian * about_origin;
  summary->hessian = 0.5 * (hessian + hessian.transpose());
  summary->cost = system.cost;
  summary->num_inliers = system.num_inliers;
  if (system.num_inliers < kMinCorrespondences) return;
  const Spectrum spectrum = ScaledSpectrum(system.hessian);
  const Vector6& values = spectrum.eigenvalues();
  summary->conditioning = std::max(0.0, values[0] / values[5]);
  const double limit = std::max(min_conditioning, kSingular) * values[5];
  Eigen::Index count = 0;
  while (count < 6 && !(values[count] > limit)) ++count;
  summary->unobservable = spectrum.eigenvectors().leftCols(count);
}

// Takes a Levenberg-Marquardt step that does not raise the cost. If none is
// found, the pose remains and both steps are zero.
AlignmentIteration TakeStep(const System& system,
                            Problem* problem,
                            Rigid3* pose,
                            double* damping) {
  AlignmentIteration iteration;
  iteration.cost = system.cost;
  iteration.num_inliers = system.num_inliers;
  for (int i = 0; i < kMaxNumDampings; ++i) {
    Matrix6 damped = system.hessian;
    damped.diagonal() *= 1.0 + *damping;
    const Vector6 step = -damped.ldlt().solve(system.gradient);
    const Rigid3 moved = Moved(*pose, problem->centroid(), step);
    if (problem->Cost(moved) <= system.cost * (1.0 + kCostError)) {
      iteration.rotation_step = step.head<3>().norm();
      iteration.translation_step = step.tail<3>().norm();
      iteration.damping = *damping;
      *pose = moved;
      *damping = *damping > 1e-6 ? 0.1 * *damping : 0.0;
      break;
    }
    *damping = std::max(1e-3, 10.0 * *damping);
  }
  return iteration;
}

}  // namespace

bool LocalAlignmentOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  const auto is_positive = [](double x) { return x > 0.0 && std::isfinite(x); };
  if (!is_positive(max_correspondence_distance)) {
    problem << "max_correspondence_distance = " << max_correspondence_distance
            << ", must be > 0 and finite";
  } else if (!is_positive(kernel.width)) {
    problem << "kernel.width = " << kernel.width << ", must be > 0 and finite";
  } else if (!is_positive(translation_tolerance)) {
    problem << "translation_tolerance = " << translation_tolerance
            << ", must be > 0 and finite";
  } else if (!is_positive(rotation_tolerance)) {
    problem << "rotation_tolerance = " << rotation_tolerance
            << ", must be > 0 and finite";
  } else if (max_num_iterations < 1) {
    problem << "max_num_iterations = " << max_num_iterations
            << ", must be >= 1";
  } else if (!(min_conditioning >= 0.0 && min_conditioning < 1.0)) {
    problem << "min_conditioning = " << min_conditioning
            << ", must be in [0, 1)";
  } else if (num_threads < 0) {
    problem << "num_threads = " << num_threads << ", must be >= 0";
  }
  *error = problem.str();
  return error->empty();
}

const char* TerminationName(AlignmentTermination termination) {
  switch (termination) {
    case AlignmentTermination::kInsufficient:
      return "insufficient";
    case AlignmentTermination::kDegenerate:
      return "degenerate";
    case AlignmentTermination::kNotConverged:
      return "not_converged";
    case AlignmentTermination::kConverged:
      return "converged";
    case AlignmentTermination::kInvalidInput:
      break;
  }
  return "invalid_input";
}

bool CanAlign(const Points& source,
              const Points& target,
              const LocalAlignmentOptions& options,
              AlignmentSummary* summary) {
  summary->termination = AlignmentTermination::kInvalidInput;
  if (!options.IsValid(&summary->message)) return false;
  const auto refuse = [&](const char* cloud, const Points& points) {
    if (!points.allFinite()) {
      summary->message =
          std::string("a point of the ") + cloud + " is not finite";
      return true;
    }
    if (points.cols() >= kMinCorrespondences) return false;
    summary->termination = AlignmentTermination::kInsufficient;
    summary->message = std::string("the ") + cloud + " has " +
                       std::to_string(points.cols()) +
                       " points; at least three are required";
    return true;
  };
  return !refuse("source", source) && !refuse("target", target);
}

AlignmentSummary AlignLocally(const Rigid3& initial_target_from_source,
                              const LocalAlignmentOptions& options,
                              AlignmentTerms* terms) {
  AlignmentSummary summary;
  if (!options.IsValid(&summary.message)) return summary;
  if (!terms->source().allFinite() ||
      !initial_target_from_source.ToMatrix().allFinite()) {
    summary.message = "a source point or the initial pose is not finite";
    return summary;
  }
  const auto end = [&](AlignmentTermination why, const std::string& message) {
    summary.termination = why;
    summary.message = message;
    return summary;
  };
  if (terms->source().cols() < kMinCorrespondences) {
    return end(AlignmentTermination::kInsufficient,
               "the source has " + std::to_string(terms->source().cols()) +
                   " points; at least three are required");
  }

  Problem problem(options, terms);
  Rigid3 pose = initial_target_from_source;
  bool is_converged = false;
  double damping = 0.0;
  for (;;) {
    const System system = problem.Linearize(pose);
    Conclude(system,
             pose.rotation * problem.centroid(),
             options.min_conditioning,
             &summary);
    if (system.num_inliers < kMinCorrespondences) {
      return end(
          AlignmentTermination::kInsufficient,
          "only " + std::to_string(system.num_inliers) +
              " points have a correspondence; at least three are required");
    }
    if (!system.hessian.allFinite() || !std::isfinite(system.cost)) {
      return end(
          AlignmentTermination::kInvalidInput,
          "the coordinates are too large; move both clouds near the origin");
    }
    const bool is_last =
        is_converged || static_cast<int>(summary.iterations.size()) >=
                            options.max_num_iterations;
    if (!(summary.conditioning > kSingular) ||
        (is_last && summary.unobservable.cols() > 0)) {
      return end(AlignmentTermination::kDegenerate,
                 "the correspondences do not constrain " +
                     Describe(summary.unobservable.col(0)));
    }
    if (is_last) break;

    const AlignmentIteration iteration =
        TakeStep(system, &problem, &pose, &damping);
    // This is also true if no step was accepted, when only rounding errors are
    // left.
    is_converged =
        iteration.translation_step <= options.translation_tolerance &&
        iteration.rotation_step <= options.rotation_tolerance;
    summary.iterations.push_back(iteration);
  }
  summary.target_from_source = pose;
  return is_converged ? end(AlignmentTermination::kConverged, "converged")
                      : end(AlignmentTermination::kNotConverged,
                            "not converged after " +
                                std::to_string(summary.iterations.size()) +
                                " iterations");
}

}  // namespace quatro
