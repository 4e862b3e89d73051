// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/distinct_matches.h"

#include <glog/logging.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <utility>

#include "features/base/random.h"
#include "robust/graph/far_matches.h"

namespace quatro {
namespace {

std::uint64_t Hash(const Eigen::Vector3d& point) {
  std::uint64_t hash = 0;
  for (const double x : point) {
    hash = Mix(hash ^ std::bit_cast<std::uint64_t>(x + 0.0));  // Maps -0 to 0.
  }
  return hash;
}

// Uses only the columns in `order`.
DistinctMatches FindDistinct(const PointsRef& source,
                             const PointsRef& target,
                             std::vector<Eigen::Index> order) {
  std::vector<std::uint64_t> hash(static_cast<std::size_t>(source.cols()));
  for (const Eigen::Index i : order) {
    hash[static_cast<std::size_t>(i)] =
        Mix(Hash(source.col(i)) + Hash(target.col(i)));
  }
  const auto compare = [&](Eigen::Index i, Eigen::Index j) {
    const auto hash_i = hash[static_cast<std::size_t>(i)];
    const auto hash_j = hash[static_cast<std::size_t>(j)];
    if (hash_i != hash_j) return hash_i < hash_j ? -1 : 1;
    for (int axis = 0; axis < 3; ++axis) {
      if (source(axis, i) != source(axis, j)) {
        return source(axis, i) < source(axis, j) ? -1 : 1;
      }
      if (target(axis, i) != target(axis, j)) {
        return target(axis, i) < target(axis, j) ? -1 : 1;
      }
    }
    return 0;
  };
  std::sort(order.begin(), order.end(), [&](Eigen::Index i, Eigen::Index j) {
    const int sign = compare(i, j);
    return sign != 0 ? sign < 0 : i < j;
  });

  DistinctMatches distinct;
  for (const Eigen::Index i : order) {
    if (distinct.columns.empty() ||
        compare(distinct.columns.back().front(), i) != 0) {
      distinct.columns.emplace_back();
    }
    distinct.columns.back().push_back(i);
  }
  const auto num_matches = static_cast<Eigen::Index>(distinct.columns.size());
  distinct.source.resize(3, num_matches);
  distinct.target.resize(3, num_matches);
  for (Eigen::Index k = 0; k < num_matches; ++k) {
    const Eigen::Index i =
        distinct.columns[static_cast<std::size_t>(k)].front();
    distinct.source.col(k) = source.col(i);
    distinct.target.col(k) = target.col(i);
  }
  return distinct;
}

}  // namespace

DistinctMatches FindDistinctMatches(const PointsRef& source,
                                    const PointsRef& target) {
  CHECK_EQ(source.cols(), target.cols());
  std::vector<Eigen::Index> all(static_cast<std::size_t>(source.cols()));
  std::iota(all.begin(), all.end(), 0);
  return FindDistinct(source, target, std::move(all));
}

DistinctMatches FindDistinctMatches(const PointsRef& source,
                                    const PointsRef& target,
                                    double noise_bound) {
  CHECK_EQ(source.cols(), target.cols());
  return FindDistinct(
      source, target, FindPlaceable(source, target, noise_bound));
}

std::vector<Eigen::Index> InputColumns(
    const DistinctMatches& matches, const std::vector<Eigen::Index>& selected) {
  std::vector<Eigen::Index> columns;
  for (const Eigen::Index k : selected) {
    const auto& copies = matches.columns[static_cast<std::size_t>(k)];
    columns.insert(columns.end(), copies.begin(), copies.end());
  }
  std::sort(columns.begin(), columns.end());
  return columns;
}

std::vector<double> InputValues(const DistinctMatches& matches,
                                const std::vector<Eigen::Index>& selected,
                                const std::vector<double>& values) {
  CHECK_EQ(selected.size(), values.size());
  std::vector<std::pair<Eigen::Index, double>> of_columns;
  for (std::size_t k = 0; k < selected.size(); ++k) {
    for (const Eigen::Index column :
         matches.columns[static_cast<std::size_t>(selected[k])]) {
      of_columns.emplace_back(column, values[k]);
    }
  }
  std::sort(of_columns.begin(), of_columns.end());
  std::vector<double> in_order;
  in_order.reserve(of_columns.size());
  for (const auto& of_column : of_columns) in_order.push_back(of_column.second);
  return in_order;
}

Points Columns(const PointsRef& points,
               const std::vector<Eigen::Index>& columns) {
  Points selected(3, static_cast<Eigen::Index>(columns.size()));
  Eigen::Index k = 0;
  for (const Eigen::Index column : columns) {
    selected.col(k++) = points.col(column);
  }
  return selected;
}

}  // namespace quatro
