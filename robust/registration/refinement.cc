// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/refinement.h"

#include <glog/logging.h>

#include <sstream>

#include "solvers/local/icp.h"
#include "solvers/local/vgicp.h"

namespace quatro {
namespace {

Eigen::Index CountAgreeing(const PointsRef& source,
                           const PointsRef& target,
                           const Rigid3& pose,
                           double max_distance) {
  const Points error = target - pose.Apply(source);
  return (error.colwise().norm().array() <= max_distance).count();
}

}  // namespace

const char* RefinementName(RefinementMethod method) {
  switch (method) {
    case RefinementMethod::kIcp:
      return "icp";
    case RefinementMethod::kGicp:
      return "gicp";
    case RefinementMethod::kVgicp:
      return "vgicp";
    case RefinementMethod::kNone:
      break;
  }
  return "none";
}

bool RefinementOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(max_translation > 0.0)) {
    problem << "refinement.max_translation = " << max_translation
            << ", must be > 0";
  } else if (!(max_rotation > 0.0)) {
    problem << "refinement.max_rotation = " << max_rotation << ", must be > 0";
  } else if (!(min_kept_matches >= 0.0 && min_kept_matches <= 1.0)) {
    problem << "refinement.min_kept_matches = " << min_kept_matches
            << ", must be in [0, 1]";
  } else {
    VgicpOptions all;
    all.alignment = alignment;
    all.epsilon = epsilon;
    all.voxel_size = voxel_size;
    if (all.IsValid(error)) return true;
    *error = "refinement." + *error;
    return false;
  }
  *error = problem.str();
  return false;
}

void RefinementSummary::SetMoved(const Eigen::Vector3d& source_middle,
                                 const Rigid3& found) {
  const Rigid3& before = unrefined_target_from_source;
  moved_translation = (found * source_middle - before * source_middle).norm();
  moved_rotation = AngleBetween(found.rotation, before.rotation);
}

AlignmentSummary Align(const DescribedCloud& source,
                       const DescribedCloud& target,
                       const Rigid3& initial_target_from_source,
                       const RefinementOptions& options) {
  switch (options.method) {
    case RefinementMethod::kIcp:
      return SolveIcp(source.points(),
                      *target.tree,
                      initial_target_from_source,
                      options.alignment);
    case RefinementMethod::kGicp: {
      GicpOptions gicp;
      gicp.alignment = options.alignment;
      gicp.epsilon = options.epsilon;
      return SolveGicp(source, target, initial_target_from_source, gicp);
    }
    case RefinementMethod::kVgicp: {
      VgicpOptions vgicp;
      vgicp.alignment = options.alignment;
      vgicp.epsilon = options.epsilon;
      vgicp.voxel_size = options.voxel_size;
      return SolveVgicp(source, target, initial_target_from_source, vgicp);
    }
    case RefinementMethod::kNone:
      break;
  }
  return {};
}

RefinementSummary Refine(const DescribedCloud& source,
                         const DescribedCloud& target,
                         const PointsRef& matched_source,
                         const PointsRef& matched_target,
                         double noise_bound,
                         const Rigid3& target_from_source,
                         const RefinementOptions& options) {
  CHECK_EQ(matched_source.cols(), matched_target.cols());
  RefinementSummary summary;
  summary.method = options.method;
  summary.target_from_source = target_from_source;
  summary.unrefined_target_from_source = target_from_source;
  summary.alignment = Align(source, target, target_from_source, options);
  summary.message = summary.alignment.message;
  if (!summary.alignment.IsUsable()) return summary;

  const Rigid3& refined = *summary.alignment.target_from_source;
  summary.SetMoved(source.points().rowwise().mean(), refined);
  if (summary.alignment.termination != AlignmentTermination::kConverged) {
    return summary;
  }
  if (!(summary.moved_translation <= options.max_translation) ||
      !(summary.moved_rotation <= options.max_rotation)) {
    summary.message = "the refined pose is too far from the one before";
    return summary;
  }
  const auto count_inliers = [&](const Rigid3& pose) {
    return static_cast<double>(
        CountAgreeing(matched_source, matched_target, pose, 2.0 * noise_bound));
  };
  if (count_inliers(refined) <
      options.min_kept_matches * count_inliers(target_from_source)) {
    summary.message = "the refined pose contradicts the matches";
    return summary;
  }
  summary.is_accepted = true;
  summary.message = "refined";
  summary.target_from_source = refined;
  return summary;
}

}  // namespace quatro
