// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The INS of KITTI, oxts/data/0000000000.txt ..., one file per frame with one
// line of 30 numbers. The first six are read: lat lon alt [deg, deg, m] and
// roll pitch yaw [rad]. With s = cos(first lat) and the Earth's radius E,
//
//   x = s E lon,   y = s E log tan((90 deg + lat) / 2),   z = alt,        (1)
//   world_from_imu = R_z(yaw) R_y(pitch) R_x(roll),
//
// x to the east, y to the north, z up. Longitudes are relative to the first
// frame, by the shorter way around, if necessary across the date line.
//
// Source: development kit of the KITTI raw data, for the definition (Geiger et
// al., IJRR 2013).

#ifndef QUATRO_EXPERIMENTS_DATASETS_OXTS_H_
#define QUATRO_EXPERIMENTS_DATASETS_OXTS_H_

#include <map>
#include <optional>
#include <string>

#include "features/base/rigid3.h"
#include "solvers/closed_form/gravity.h"

namespace quatro {

struct OxtsReading {
  double latitude = 0.0;   // [deg], within (-90, 90).
  double longitude = 0.0;  // [deg], within [-360, 360].
  double altitude = 0.0;   // [m], within 100 km.
  Attitude attitude;       // World from IMU.
};

// Frame -> reading, for all files of `folder`/data. Returns nullopt with *error
// set, which names file and line, if there are none or one is invalid.
std::optional<std::map<int, OxtsReading>> ReadOxts(const std::string& folder,
                                                   std::string* error);

// Frame -> world_from_imu by (1), relative to the position of the first frame.
std::map<int, Rigid3> PosesOfOxts(const std::map<int, OxtsReading>& readings);

// Reads velodyne_from_imu: line "R:" with 9 numbers, row by row, and line "T:"
// with 3 numbers [m]. Other lines are ignored.
std::optional<Rigid3> ReadImuToVelodyne(const std::string& path,
                                        std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_OXTS_H_
