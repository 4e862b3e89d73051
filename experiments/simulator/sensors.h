// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Sensors by name, with the properties of their data sheets. Spinning sensors
// make ten revolutions per second.
//
//   hdl64e        Velodyne HDL-64E: +2 to -24.33 deg, 2083 columns, 120 m, 2 cm
//   vlp16         Velodyne VLP-16: +15 to -15 deg in steps of 2 deg, 1800
//                 columns, 100 m, 2 cm (3 cm is the bound of the data sheet)
//   os1_64        Ouster OS1-64 of the first generation: +16.6 to -16.6 deg in
//                 even steps, beams staggered in azimuth in groups of four,
//                 1024 columns, 120 m, 2 cm
//   os1_128       Ouster OS1-128: +22.5 to -22.5 deg in even steps, beams
//                 staggered in azimuth in groups of four, 1024 columns, 120 m,
//                 2 cm
//   livox         like a Livox Avia: six lines 0.3 deg apart in a pattern that
//                 repeats only after 100 frames, within 70 x 77 deg ahead,
//                 24,000 rays per frame, 190 m, 2 cm
//   tls           terrestrial, on a tripod: the sphere above -60 deg in steps
//                 of 0.07 deg, 130 m, 3 mm; 11 million rays, about 6 million
//                 points among buildings
//   depth_camera  like a Kinect: 640 x 480 pixels, 58 x 45 deg ahead, 0.5 to 8
//                 m, an error of 1.4 mm at 1 m that grows with the square of
//                 the range

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_SENSORS_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_SENSORS_H_

#include <optional>
#include <string>
#include <vector>

#include "experiments/simulator/lidar.h"

namespace quatro {

// In the order above.
std::vector<std::string> SensorNames();

// Returns nullopt, with the known names in *error, if `name` is unknown.
std::optional<LidarOptions> MakeSensor(const std::string& name,
                                       std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_SENSORS_H_
