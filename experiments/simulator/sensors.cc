// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/sensors.h"

#include <array>
#include <cmath>

#include "features/base/degree.h"

namespace quatro {
namespace {

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

// The beams are staggered in azimuth in groups of four [deg].
LidarOptions MakeOs1(double top_deg,
                     int num_beams,
                     const std::array<double, 4>& stagger) {
  LidarOptions options;
  options.elevations = EvenElevations(top_deg, num_beams);
  for (int i = 0; i < num_beams; ++i) {
    options.azimuth_offsets.push_back(stagger[static_cast<size_t>(i % 4)] *
                                      kDegree);
  }
  options.num_columns = 1024;
  options.min_range = 0.5;
  return options;
}

LidarOptions MakeLivox() {
  constexpr double kStep = 0.3;  // Between lines [deg].
  constexpr int kNumLines = 6;
  LidarOptions options;
  options.pattern = ScanPattern::kRosette;
  options.elevations = EvenElevations(kStep * (kNumLines - 1) / 2.0, kNumLines);
  options.num_columns = 4000;
  options.width = 70.4 * kDegree;
  options.height = (77.2 - kStep * (kNumLines - 1)) * kDegree;
  options.min_range = 1.0;
  options.max_range = 190.0;
  options.range_sigma = 0.02;
  return options;
}

LidarOptions MakeTls() {
  constexpr double kStep = 0.07;  // [deg]
  constexpr double kLowest = -60.0;
  LidarOptions options;
  options.elevations.clear();
  for (int i = 0; kLowest + i * kStep < 90.0; ++i) {
    options.elevations.push_back((kLowest + i * kStep) * kDegree);
  }
  options.num_columns = static_cast<int>(std::lround(360.0 / kStep));
  options.min_range = 0.6;
  options.max_range = 130.0;
  options.range_sigma = 0.003;
  options.dropout_rate = 0.01;
  return options;
}

LidarOptions MakeDepthCamera() {
  constexpr int kNumRows = 480;
  LidarOptions options;
  options.pattern = ScanPattern::kPinhole;
  options.num_columns = 640;
  options.width = 58.0 * kDegree;
  const double top = std::tan(45.0 / 2.0 * kDegree);
  options.elevations.clear();
  for (int i = 0; i < kNumRows; ++i) {
    options.elevations.push_back(
        std::atan(top * (1.0 - 2.0 * (i + 0.5) / kNumRows)));
  }
  options.min_range = 0.5;
  options.max_range = 8.0;
  options.range_sigma = 0.0;
  options.range_sigma_growth = 0.0014;
  return options;
}

struct KnownSensor {
  const char* name;
  LidarOptions (*make)();
};

const KnownSensor kSensors[] = {
    {"hdl64e", [] { return LidarOptions(); }},
    {"vlp16", MakeVlp16},
    {"os1_64",
     [] {
       return MakeOs1(16.6, 64, {3.164, 1.055, -1.055, -3.164});
     }},
    {"os1_128",
     [] {
       return MakeOs1(22.5, 128, {4.2, 1.4, -1.4, -4.2});
     }},
    {"livox", MakeLivox},
    {"tls", MakeTls},
    {"depth_camera", MakeDepthCamera}};

}  // namespace

std::vector<std::string> SensorNames() {
  std::vector<std::string> names;
  for (const KnownSensor& sensor : kSensors) names.emplace_back(sensor.name);
  return names;
}

std::optional<LidarOptions> MakeSensor(const std::string& name,
                                       std::string* error) {
  for (const KnownSensor& sensor : kSensors) {
    if (name == sensor.name) return sensor.make();
  }
  *error = "'" + name + "', must be one of";
  for (const std::string& known : SensorNames()) *error += " " + known;
  return std::nullopt;
}

}  // namespace quatro
