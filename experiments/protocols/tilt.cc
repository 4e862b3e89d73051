// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/protocols/tilt.h"

#include <cmath>
#include <cstdio>

#include "features/base/degree.h"

namespace quatro {

std::vector<RelativeTilting> MeasureTilts(const SequenceData& data,
                                          const DistanceBin& bin,
                                          const LoopOptions& options) {
  std::vector<RelativeTilting> tilts;
  for (const Loop& loop : FindLoops(data, bin, options)) {
    const Eigen::Matrix3d rotation =
        data.world_from_sensor.at(loop.target).rotation.transpose() *
        data.world_from_sensor.at(loop.source).rotation;
    const Attitude angles = AttitudeOf(rotation);
    RelativeTilting tilt;
    tilt.set = data.name;
    tilt.loop = loop;
    tilt.yaw = angles.yaw;
    tilt.roll = angles.roll;
    tilt.pitch = angles.pitch;
    tilt.tilt = AngleBetween(RotationZ(angles.yaw), rotation);
    tilts.push_back(tilt);
  }
  return tilts;
}

std::string FormatTilts(const std::vector<RelativeTilting>& tilts) {
  std::string text =
      "set,source,target,distance_m,yaw_deg,rollpitch_deg,roll_deg,"
      "pitch_deg\n";
  for (const RelativeTilting& tilt : tilts) {
    char numbers[200];
    std::snprintf(numbers,
                  sizeof(numbers),
                  ",%d,%d,%.4f,%.5f,%.5f,%.5f,%.5f\n",
                  tilt.loop.source,
                  tilt.loop.target,
                  tilt.loop.distance,
                  tilt.yaw / kDegree,
                  tilt.tilt / kDegree,
                  tilt.roll / kDegree,
                  tilt.pitch / kDegree);
    text += tilt.set + numbers;
  }
  return text;
}

}  // namespace quatro
