// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Matches many points in parallel. The results are in the order of the points.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SURFACE_MATCHING_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SURFACE_MATCHING_H_

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "experiments/odometry/aloam/line_plane_residuals.h"
#include "features/base/parallel.h"
#include "features/base/types.h"

namespace quatro {

// `match` maps a point to a std::optional<SurfaceMatch>. It may be called from
// several threads.
template <typename Match>
std::vector<SurfaceMatch> CollectMatches(const PointsRef& points,
                                         int num_threads,
                                         const Match& match) {
  std::vector<std::optional<SurfaceMatch>> found(
      static_cast<std::size_t>(points.cols()));
  ParallelFor(num_threads,
              points.cols(),
              256,
              [&](Eigen::Index begin, Eigen::Index end) {
                for (Eigen::Index i = begin; i < end; ++i) {
                  found[static_cast<std::size_t>(i)] =
                      match(Eigen::Vector3d(points.col(i)));
                }
              });
  std::vector<SurfaceMatch> matches;
  for (const auto& one : found) {
    if (one) matches.push_back(*one);
  }
  return matches;
}

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SURFACE_MATCHING_H_
