// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/overlap.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "features/parallel.h"

namespace quatro {
namespace {

constexpr double kMaxVertical = 0.7071;  // |n_up| of a surface at 45 deg.
constexpr double kMinNormalCosine = 0.8;
constexpr double kRangeQuantile = 0.75;
constexpr int kMinStructure = 50;

double RangeQuantile(const Points& points, const Eigen::Vector3d& sensor) {
  std::vector<double> squared(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    squared[static_cast<std::size_t>(i)] =
        (points.col(i) - sensor).squaredNorm();
  }
  if (squared.empty()) return 0.0;
  const auto at = squared.begin() +
                  static_cast<std::ptrdiff_t>(
                      kRangeQuantile * static_cast<double>(squared.size() - 1));
  std::nth_element(squared.begin(), at, squared.end());
  return std::sqrt(*at);
}

// The share of a's structure that is met in b.
std::optional<double> ShareMet(const SurfaceCloud& a,
                               const SurfaceCloud& b,
                               const Rigid3& b_from_a,
                               double max_distance,
                               int num_threads) {
  const Points& points = a.tree.points();
  const double max_range = RangeQuantile(b.tree.points(), b.sensor);
  std::atomic<int> num_structure{0};
  std::atomic<int> num_met{0};
  const auto look = [&](Eigen::Index begin, Eigen::Index end) {
    int structure = 0;
    int met = 0;
    for (Eigen::Index i = begin; i < end; ++i) {
      const auto normal = a.normals.col(i);
      if (normal.isZero(0.0) || std::abs(normal.dot(a.up)) > kMaxVertical) {
        continue;
      }
      const Eigen::Vector3d point_in_b =
          b_from_a * Eigen::Vector3d(points.col(i));
      if ((point_in_b - b.sensor).norm() > max_range) continue;
      ++structure;
      const Neighbor nearest = b.tree.Nearest(point_in_b, 1).front();
      const double cosine =
          (b_from_a.rotation * normal).dot(b.normals.col(nearest.index));
      met += nearest.squared_distance <= max_distance * max_distance &&
             std::abs(cosine) > kMinNormalCosine;
    }
    num_structure += structure;
    num_met += met;
  };
  ParallelFor(num_threads, points.cols(), 512, look);
  if (num_structure < kMinStructure) return std::nullopt;
  return static_cast<double>(num_met) / num_structure;
}

}  // namespace

std::optional<double> MeasureStructureOverlap(const SurfaceCloud& source,
                                              const SurfaceCloud& target,
                                              const Rigid3& target_from_source,
                                              double max_distance,
                                              int num_threads) {
  if (source.tree.points().cols() == 0 || target.tree.points().cols() == 0) {
    return std::nullopt;
  }
  const auto of_source =
      ShareMet(source, target, target_from_source, max_distance, num_threads);
  const auto of_target = ShareMet(
      target, source, Inverse(target_from_source), max_distance, num_threads);
  if (!of_source || !of_target) return std::nullopt;
  return std::min(*of_source, *of_target);
}

}  // namespace quatro
