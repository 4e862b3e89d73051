// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/peers/open3d.h"

#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/CorrespondenceChecker.h>
#include <open3d/pipelines/registration/FastGlobalRegistration.h>
#include <open3d/pipelines/registration/Registration.h>
#include <open3d/utility/Logging.h>
#include <open3d/utility/Random.h>

#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "solvers/rigid3.h"

namespace quatro {
namespace {

namespace o3d = open3d::pipelines::registration;

constexpr int kNumNeeded = 3;

open3d::geometry::PointCloud ToCloud(const PointsRef& points) {
  open3d::geometry::PointCloud cloud;
  for (const auto point : points.colwise()) cloud.points_.emplace_back(point);
  return cloud;
}

void SeedOpen3d(std::uint64_t seed) {
  open3d::utility::random::Seed(static_cast<int>(seed % 2147483647u));
}

// Calls `solve(source, target, matches)` and judges its pose by our inliers.
PoseSummary Solve(
    const PointsRef& source,
    const PointsRef& target,
    double noise_bound,
    const char* stage,
    const std::function<Eigen::Matrix4d(const open3d::geometry::PointCloud&,
                                        const open3d::geometry::PointCloud&,
                                        const o3d::CorrespondenceSet&)>&
        solve) {
  PoseSummary summary;
  summary.num_needed = kNumNeeded;
  summary.num_distinct = source.cols();
  if (!source.allFinite() || !target.allFinite()) {
    summary.message = "a matched point is not finite";
    return summary;
  }
  summary.termination = PoseTermination::kInsufficient;
  summary.message = "Open3D found no pose that three matches agree with";
  if (source.cols() < kNumNeeded) return summary;
  const auto source_cloud = ToCloud(source);
  const auto target_cloud = ToCloud(target);
  o3d::CorrespondenceSet matches;
  for (int i = 0; i < static_cast<int>(source.cols()); ++i) {
    matches.emplace_back(i, i);
  }
  Stopwatch stopwatch;
  Eigen::Matrix4d matrix;
  try {
    open3d::utility::SetVerbosityLevel(open3d::utility::VerbosityLevel::Error);
    matrix = solve(source_cloud, target_cloud, matches);
  } catch (const std::exception& exception) {
    summary.message = std::string("Open3D: ") + exception.what();
    return summary;
  }
  summary.stage_times.push_back({stage, stopwatch.Lap()});
  const Rigid3 pose{matrix.topLeftCorner<3, 3>(),
                    matrix.topRightCorner<3, 1>()};
  const Eigen::VectorXd errors =
      (target - pose.Apply(source)).colwise().norm().transpose();
  for (Eigen::Index i = 0; i < errors.size(); ++i) {
    if (errors[i] <= noise_bound) summary.translation_inliers.push_back(i);
  }
  summary.num_translation_inliers =
      static_cast<Eigen::Index>(summary.translation_inliers.size());
  summary.consistent = summary.translation_inliers;
  summary.num_consistent = summary.num_translation_inliers;
  summary.num_rotation_inliers = summary.num_translation_inliers;
  if (summary.num_consistent < kNumNeeded) return summary;
  summary.target_from_source = pose;
  summary.termination = PoseTermination::kSolved;
  summary.message = "solved";
  return summary;
}

}  // namespace

PoseSummary SolveByOpen3dFgr(const PointsRef& source,
                             const PointsRef& target,
                             double noise_bound,
                             const Open3dFgrOptions& options) {
  o3d::FastGlobalRegistrationOption option;
  option.use_absolute_scale_ = !options.relative_distance;
  option.maximum_correspondence_distance_ =
      options.relative_distance ? options.distance : noise_bound;
  option.iteration_number_ = options.num_iterations;
  option.tuple_test_ = options.tuple_test;
  SeedOpen3d(options.seed);
  return Solve(source,
               target,
               noise_bound,
               "open3d_fgr",
               [&](const auto& source_cloud,
                   const auto& target_cloud,
                   const auto& matches) -> Eigen::Matrix4d {
                 return o3d::FastGlobalRegistrationBasedOnCorrespondence(
                            source_cloud, target_cloud, matches, option)
                     .transformation_;
               });
}

PoseSummary SolveByOpen3dRansac(const PointsRef& source,
                                const PointsRef& target,
                                double noise_bound,
                                const Open3dRansacOptions& options) {
  const o3d::CorrespondenceCheckerBasedOnEdgeLength edges(
      options.edge_similarity);
  const o3d::CorrespondenceCheckerBasedOnDistance distance(noise_bound);
  std::vector<std::reference_wrapper<const o3d::CorrespondenceChecker>>
      checkers;
  if (options.edge_similarity > 0.0) checkers = {edges, distance};
  SeedOpen3d(options.seed);
  return Solve(source,
               target,
               noise_bound,
               "open3d_ransac",
               [&](const auto& source_cloud,
                   const auto& target_cloud,
                   const auto& matches) -> Eigen::Matrix4d {
                 return o3d::RegistrationRANSACBasedOnCorrespondence(
                            source_cloud,
                            target_cloud,
                            matches,
                            noise_bound,
                            o3d::TransformationEstimationPointToPoint(false),
                            3,
                            checkers,
                            o3d::RANSACConvergenceCriteria(
                                options.max_iterations, options.confidence))
                     .transformation_;
               });
}

}  // namespace quatro
