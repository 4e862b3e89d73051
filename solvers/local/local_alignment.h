// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Local registration: from a pose that is nearly right to one where each point
// of the source meets the surface of the target around it,
//
//   R, t = argmin  sum_i rho(e_i^T W_i e_i),   e_i = q_i - R p_i - t,       (1)
//
// over the p_i that have a correspondent q_i within max_correspondence_distance
// of R p_i + t. What q_i and W_i are is the method's: solvers/local/icp.h,
// gicp.h, vgicp.h. Both are found anew at each pose, then held for one step of
// Gauss and Newton, damped (Levenberg, Marquardt) where it would not lower (1).
//
// Steps turn about the middle of the moved source, R <- exp(w) R, t <- t + d
// in coordinates with that origin, so that large coordinates keep their digits.
//
// No answer where fewer than three points correspond, and where they do not
// hold the pose: the least eigenvalue of the Hessian is below min_conditioning
// of the largest, w in units of the length that gives both blocks one trace.
//
// The answer does not depend on the number of threads, bit for bit.

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

// What corresponds, how it is weighed, and when it has converged.
struct LocalAlignmentOptions {
  double max_correspondence_distance = 1.0;  // [m]
  RobustKernel kernel;                       // rho, of sqrt(e^T W e).

  // It has converged once a step is within both.
  double translation_tolerance = 1e-3;  // Of the source's middle [m].
  double rotation_tolerance = 1e-4;     // [rad]
  int max_num_iterations = 50;

  // In [0, 1). 0: whatever can be computed counts as held.
  double min_conditioning = 3e-3;

  int num_threads = 1;  // 0: all cores. Never changes the answer.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// How a local alignment ended.
enum class AlignmentTermination {
  kInvalidInput,  // Options out of range or points that are not finite.
  kInsufficient,  // Fewer than three points correspond.
  kDegenerate,    // They correspond, but do not hold the pose.
  kNotConverged,  // After max_num_iterations. There is an answer.
  kConverged,
};

// "invalid_input", "insufficient", ...
const char* TerminationName(AlignmentTermination termination);

// One step.
struct AlignmentIteration {
  double cost = 0.0;  // (1) before the step.
  Eigen::Index num_inliers = 0;
  double translation_step = 0.0;  // [m]
  double rotation_step = 0.0;     // [rad]
  double damping = 0.0;           // Of the step that was taken.
};

// The pose, and the way to it.
struct AlignmentSummary {
  AlignmentTermination termination = AlignmentTermination::kInvalidInput;
  std::string message = "nothing was tried";

  // Set iff kConverged or kNotConverged.
  std::optional<Rigid3> target_from_source;

  // Where it ended, whatever the termination. The Hessian of half of (1) with
  // q, W and the weights rho' held, for R <- exp(w) R, t <- t + d in the order
  // (w, d): w turns R and leaves t.
  Matrix6 hessian = Matrix6::Zero();
  double cost = 0.0;             // (1)
  Eigen::Index num_inliers = 0;  // Points that correspond.

  // Least eigenvalue over the largest, as said above, and the directions in
  // which it is too small, as columns: unit vectors of w times length, d.
  double conditioning = 0.0;
  Eigen::Matrix<double, 6, Eigen::Dynamic> not_held;

  std::vector<AlignmentIteration> iterations;
  std::vector<StageTime> stage_times;

  bool IsUsable() const { return target_from_source.has_value(); }
};

// Of one source point at one pose.
struct AlignmentTerm {
  Eigen::Vector3d target;       // q [m]
  Eigen::Matrix3d information;  // W, symmetric.
};

// What a method supplies.
class AlignmentTerms {
 public:
  virtual ~AlignmentTerms() = default;

  // The points that move.
  virtual const Points& source() const = 0;

  // Of source point i at a pose: false if nothing corresponds. Called from
  // several threads for different i; may keep what belongs to i alone.
  virtual bool Find(Eigen::Index i,
                    const Rigid3& target_from_source,
                    AlignmentTerm* term) = 0;
};

// Whether two clouds can be tried: three finite points each. Otherwise says why
// not in *summary.
bool CanAlign(const Points& source,
              const Points& target,
              const LocalAlignmentOptions& options,
              AlignmentSummary* summary);

// Damped Gauss-Newton on (1), whatever the terms are.
AlignmentSummary AlignLocally(const Rigid3& initial_target_from_source,
                              const LocalAlignmentOptions& options,
                              AlignmentTerms* terms);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_LOCAL_LOCAL_ALIGNMENT_H_
