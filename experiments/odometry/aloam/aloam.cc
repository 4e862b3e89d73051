// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/aloam/aloam.h"

#include <glog/logging.h>

#include <cmath>
#include <sstream>

#include "experiments/odometry/aloam/scan_to_map.h"
#include "experiments/odometry/aloam/surface_matching.h"
#include "features/voxel_grid.h"

namespace quatro {
namespace {

// The minimum number of edge and plane features; a scan with fewer is unusable.
constexpr Eigen::Index kMinFeatures = 10;

// Whether a round did not move the pose; the next round would not move it
// either.
bool IsStill(const Rigid3& move) {
  return move.translation.norm() <= 1e-4 &&
         AngleBetween(move.rotation, Eigen::Matrix3d::Identity()) <= 1e-5;
}

Points Sample(const Points& points, double voxel_size) {
  std::string error;
  // Cannot fail, because the features are within 10 km.
  return SampleVoxels(points, voxel_size, &error).value_or(Points(3, 0));
}

}  // namespace

bool AloamOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!features.IsValid(error) || !alignment.IsValid(error)) return false;
  if (num_rounds < 1 || start_rounds < num_rounds) {
    problem << "num_rounds = " << num_rounds
            << ", start_rounds = " << start_rounds
            << ", must be >= 1 and start_rounds >= num_rounds";
  } else if (!(max_scan_distance > 0.0 && max_map_distance > 0.0)) {
    problem << "max_scan_distance = " << max_scan_distance
            << ", max_map_distance = " << max_map_distance << ", must be > 0";
  } else if (!(edge_voxel >= 0.01 && std::isfinite(edge_voxel) &&
               plane_voxel >= 0.01 && std::isfinite(plane_voxel))) {
    problem << "edge_voxel = " << edge_voxel
            << ", plane_voxel = " << plane_voxel
            << ", must be >= 0.01 and finite";
  } else if (!(map_radius > 0.0)) {
    problem << "map_radius = " << map_radius << ", must be > 0";
  } else if (num_threads < 0) {
    problem << "num_threads = " << num_threads << ", must be >= 0";
  }
  *error = problem.str();
  return error->empty();
}

Aloam::Aloam(const AloamOptions& options)
    : options_(options),
      edge_map_(options.edge_voxel),
      plane_map_(options.plane_voxel) {
  std::string error;
  CHECK(options.IsValid(&error)) << error;
}

std::optional<RingFeatures> Aloam::FindFeatures(const PointCloud& scan,
                                                std::string* message) const {
  const ScanRings rings = EstimateScanRings(scan.points);
  if (rings.source == RingSource::kNone) {
    *message = "the rings of the scan cannot be identified";
    return std::nullopt;
  }
  RingFeatures features =
      FindRingFeatures(scan.points, rings, options_.features);
  if (features.less_sharp.points.cols() < kMinFeatures ||
      features.less_flat.points.cols() < kMinFeatures) {
    *message =
        "the scan has " + std::to_string(features.less_sharp.points.cols()) +
        " edge and " + std::to_string(features.less_flat.points.cols()) +
        " plane points, must have at least " + std::to_string(kMinFeatures);
    return std::nullopt;
  }
  return features;
}

TrackResult Aloam::Start(const PointCloud& scan) {
  TrackResult result;
  const auto features = FindFeatures(scan, &result.message);
  if (!features) return result;
  Learn(*features, Rigid3{});
  return {Rigid3{}, "the first scan"};
}

LinePlaneSummary Aloam::AlignToScan(const RingFeatures& features,
                                    const Rigid3& world_from_scan) const {
  LinePlaneSummary summary;
  Rigid3 last_from_scan = Inverse(world_from_last_) * world_from_scan;
  const int num_rounds =
      has_velocity_ ? options_.num_rounds : options_.start_rounds;
  for (int round = 0; round < num_rounds; ++round) {
    const SurfaceMatches matches = MatchToScan(features,
                                               *last_,
                                               last_from_scan,
                                               options_.max_scan_distance,
                                               options_.num_threads);
    summary = AlignToLinesAndPlanes(
        matches.lines, matches.planes, last_from_scan, options_.alignment);
    if (!summary.target_from_source) return summary;
    const Rigid3 move = *summary.target_from_source * Inverse(last_from_scan);
    last_from_scan = *summary.target_from_source;
    if (IsStill(move)) break;
  }
  summary.target_from_source = world_from_last_ * last_from_scan;
  return summary;
}

LinePlaneSummary Aloam::AlignToMap(const Points& edges,
                                   const Points& planes,
                                   const Rigid3& world_from_scan) const {
  const KdTree edge_tree(edge_map_.Means());
  const KdTree plane_tree(plane_map_.Means());
  LinePlaneSummary summary;
  Rigid3 pose = world_from_scan;
  for (int round = 0; round < options_.num_rounds; ++round) {
    const auto line = [&](const Eigen::Vector3d& source) {
      return FitLine(
          edge_tree, source, pose * source, options_.max_map_distance);
    };
    const auto plane = [&](const Eigen::Vector3d& source) {
      return FitPlane(
          plane_tree, source, pose * source, options_.max_map_distance);
    };
    summary = AlignToLinesAndPlanes(
        CollectMatches(edges, options_.num_threads, line),
        CollectMatches(planes, options_.num_threads, plane),
        pose,
        options_.alignment);
    if (!summary.target_from_source) return summary;
    pose = *summary.target_from_source;
  }
  return summary;
}

TrackResult Aloam::Track(const PointCloud& scan,
                         const Rigid3& world_from_scan_guess) {
  TrackResult result;
  const auto features = FindFeatures(scan, &result.message);
  if (!features) return result;

  const LinePlaneSummary to_scan =
      AlignToScan(*features, world_from_scan_guess);
  const LinePlaneSummary to_map =
      AlignToMap(Sample(features->less_sharp.points, options_.edge_voxel),
                 Sample(features->less_flat.points, options_.plane_voxel),
                 to_scan.target_from_source.value_or(world_from_scan_guess));
  result.message =
      "to scan: " + to_scan.message + "; to map: " + to_map.message;
  result.world_from_scan = to_map.target_from_source
                               ? to_map.target_from_source
                               : to_scan.target_from_source;
  if (result.world_from_scan) {
    Learn(*features, *result.world_from_scan);
    has_velocity_ = true;
  }
  return result;
}

void Aloam::Learn(const RingFeatures& features, const Rigid3& world_from_scan) {
  last_.emplace(features);
  world_from_last_ = Normalized(world_from_scan);
  const auto add = [&](const Points& points, double voxel, VoxelMap* map) {
    map->Insert(world_from_scan.Apply(Sample(points, voxel)));
    map->Crop(world_from_scan.translation, options_.map_radius);
  };
  add(features.less_sharp.points, options_.edge_voxel, &edge_map_);
  add(features.less_flat.points, options_.plane_voxel, &plane_map_);
}

}  // namespace quatro
