// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/report/quantized_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace quatro {
namespace {

constexpr double kMaxSteps = 32767.0;

}  // namespace

PointGrid FindGrid(const PointsRef& points) {
  PointGrid grid;
  if (points.cols() == 0) return grid;
  const Eigen::Vector3d low = points.rowwise().minCoeff();
  const Eigen::Vector3d high = points.rowwise().maxCoeff();
  // This avoids the overflow of (low + high) / 2.
  grid.origin = low + 0.5 * (high - low);
  const double half =
      (high - grid.origin).cwiseMax(grid.origin - low).maxCoeff();
  if (half > 0.0) grid.step = half / kMaxSteps;
  return grid;
}

std::string QuantizePoints(const PointsRef& points, const PointGrid& grid) {
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(6 * points.cols()));
  for (const auto point : points.colwise()) {
    for (int axis = 0; axis < 3; ++axis) {
      const double steps =
          std::round((point(axis) - grid.origin(axis)) / grid.step);
      const auto whole = static_cast<std::uint16_t>(
          static_cast<std::int16_t>(std::clamp(steps, -kMaxSteps, kMaxSteps)));
      bytes += static_cast<char>(whole & 0xff);
      bytes += static_cast<char>(whole >> 8);
    }
  }
  return bytes;
}

}  // namespace quatro
