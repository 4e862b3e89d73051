// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/aloam/scan_to_scan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "experiments/odometry/aloam/surface_matching.h"

namespace quatro {
namespace {

// The number of rings above and below that count as neighboring.
constexpr int kBeside = 2;

// Points closer than this [m] do not form a line. If the sine of their angle is
// smaller than kMinSine, they do not form a plane.
constexpr double kMinBaseline = 0.01;
constexpr double kMinSine = 0.05;

std::optional<SurfaceMatch> LineThrough(const Eigen::Vector3d& source,
                                        const Eigen::Vector3d& a,
                                        const Eigen::Vector3d& b) {
  const double length = (b - a).norm();
  if (length < kMinBaseline) return std::nullopt;
  return SurfaceMatch{source, a, (b - a) / length};
}

std::optional<SurfaceMatch> PlaneThrough(const Eigen::Vector3d& source,
                                         const Eigen::Vector3d& a,
                                         const Eigen::Vector3d& b,
                                         const Eigen::Vector3d& c) {
  const double lengths = (b - a).norm() * (c - a).norm();
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  if (lengths < kMinBaseline * kMinBaseline ||
      normal.norm() < kMinSine * lengths) {
    return std::nullopt;
  }
  return SurfaceMatch{source, a, normal.normalized()};
}

}  // namespace

RingTrees::RingTrees(const RingPoints& points) : points_(points) {
  if (points_.ring.empty()) return;
  tree_.emplace(points_.points);
  std::vector<std::vector<Eigen::Index>> of_ring;
  for (std::size_t i = 0; i < points_.ring.size(); ++i) {
    const auto ring = static_cast<std::size_t>(points_.ring[i]);
    if (of_ring.size() <= ring) of_ring.resize(ring + 1);
    of_ring[ring].push_back(static_cast<Eigen::Index>(i));
  }
  rings_.resize(of_ring.size());
  for (std::size_t r = 0; r < of_ring.size(); ++r) {
    if (of_ring[r].empty()) continue;
    rings_[r].emplace(
        Ring{KdTree(points_.points(Eigen::all, of_ring[r])), of_ring[r]});
  }
}

Eigen::Index RingTrees::Nearest(const Eigen::Vector3d& query,
                                double max_distance) const {
  if (!tree_) return -1;
  const auto found = tree_->Nearest(query, 1);
  if (found[0].squared_distance > max_distance * max_distance) return -1;
  return found[0].index;
}

Eigen::Index RingTrees::NearestOnRing(const Eigen::Vector3d& query,
                                      Eigen::Index of,
                                      double max_distance) const {
  const auto& ring = *rings_[static_cast<std::size_t>(
      points_.ring[static_cast<std::size_t>(of)])];
  for (const Neighbor& found : ring.tree.Nearest(query, 2)) {
    const Eigen::Index i = ring.index[static_cast<std::size_t>(found.index)];
    if (i != of && found.squared_distance <= max_distance * max_distance) {
      return i;
    }
  }
  return -1;
}

Eigen::Index RingTrees::NearestBesideRing(const Eigen::Vector3d& query,
                                          Eigen::Index of,
                                          double max_distance) const {
  const int middle = points_.ring[static_cast<std::size_t>(of)];
  const int last =
      std::min(static_cast<int>(rings_.size()) - 1, middle + kBeside);
  Eigen::Index nearest = -1;
  double least = max_distance * max_distance;
  for (int r = std::max(0, middle - kBeside); r <= last; ++r) {
    const auto& ring = rings_[static_cast<std::size_t>(r)];
    if (r == middle || !ring) continue;
    const auto found = ring->tree.Nearest(query, 1);
    if (found[0].squared_distance <= least) {
      least = found[0].squared_distance;
      nearest = ring->index[static_cast<std::size_t>(found[0].index)];
    }
  }
  return nearest;
}

SurfaceMatches MatchToScan(const RingFeatures& features,
                           const ScanModel& model,
                           const Rigid3& model_from_scan,
                           double max_distance,
                           int num_threads) {
  const auto line =
      [&](const Eigen::Vector3d& source) -> std::optional<SurfaceMatch> {
    const Eigen::Vector3d query = model_from_scan * source;
    const Eigen::Index a = model.edges.Nearest(query, max_distance);
    if (a < 0) return std::nullopt;
    const Eigen::Index b =
        model.edges.NearestBesideRing(query, a, max_distance);
    if (b < 0) return std::nullopt;
    return LineThrough(source, model.edges.point(a), model.edges.point(b));
  };
  const auto plane =
      [&](const Eigen::Vector3d& source) -> std::optional<SurfaceMatch> {
    const Eigen::Vector3d query = model_from_scan * source;
    const Eigen::Index a = model.planes.Nearest(query, max_distance);
    if (a < 0) return std::nullopt;
    const Eigen::Index b = model.planes.NearestOnRing(query, a, max_distance);
    const Eigen::Index c =
        model.planes.NearestBesideRing(query, a, max_distance);
    if (b < 0 || c < 0) return std::nullopt;
    return PlaneThrough(source,
                        model.planes.point(a),
                        model.planes.point(b),
                        model.planes.point(c));
  };
  return {CollectMatches(features.sharp.points, num_threads, line),
          CollectMatches(features.flat.points, num_threads, plane)};
}

}  // namespace quatro
