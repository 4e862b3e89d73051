// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/kd_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <nanoflann.hpp>
#include <optional>
#include <utility>

#include "features/base/parallel.h"
#include "features/base/simd.h"
#include "features/cell_neighborhoods.h"

namespace quatro {
namespace {

// The interface that nanoflann expects from a set of points.
struct Adaptor {
  const Points& points;

  std::size_t kdtree_get_point_count() const {
    return static_cast<std::size_t>(points.cols());
  }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points(static_cast<Eigen::Index>(axis),
                  static_cast<Eigen::Index>(i));
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<
    nanoflann::L2_Simple_Adaptor<double, Adaptor>,
    Adaptor,
    3,
    std::uint32_t>;

constexpr std::size_t kLeafSize = 16;

// nanoflann keeps distances < limit, and prunes by sums that round differently
// from the distances. This limit is large enough to include the boundary of the
// ball.
double LimitOf(double squared_radius) {
  constexpr double kPruningError = 1e-12;
  return std::nextafter(squared_radius * (1.0 + kPruningError),
                        std::numeric_limits<double>::infinity());
}

// Our own result sets, because nanoflann's changed names and types between 1.4
// and 1.12. nanoflann calls sort() since 1.6 and needs the types since 1.7.
struct ResultSet {
  using DistanceType = double;
  using IndexType = std::uint32_t;

  double limit;

  double worstDist() const { return limit; }
  bool full() const { return true; }
  void sort() {}
};

// The nearest of the points below `limit`, which shrinks to its distance.
struct NearestBelow : ResultSet {
  std::optional<std::uint32_t> index;

  bool addPoint(double squared_distance, std::uint32_t i) {
    if (squared_distance < limit) {
      limit = squared_distance;
      index = i;
    }
    return true;
  }
  std::size_t size() const { return index ? 1 : 0; }
};

// All points below `limit`, with their squared distances.
struct AllBelow : ResultSet {
  std::vector<std::pair<std::uint32_t, double>> found;

  bool addPoint(double squared_distance, std::uint32_t i) {
    if (squared_distance < limit) found.emplace_back(i, squared_distance);
    return true;
  }
  std::size_t size() const { return found.size(); }
};

// find(i) returns the neighbors of point i.
template <typename Find>
Neighborhoods FindRows(Eigen::Index num_points,
                       int num_threads,
                       const Find& find) {
  NeighborhoodsBuilder builder(num_points);
  const auto find_some = [&](Eigen::Index begin, Eigen::Index end) {
    NeighborhoodsBuilder::Writer writer(&builder);
    for (Eigen::Index i = begin; i < end; ++i) {
      const std::vector<Neighbor> found = find(i);
      const auto room = writer.MakeRoom(found.size());
      for (std::size_t k = 0; k < found.size(); ++k) {
        room.index[k] = static_cast<std::int32_t>(found[k].index);
        room.squared_distance[k] =
            static_cast<float>(found[k].squared_distance);
      }
      writer.Add(i, found.size());
    }
  };
  ParallelFor(num_threads, num_points, 256, find_some);
  return std::move(builder).Finish();
}

}  // namespace

class KdTree::Index {
 public:
  explicit Index(const Points& points) : adaptor_{points} {}

  // Builds the tree on first use, which may never happen.
  const Tree& tree() {
    std::call_once(once_, [this] {
      tree_ = std::make_unique<Tree>(
          3, adaptor_, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize));
      tree_->buildIndex();
    });
    return *tree_;
  }

 private:
  Adaptor adaptor_;
  std::once_flag once_;
  std::unique_ptr<Tree> tree_;
};

KdTree::KdTree(Points points)
    : points_(std::make_unique<const Points>(std::move(points))),
      index_(std::make_unique<Index>(*points_)) {}
KdTree::~KdTree() = default;
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;

std::vector<Neighbor> KdTree::WithinRadius(const Eigen::Vector3d& query,
                                           double radius) const {
  const double squared_radius = radius * radius;
  AllBelow below{{LimitOf(squared_radius)}, {}};
  index_->tree().findNeighbors(below, query.data(), {});
  std::sort(below.found.begin(), below.found.end());
  std::vector<Neighbor> neighbors;
  neighbors.reserve(below.found.size());
  for (const auto& [i, d2] : below.found) {
    if (d2 <= squared_radius) neighbors.push_back({i, d2});
  }
  return neighbors;
}

std::vector<Neighbor> KdTree::Nearest(const Eigen::Vector3d& query,
                                      int k) const {
  if (k < 1) return {};
  if (k == 1) {
    std::uint32_t index = 0;
    double squared_distance = 0.0;
    if (index_->tree().knnSearch(query.data(), 1, &index, &squared_distance) ==
        0) {
      return {};
    }
    return {{index, squared_distance}};
  }
  std::vector<std::uint32_t> indices(static_cast<std::size_t>(k));
  std::vector<double> d2(static_cast<std::size_t>(k));
  const std::size_t num_found = index_->tree().knnSearch(
      query.data(), static_cast<std::size_t>(k), indices.data(), d2.data());
  std::vector<Neighbor> neighbors;
  neighbors.reserve(num_found);
  for (std::size_t i = 0; i < num_found; ++i) {
    neighbors.push_back({indices[i], d2[i]});
  }
  return neighbors;
}

std::optional<Neighbor> KdTree::NearestWithin(const Eigen::Vector3d& query,
                                              double radius) const {
  const double squared_radius = radius * radius;
  NearestBelow nearest{{LimitOf(squared_radius)}, std::nullopt};
  index_->tree().findNeighbors(nearest, query.data(), {});
  if (!nearest.index || nearest.limit > squared_radius) return std::nullopt;
  return Neighbor{*nearest.index, nearest.limit};
}

Neighborhoods FindNeighborhoods(const KdTree& tree,
                                double radius,
                                int num_threads) {
  if (auto found = FindNeighborhoodsByCells(
          tree.points(), radius, num_threads, BestSimdLevel())) {
    return *std::move(found);
  }
  return FindNeighborhoodsByTree(tree, radius, num_threads);
}

Neighborhoods FindNeighborhoodsByTree(const KdTree& tree,
                                      double radius,
                                      int num_threads) {
  return FindRows(tree.points().cols(), num_threads, [&](Eigen::Index i) {
    return tree.WithinRadius(tree.points().col(i), radius);
  });
}

Neighborhoods FindNearestNeighborhoods(const KdTree& tree,
                                       int k,
                                       int num_threads) {
  return FindRows(tree.points().cols(), num_threads, [&](Eigen::Index i) {
    return tree.Nearest(tree.points().col(i), k);
  });
}

}  // namespace quatro
