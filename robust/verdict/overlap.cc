// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/overlap.h"

#include <algorithm>

#include "features/nearest_within.h"
#include "robust/verdict/contact.h"

namespace quatro {
namespace {

constexpr std::size_t kMinStructure = 50;

// a's structure within the useful range of b's sensor; `nearest` is not yet
// set.
std::vector<StructurePoint> FindCounted(const DescribedCloud& a,
                                        const DescribedCloud& b,
                                        const Rigid3& b_from_a) {
  const Points& points = a.points();
  const double max_range = UsefulRange(b);
  std::vector<StructurePoint> found;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (!IsStructure(a.normals.col(i))) continue;
    const Eigen::Vector3d point_in_b =
        b_from_a * Eigen::Vector3d(points.col(i));
    if ((point_in_b - b.sensor).norm() <= max_range) found.push_back({i});
  }
  return found;
}

void SetNearest(const DescribedCloud& a,
                const DescribedCloud& b,
                const Rigid3& b_from_a,
                Eigen::Index nearest,
                StructurePoint* point) {
  point->nearest = nearest;
  point->is_near = true;
  point->is_overlapping = AreNormalsAligned(
      b_from_a.rotation * a.normals.col(point->index), b.normals.col(nearest));
}

}  // namespace

std::vector<StructurePoint> FindStructure(const DescribedCloud& a,
                                          const DescribedCloud& b,
                                          const Rigid3& b_from_a,
                                          double max_distance,
                                          int num_threads) {
  std::vector<StructurePoint> found = FindCounted(a, b, b_from_a);
  Points places(3, static_cast<Eigen::Index>(found.size()));
  for (std::size_t k = 0; k < found.size(); ++k) {
    places.col(static_cast<Eigen::Index>(k)) =
        b_from_a * Eigen::Vector3d(a.points().col(found[k].index));
  }
  const auto nearest =
      FindNearestWithin(*b.tree, places, max_distance, num_threads);
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (nearest[k] == kNoneWithin) continue;
    SetNearest(a, b, b_from_a, nearest[k], &found[k]);
  }
  return found;
}

std::vector<StructurePoint> FindStructure(
    const DescribedCloud& a,
    const DescribedCloud& b,
    const Rigid3& b_from_a,
    const std::vector<std::int32_t>& contacts) {
  std::vector<StructurePoint> found = FindCounted(a, b, b_from_a);
  for (StructurePoint& point : found) {
    const auto nearest = contacts[static_cast<std::size_t>(point.index)];
    if (nearest != kNoContact) SetNearest(a, b, b_from_a, nearest, &point);
  }
  return found;
}

std::optional<double> OverlapShare(
    const std::vector<StructurePoint>& structure) {
  if (structure.size() < kMinStructure) return std::nullopt;
  const auto num_overlapping =
      std::count_if(structure.begin(), structure.end(), [](const auto& p) {
        return p.is_overlapping;
      });
  return static_cast<double>(num_overlapping) /
         static_cast<double>(structure.size());
}

}  // namespace quatro
