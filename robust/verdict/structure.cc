// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/structure.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace quatro {
namespace {

constexpr double kRangeQuantile = 0.75;

}  // namespace

bool IsStructure(const Eigen::Vector3d& normal) {
  return !normal.isZero(0.0) && std::abs(normal.z()) <= kMaxVertical;
}

double UsefulRange(const DescribedCloud& cloud) {
  const Points& points = cloud.points();
  std::vector<double> squared(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    squared[static_cast<std::size_t>(i)] =
        (points.col(i) - cloud.sensor).squaredNorm();
  }
  if (squared.empty()) return 0.0;
  const auto at = squared.begin() +
                  static_cast<std::ptrdiff_t>(
                      kRangeQuantile * static_cast<double>(squared.size() - 1));
  std::nth_element(squared.begin(), at, squared.end());
  return std::sqrt(*at);
}

}  // namespace quatro
