// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/sensors.h"

#include <cmath>

namespace quatro {
namespace {

constexpr double kDegree = M_PI / 180.0;

std::vector<double> EvenElevations(double top_deg, int num_beams) {
  std::vector<double> elevations;
  elevations.reserve(static_cast<std::size_t>(num_beams));
  for (int i = 0; i < num_beams; ++i) {
    elevations.push_back(top_deg * (1.0 - 2.0 * i / (num_beams - 1)) * kDegree);
  }
  return elevations;
}

LidarOptions MakeVlp16() {
  LidarOptions options;
  options.elevations = EvenElevations(15.0, 16);
  options.num_columns = 1800;
  options.min_range = 0.4;
  options.max_range = 100.0;
  return options;
}

LidarOptions MakeOs1() {
  constexpr double kStagger[] = {3.164, 1.055, -1.055, -3.164};  // [deg]
  LidarOptions options;
  options.elevations = EvenElevations(16.6, 64);
  for (int i = 0; i < 64; ++i) {
    options.azimuth_offsets.push_back(kStagger[i % 4] * kDegree);
  }
  options.num_columns = 1024;
  options.min_range = 0.5;
  return options;
}

}  // namespace

std::vector<std::string> SensorNames() { return {"hdl64e", "vlp16", "os1_64"}; }

std::optional<LidarOptions> MakeSensor(const std::string& name,
                                       std::string* error) {
  if (name == "hdl64e") return LidarOptions();
  if (name == "vlp16") return MakeVlp16();
  if (name == "os1_64") return MakeOs1();
  *error = "'" + name + "', must be one of";
  for (const std::string& known : SensorNames()) *error += " " + known;
  return std::nullopt;
}

}  // namespace quatro
