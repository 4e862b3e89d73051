// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Lidars by name, with the properties of their data sheets at ten revolutions
// per second:
//
//   hdl64e  Velodyne HDL-64E: +2 to -24.33 deg, 2083 columns, 120 m, 2 cm
//   vlp16   Velodyne VLP-16: +15 to -15 deg in steps of 2 deg, 1800 columns,
//           100 m, 2 cm (3 cm is the bound of the data sheet)
//   os1_64  Ouster OS1-64 of the first generation: +16.6 to -16.6 deg in even
//           steps, its beams staggered in azimuth by fours, 1024 columns,
//           120 m, 2 cm

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_SENSORS_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_SENSORS_H_

#include <optional>
#include <string>
#include <vector>

#include "experiments/simulator/lidar.h"

namespace quatro {

std::vector<std::string> SensorNames();

// Returns nullopt, with the known names in *error, if `name` is unknown.
std::optional<LidarOptions> MakeSensor(const std::string& name,
                                       std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_SENSORS_H_
