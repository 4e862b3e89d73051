// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/peers/open3d_icp.h"

#include <open3d/geometry/KDTreeSearchParam.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/GeneralizedICP.h>
#include <open3d/pipelines/registration/Registration.h>
#include <open3d/utility/Logging.h>

#include <exception>
#include <string>

namespace quatro {
namespace {

namespace o3d = open3d::pipelines::registration;

constexpr int kNumNeighbors = 20;
constexpr Eigen::Index kNumNeeded = 3;

open3d::geometry::PointCloud ToCloud(const Points& points, bool has_normals) {
  open3d::geometry::PointCloud cloud;
  for (const auto point : points.colwise()) cloud.points_.emplace_back(point);
  if (has_normals) {
    cloud.EstimateNormals(
        open3d::geometry::KDTreeSearchParamKNN(kNumNeighbors));
  }
  return cloud;
}

}  // namespace

AlignmentSummary AlignByOpen3d(const Points& source,
                               const Points& target,
                               const Rigid3& initial_target_from_source,
                               const RefinementOptions& options) {
  const LocalAlignmentOptions& alignment = options.alignment;
  AlignmentSummary summary;
  const bool is_gicp = options.method == RefinementMethod::kGicp;
  if (!is_gicp && options.method != RefinementMethod::kIcp) {
    summary.message = "Open3D only has ICP and G-ICP";
    return summary;
  }
  if (!CanAlign(source, target, alignment, &summary)) return summary;
  o3d::RegistrationResult result;
  try {
    open3d::utility::SetVerbosityLevel(open3d::utility::VerbosityLevel::Error);
    const auto source_cloud = ToCloud(source, is_gicp);
    const auto target_cloud = ToCloud(target, is_gicp);
    const Eigen::Matrix4d guess = initial_target_from_source.ToMatrix();
    const o3d::ICPConvergenceCriteria criteria(
        1e-6, 1e-6, alignment.max_num_iterations);
    result = is_gicp ? o3d::RegistrationGeneralizedICP(
                           source_cloud,
                           target_cloud,
                           alignment.max_correspondence_distance,
                           guess,
                           o3d::TransformationEstimationForGeneralizedICP(
                               options.epsilon),
                           criteria)
                     : o3d::RegistrationICP(
                           source_cloud,
                           target_cloud,
                           alignment.max_correspondence_distance,
                           guess,
                           o3d::TransformationEstimationPointToPoint(false),
                           criteria);
  } catch (const std::exception& exception) {
    summary.message = std::string("Open3D: ") + exception.what();
    return summary;
  }
  summary.num_inliers =
      static_cast<Eigen::Index>(result.correspondence_set_.size());
  if (summary.num_inliers < kNumNeeded || !result.transformation_.allFinite()) {
    summary.termination = AlignmentTermination::kInsufficient;
    summary.message =
        "Open3D ended at a pose with fewer than three correspondences";
    return summary;
  }
  summary.termination = AlignmentTermination::kNotConverged;
  summary.message = "Open3D stopped (it does not report whether it converged)";
  summary.target_from_source =
      Rigid3{result.transformation_.topLeftCorner<3, 3>(),
             result.transformation_.topRightCorner<3, 1>()};
  return summary;
}

}  // namespace quatro
