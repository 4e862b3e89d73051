// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Local registration: refines a nearly correct pose so that each point of the
// source lies on the surface of the target around it,
//
//   R, t = argmin  sum_i rho(e_i^T W_i e_i),   e_i = q_i - R p_i - t,       (1)
//
// over the p_i with a correspondence, a q_i within max_correspondence_distance
// of the moved point R p_i + t. The method defines q_i and W_i: see icp.h,
// gicp.h and vgicp.h in solvers/local. Each iteration finds both at the current
// pose, keeps them fixed, and takes a Gauss-Newton step. A step that would
// raise (1) is damped (Levenberg-Marquardt), and the damping fades over the
// next iterations.
//
// Steps rotate about the centroid of the moved source: R <- exp([w]x) R and t
// <- t + d are in coordinates with that origin, so that large coordinates keep
// their digits.
//
// There is no pose if fewer than three points correspond, or if the
// correspondences do not constrain the pose: the least eigenvalue of the
// Hessian is at most min_conditioning times the largest. For this test, w is
// multiplied by the length that gives both 3x3 blocks the same trace.
//
// The result does not depend on the number of threads, bit for bit.

#ifndef QUATRO_SOLVERS_LOCAL_LOCAL_ALIGNMENT_H_
#define QUATRO_SOLVERS_LOCAL_LOCAL_ALIGNMENT_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/stopwatch.h"
#include "features/base/types.h"
#include "solvers/local/robust_kernel.h"

namespace quatro {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

// Options of correspondences, weights, and convergence.
struct LocalAlignmentOptions {
  double max_correspondence_distance = 1.0;  // [m]
  RobustKernel kernel;  // rho. Its width is in units of sqrt(e^T W e).

  // Converged once a step is within both tolerances.
  double translation_tolerance = 1e-3;  // Step of the source's centroid [m].
  double rotation_tolerance = 1e-4;     // [rad]
  int max_num_iterations = 50;

  // The pose is degenerate if its conditioning is not above this value in [0,
  // 1). 0 accepts every pose that can be computed.
  double min_conditioning = 3e-3;

  int num_threads = 1;  // 0: one per core. Does not change the result.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The outcome of a local alignment.
enum class AlignmentTermination {
  kInvalidInput,  // Bad options, or coordinates not finite or too large.
  kInsufficient,  // Fewer than three points correspond.
  kDegenerate,    // Correspondences do not constrain the pose.
  kNotConverged,  // After max_num_iterations. There is a pose.
  kConverged,
};

// For example "not_converged".
const char* TerminationName(AlignmentTermination termination);

// One iteration.
struct AlignmentIteration {
  double cost = 0.0;  // (1) before the step.
  Eigen::Index num_inliers = 0;
  double translation_step = 0.0;  // [m]
  double rotation_step = 0.0;     // [rad]
  double damping = 0.0;           // Damping of the accepted step.
};

// The pose and the iterations that led to it.
struct AlignmentSummary {
  AlignmentTermination termination = AlignmentTermination::kInvalidInput;
  std::string message = "the alignment was not run";

  // Set iff kConverged or kNotConverged.
  std::optional<Rigid3> target_from_source;

  // The state at the last pose at which correspondences were searched for. The
  // Hessian is that of half of (1) with q, W and the weights rho' fixed, for R
  // <- exp([w]x) R and t <- t + d in the order (w, d): w changes R but not t.
  Matrix6 hessian = Matrix6::Zero();
  double cost = 0.0;             // (1)
  Eigen::Index num_inliers = 0;  // Number of correspondences.

  // The least eigenvalue over the largest, scaled as described above. The
  // columns are the directions in which the pose is not observable: unit
  // vectors of (w times the length, d), for rotations about the centroid.
  double conditioning = 0.0;
  Eigen::Matrix<double, 6, Eigen::Dynamic> unobservable;

  std::vector<AlignmentIteration> iterations;
  std::vector<StageTime> stage_times;

  bool IsUsable() const { return target_from_source.has_value(); }
};

// The correspondence of one source point at one pose.
struct AlignmentTerm {
  Eigen::Vector3d target;       // q [m]
  Eigen::Matrix3d information;  // W, symmetric.
};

// The interface of a method: its correspondences at a pose.
class AlignmentTerms {
 public:
  virtual ~AlignmentTerms() = default;

  // The points of the source.
  virtual const Points& source() const = 0;

  // Finds the term of source point i at a pose. Returns false if nothing
  // corresponds. It is called from several threads for different i, so it may
  // store only state that belongs to i.
  virtual bool Find(Eigen::Index i,
                    const Rigid3& target_from_source,
                    AlignmentTerm* term) = 0;
};

// Whether two clouds can be aligned: the options are valid, and each cloud has
// at least three points, all finite. Otherwise sets the termination and the
// message of *summary.
bool CanAlign(const Points& source,
              const Points& target,
              const LocalAlignmentOptions& options,
              AlignmentSummary* summary);

// Minimizes (1) by damped Gauss-Newton steps for the given terms.
AlignmentSummary AlignLocally(const Rigid3& initial_target_from_source,
                              const LocalAlignmentOptions& options,
                              AlignmentTerms* terms);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_LOCAL_LOCAL_ALIGNMENT_H_
