// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/nearest_within.h"

#include <cstddef>
#include <optional>

#include "features/base/parallel.h"
#include "features/base/radix_sort.h"
#include "features/cells.h"

namespace quatro {
namespace {

// The points near a cell, coordinate by coordinate.
struct NearPoints {
  std::vector<std::int32_t> index;
  std::vector<double> x, y, z;

  void Gather(const Points& points) {
    for (auto* coordinates : {&x, &y, &z}) coordinates->resize(index.size());
    for (std::size_t k = 0; k < index.size(); ++k) {
      x[k] = points(0, index[k]);
      y[k] = points(1, index[k]);
      z[k] = points(2, index[k]);
    }
  }

  std::int32_t NearestTo(const Eigen::Vector3d& place,
                         double squared_radius) const {
    std::int32_t nearest = kNoneWithin;
    double least = squared_radius;
    for (std::size_t k = 0; k < index.size(); ++k) {
      const double dx = place.x() - x[k];
      const double dy = place.y() - y[k];
      const double dz = place.z() - z[k];
      const double d2 = dx * dx + dy * dy + dz * dz;
      if (d2 > least) continue;
      if (d2 == least && nearest != kNoneWithin && nearest < index[k]) continue;
      least = d2;
      nearest = index[k];
    }
    return nearest;
  }
};

std::vector<std::int32_t> FindByTree(const KdTree& tree,
                                     const Points& places,
                                     double radius,
                                     int num_threads) {
  std::vector<std::int32_t> nearest(static_cast<std::size_t>(places.cols()),
                                    kNoneWithin);
  const auto find = [&](Eigen::Index begin, Eigen::Index end) {
    for (Eigen::Index i = begin; i < end; ++i) {
      if (!places.col(i).allFinite()) continue;
      const auto found = tree.NearestWithin(places.col(i), radius);
      if (!found) continue;
      nearest[static_cast<std::size_t>(i)] =
          static_cast<std::int32_t>(found->index);
    }
  };
  ParallelFor(num_threads, places.cols(), 512, find);
  return nearest;
}

}  // namespace

std::vector<std::int32_t> FindNearestWithin(const KdTree& tree,
                                            const Points& places,
                                            double radius,
                                            int num_threads) {
  const Points& points = tree.points();
  const std::optional<Cells> cells = Cells::Make(points, radius);
  if (!cells) return FindByTree(tree, places, radius, num_threads);
  std::vector<std::int32_t> nearest(static_cast<std::size_t>(places.cols()),
                                    kNoneWithin);
  ZeroedVector<KeyedIndex> keyed;
  keyed.reserve(nearest.size());
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const auto key = cells->KeyOf(places.col(i));
    if (key) keyed.push_back({*key, static_cast<std::int32_t>(i)});
  }
  RadixSort(cells->num_key_bits(), &keyed);
  const auto find = [&](Eigen::Index begin, Eigen::Index end) {
    NearPoints near;
    Cells::Walk walk(*cells);
    std::optional<Cells::Key> of;
    for (Eigen::Index k = begin; k < end; ++k) {
      const auto& [key, i] = keyed[static_cast<std::size_t>(k)];
      if (of != key) {
        of = key;
        walk.FindNear(key, &near.index);
        near.Gather(points);
      }
      nearest[static_cast<std::size_t>(i)] =
          near.NearestTo(places.col(i), radius * radius);
    }
  };
  ParallelFor(num_threads, static_cast<Eigen::Index>(keyed.size()), 1024, find);
  return nearest;
}

}  // namespace quatro
