// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/graph/far_matches.h"

#include <glog/logging.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace quatro {
namespace {

constexpr double kNear = 20.0;
constexpr double kPlaceable = 1.0 / std::numeric_limits<double>::epsilon();

std::vector<Eigen::Index> AllColumns(const PointsRef& points) {
  std::vector<Eigen::Index> all(static_cast<std::size_t>(points.cols()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

double MedianOf(Eigen::VectorXd values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Whether each point is within `factor`. Avoids squares, which might overflow.
Eigen::Array<bool, 1, Eigen::Dynamic> AreWithin(const PointsRef& points,
                                                double factor,
                                                double noise_bound) {
  const Eigen::VectorXd distances = (points.colwise() - Median(points))
                                        .colwise()
                                        .lpNorm<Eigen::Infinity>()
                                        .transpose();
  const double scale = std::max(MedianOf(distances), noise_bound);
  return distances.transpose().array() <= factor * scale;
}

std::vector<Eigen::Index> FindWithin(const PointsRef& source,
                                     const PointsRef& target,
                                     double factor,
                                     double noise_bound) {
  const auto are_within = (AreWithin(source, factor, noise_bound) &&
                           AreWithin(target, factor, noise_bound))
                              .eval();
  std::vector<Eigen::Index> within;
  for (Eigen::Index i = 0; i < are_within.size(); ++i) {
    if (are_within[i]) within.push_back(i);
  }
  return within;
}

}  // namespace

Eigen::Vector3d Median(const PointsRef& points) {
  Eigen::Vector3d median;
  for (int axis = 0; axis < 3; ++axis) {
    median[axis] = MedianOf(points.row(axis).transpose());
  }
  return median;
}

std::vector<Eigen::Index> FindNear(const PointsRef& source,
                                   const PointsRef& target,
                                   double noise_bound) {
  CHECK_EQ(source.cols(), target.cols());
  if (source.cols() == 0) return {};
  auto near = FindWithin(source, target, kNear, noise_bound);
  return near.empty() ? AllColumns(source) : near;
}

std::vector<Eigen::Index> FindPlaceable(const PointsRef& source,
                                        const PointsRef& target,
                                        double noise_bound) {
  CHECK_EQ(source.cols(), target.cols());
  const double reach = std::max(source.lpNorm<Eigen::Infinity>(),
                                target.lpNorm<Eigen::Infinity>());
  if (2.0 * reach > kPlaceable * noise_bound) {
    return FindWithin(source, target, kPlaceable, noise_bound);
  }
  return AllColumns(source);
}

}  // namespace quatro
