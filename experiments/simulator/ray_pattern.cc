// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/ray_pattern.h"

#include <algorithm>
#include <sstream>

namespace quatro {
namespace {

// Revolutions of the prisms per frame; whole numbers in 100 frames.
constexpr double kTurnsOfFirst = 12.16;
constexpr double kTurnsOfSecond = -7.77;
constexpr double kFramesUntilRepeated = 100.0;

Eigen::Vector3d Direction(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth),
          std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

}  // namespace

bool RayPattern::IsValid(std::string* error) const {
  std::ostringstream problem;
  const double half = pattern == ScanPattern::kRosette ? height / 2.0 : 0.0;
  const auto is_steep = [half](double elevation) {
    return !(std::abs(elevation) + half < M_PI / 2.0);
  };
  const auto steep =
      std::find_if(elevations.begin(), elevations.end(), is_steep);
  if (elevations.empty()) {
    problem << "elevations is empty, must have one number per beam";
  } else if (!(height >= 0.0)) {
    problem << "height = " << height << ", must be >= 0";
  } else if (steep != elevations.end()) {
    problem << "elevations[" << steep - elevations.begin() << "] = " << *steep
            << ", must be within +-pi/2";
    if (half > 0.0) problem << " with half of height = " << height;
  } else if (!azimuth_offsets.empty() &&
             azimuth_offsets.size() != elevations.size()) {
    problem << "azimuth_offsets has " << azimuth_offsets.size()
            << " numbers, must have none or one per beam, "
            << elevations.size();
  } else if (num_columns < 1) {
    problem << "num_columns = " << num_columns << ", must be >= 1";
  } else if (!(width > 0.0 && width <= 2.0 * M_PI)) {
    problem << "width = " << width << ", must be in (0, 2 pi]";
  } else if (pattern == ScanPattern::kPinhole && !(width < M_PI)) {
    problem << "width = " << width << " of a camera, must be < pi";
  }
  *error = problem.str();
  return error->empty();
}

Ray RayOf(const RayPattern& pattern,
          std::size_t beam,
          std::size_t column,
          double random) {
  const auto num_columns = static_cast<double>(pattern.num_columns);
  const double elevation = pattern.elevations[beam];
  const auto c = static_cast<double>(column);
  if (pattern.pattern == ScanPattern::kPinhole) {
    const Eigen::Vector3d pixel(
        1.0,
        std::tan(pattern.width / 2.0) * (1.0 - 2.0 * (c + 0.5) / num_columns),
        std::tan(elevation));
    return {pixel.normalized(), 0.5};  // Equation (3).
  }
  const double offset =
      pattern.azimuth_offsets.empty() ? 0.0 : pattern.azimuth_offsets[beam];
  if (pattern.pattern == ScanPattern::kSpinning) {
    const double turned = 2.0 * M_PI * (c + random) / num_columns;
    return {Direction(offset - turned, elevation), turned / (2.0 * M_PI)};
  }
  const double fraction = (c + 0.5) / num_columns;
  const double start = std::floor(kFramesUntilRepeated * random);
  const double p = 2.0 * M_PI * kTurnsOfFirst * (fraction + start);
  const double q = 2.0 * M_PI * kTurnsOfSecond * (fraction + start);
  const double azimuth = pattern.width / 4.0 * (std::cos(p) + std::cos(q));
  const double deflection = pattern.height / 4.0 * (std::sin(p) + std::sin(q));
  return {Direction(offset + azimuth, elevation + deflection),  // Equation (2).
          fraction};
}

}  // namespace quatro
