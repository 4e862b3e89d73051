// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/front_end.h"

#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <sstream>
#include <utility>

#include "features/base/parallel.h"
#include "features/matching.h"
#include "features/normals.h"
#include "features/voxel_grid.h"

namespace quatro {
namespace {

// The sensor of a scan is at the origin. A cloud that is far from the origin is
// taken to be in map coordinates. Its sensor is placed above its middle,
// although the cloud need not have been seen from there.
void AssumeSensor(const Eigen::Vector3d& up, DescribedCloud* cloud) {
  const Points& points = cloud->points();
  const Eigen::Vector3d low = points.rowwise().minCoeff();
  const Eigen::Vector3d high = points.rowwise().maxCoeff();
  const Eigen::Vector3d margin = 0.5 * (high - low);
  cloud->is_scan =
      (low - margin).maxCoeff() <= 0.0 && (high + margin).minCoeff() >= 0.0;
  if (cloud->is_scan) return;
  const Eigen::Vector3d middle = 0.5 * (low + high);
  cloud->sensor =
      middle + up * (up.transpose() * (points.colwise() - middle)).maxCoeff();
}

// Sets the cloud and returns its FPFH, unless options.describe replaces it.
Fpfh Describe(const Points& points,
              const Eigen::Vector3d& up,
              const FrontEndOptions& options,
              int num_threads,
              DescribedCloud* cloud) {
  cloud->tree = std::make_shared<const KdTree>(points);
  AssumeSensor(up, cloud);
  const Neighborhoods neighborhoods =
      FindNeighborhoods(*cloud->tree, options.fpfh_radius, num_threads);
  cloud->normals = EstimateNormals(
      points, neighborhoods, options.normal_radius, cloud->sensor, num_threads);
  if (options.describe) return Fpfh();
  return ComputeFpfh(points, cloud->normals, neighborhoods, num_threads);
}

// A larger radius would include most of a scan.
constexpr double kMaxVoxels = 100.0;

// The descriptors of points, with the radii in `options`.
Fpfh DescribeAgain(const Points& points,
                   const Eigen::Vector3d& sensor,
                   const FrontEndOptions& options,
                   int num_threads) {
  const KdTree tree(points);
  const Neighborhoods neighborhoods =
      FindNeighborhoods(tree, options.fpfh_radius, num_threads);
  const Points normals = EstimateNormals(
      points, neighborhoods, options.normal_radius, sensor, num_threads);
  if (options.describe) {
    return options.describe(points, normals, options.fpfh_radius);
  }
  return ComputeFpfh(points, normals, neighborhoods, num_threads);
}

// The points of the matches, column by column.
// Runs body(0) and body(1) at the same time if there are two threads.
template <typename Body>
void ForBoth(int num_threads, const Body& body) {
  ParallelFor(num_threads, 2, 1, [&](Eigen::Index begin, Eigen::Index end) {
    for (Eigen::Index i = begin; i < end; ++i) {
      body(static_cast<std::size_t>(i));
    }
  });
}

// The voxel means of source and target.
std::optional<std::array<Points, 2>> SampleBoth(
    const std::array<const PointCloud*, 2>& given,
    double voxel_size,
    int num_threads,
    std::string* error) {
  std::array<std::optional<Points>, 2> voxels;
  std::array<std::string, 2> errors;
  ForBoth(num_threads, [&](std::size_t i) {
    voxels[i] = SampleVoxels(given[i]->points, voxel_size, &errors[i]);
  });
  for (const std::size_t i : {0u, 1u}) {
    if (voxels[i]) continue;
    *error = (i == 0 ? "source: " : "target: ") + errors[i];
    return std::nullopt;
  }
  return std::array<Points, 2>{std::move(*voxels[0]), std::move(*voxels[1])};
}

// Describes both clouds at once, each with half of the threads, so that their
// serial parts overlap.
std::array<Fpfh, 2> DescribeBoth(
    const std::array<Points, 2>& voxels,
    const std::array<const Eigen::Vector3d*, 2>& up,
    const FrontEndOptions& options,
    int num_threads,
    MatchedClouds* clouds) {
  const std::array<DescribedCloud*, 2> described = {&clouds->source,
                                                    &clouds->target};
  const int num_threads_to_use = NumThreadsToUse(num_threads);
  const std::array<int, 2> num_threads_of = {
      (num_threads_to_use + 1) / 2, std::max(1, num_threads_to_use / 2)};
  std::array<Fpfh, 2> fpfh;
  ForBoth(num_threads, [&](std::size_t i) {
    fpfh[i] =
        Describe(voxels[i], *up[i], options, num_threads_of[i], described[i]);
  });
  if (!options.describe) return fpfh;
  for (const std::size_t i : {0u, 1u}) {
    fpfh[i] =
        options.describe(voxels[i], described[i]->normals, options.fpfh_radius);
    CHECK_EQ(fpfh[i].cols(), voxels[i].cols());
  }
  return fpfh;
}

}  // namespace

bool FrontEndOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(voxel_size > 0.0 && std::isfinite(voxel_size))) {
    problem << "voxel_size = " << voxel_size << ", must be > 0 and finite";
  } else if (!(normal_radius > 0.0 && std::isfinite(normal_radius))) {
    problem << "normal_radius = " << normal_radius
            << ", must be > 0 and finite";
  } else if (!(fpfh_radius >= normal_radius)) {
    problem << "fpfh_radius = " << fpfh_radius
            << ", must be >= normal_radius = " << normal_radius;
  } else if (fpfh_radius > kMaxVoxels * voxel_size) {
    problem << "fpfh_radius = " << fpfh_radius << ", must be <= " << kMaxVoxels
            << " voxel_size = " << kMaxVoxels * voxel_size;
  } else {
    return tuple.IsValid(error);
  }
  *error = problem.str();
  return false;
}

