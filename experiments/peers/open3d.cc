// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/peers/open3d.h"

#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/CorrespondenceChecker.h>
#include <open3d/pipelines/registration/FastGlobalRegistration.h>
#include <open3d/pipelines/registration/Registration.h>
#include <open3d/utility/Logging.h>
#include <open3d/utility/Random.h>

#include <functional>
#include <vector>

#include "experiments/peers/peer_summary.h"
#include "features/base/rigid3.h"

namespace quatro {
namespace {

namespace o3d = open3d::pipelines::registration;

open3d::geometry::PointCloud ToCloud(const PointsRef& points) {
  open3d::geometry::PointCloud cloud;
  for (const auto point : points.colwise()) cloud.points_.emplace_back(point);
  return cloud;
}

void SeedOpen3d(std::uint64_t seed) {
  open3d::utility::random::Seed(static_cast<int>(seed % 2147483647u));
}

using Solver =
    std::function<Eigen::Matrix4d(const open3d::geometry::PointCloud&,
                                  const open3d::geometry::PointCloud&,
                                  const o3d::CorrespondenceSet&)>;

PoseSummary Solve(const PointsRef& source,
                  const PointsRef& target,
                  double noise_bound,
                  const char* stage,
                  const Solver& solve) {
  return SolveByPeer(source, target, noise_bound, "Open3D", stage, [&] {
    open3d::utility::SetVerbosityLevel(open3d::utility::VerbosityLevel::Error);
    o3d::CorrespondenceSet matches;
    for (int i = 0; i < static_cast<int>(source.cols()); ++i) {
      matches.emplace_back(i, i);
    }
    const Eigen::Matrix4d matrix =
        solve(ToCloud(source), ToCloud(target), matches);
    return Rigid3{matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>()};
  });
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