MatchedPoints MatchAgain(const DescribedCloud& source,
                         const DescribedCloud& target,
                         const FrontEndOptions& options,
                         int num_threads) {
  std::string error;  // The voxels of the clouds were smaller and fit.
  const auto voxels_of = [&](const DescribedCloud& cloud) {
    return SampleVoxels(cloud.points(), options.voxel_size, &error)
        .value_or(cloud.points());
  };
  const Points source_voxels = voxels_of(source);
  const Points target_voxels = voxels_of(target);
  // One after the other: a describer need not be thread-safe.
  const Fpfh source_fpfh =
      DescribeAgain(source_voxels, source.sensor, options, num_threads);
  const Fpfh target_fpfh =
      DescribeAgain(target_voxels, target.sensor, options, num_threads);
  return PointsOf(MatchMutualNearest(source_fpfh, target_fpfh, num_threads),
                  source_voxels,
                  target_voxels);
}

MatchedPoints PointsOf(const std::vector<Match>& matches,
                       const Points& source,
                       const Points& target) {
  const auto num_matches = static_cast<Eigen::Index>(matches.size());
  MatchedPoints points{Points(3, num_matches), Points(3, num_matches)};
  for (Eigen::Index k = 0; k < num_matches; ++k) {
    const Match& match = matches[static_cast<std::size_t>(k)];
    points.source.col(k) = source.col(match.source);
    points.target.col(k) = target.col(match.target);
  }
  return points;
}

MatchedClouds MatchClouds(
    const PointCloud& source,
    const PointCloud& target,
    const Eigen::Vector3d& source_up,
    const Eigen::Vector3d& target_up,
    const FrontEndOptions& options,
    std::uint64_t seed,
    int num_threads,
    const std::function<void(const StageTime&)>& progress) {
  MatchedClouds clouds;
  if (source.points.cols() == 0 || target.points.cols() == 0) {
    clouds.error = source.points.cols() == 0 ? "the source has no points"
                                             : "the target has no points";
    return clouds;
  }

  Stopwatch stopwatch;
  const auto finish_stage = [&](const char* stage) {
    clouds.stage_times.push_back({stage, stopwatch.Lap()});
    if (progress) progress(clouds.stage_times.back());
  };

  const std::array<const PointCloud*, 2> given = {&source, &target};
  const auto voxels =
      SampleBoth(given, options.voxel_size, num_threads, &clouds.error);
  if (!voxels) return clouds;
  finish_stage("voxels");
  std::array<Fpfh, 2> fpfh = DescribeBoth(
      *voxels, {&source_up, &target_up}, options, num_threads, &clouds);
  finish_stage("features");
  const auto& [source_voxels, target_voxels] = *voxels;
  std::vector<Match> matches =
      MatchMutualNearest(fpfh[0], fpfh[1], num_threads);
  clouds.source.descriptors = std::make_shared<const Fpfh>(std::move(fpfh[0]));
  clouds.target.descriptors = std::make_shared<const Fpfh>(std::move(fpfh[1]));
  clouds.mutual_matches = matches;
  if (options.tuple_test) {
    TupleTestOptions tuple = options.tuple;
    tuple.seed = seed;
    tuple.num_threads = num_threads;
    matches = FilterByTupleTest(matches, source_voxels, target_voxels, tuple);
  }
  MatchedPoints tested = PointsOf(matches, source_voxels, target_voxels);
  clouds.matched_source = std::move(tested.source);
  clouds.matched_target = std::move(tested.target);
  finish_stage("matching");
  return clouds;
}

}  // namespace quatro
