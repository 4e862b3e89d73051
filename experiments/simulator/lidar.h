// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A spinning lidar that turns once, standing still or moving evenly.
//
// Beam b and column c look along
//
//   d = (cos e cos a, cos e sin a, sin e),   e = elevation[b],
//   a = offset[b] - 2 pi (c + phase) / num_columns,                      (1)
//
// phase in [0, 1) of the frame,
//
// and measure d (r + n), with r the distance to the first triangle on the ray
// and n ~ N(0, range_sigma^2). An echo is missed with probability
//
//   1 - (1 - dropout_rate) / (1 + (r / r0)^8),
//   r0 = max_range sqrt(reflectance / 0.8 * sqrt(cos(incidence))),        (2)
//
// so that asphalt fades out at about 30 m and a white facade seen head-on at
// 100 m. Noise, phase and misses are hashes of (seed, frame, beam, column):
// a scan is the same bit by bit for any number of threads.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_LIDAR_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_LIDAR_H_

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "experiments/simulator/scene.h"
#include "features/base/rigid3.h"
#include "features/io/point_cloud.h"

// Of Embree.
struct RTCDeviceTy;
struct RTCSceneTy;

namespace quatro {

// The beams of a Velodyne HDL-64E, top to bottom: 32 from +2 to -8.33 deg in
// steps of 1/3 deg, 32 from -8.83 to -24.33 deg in steps of 1/2 deg. [rad]
std::vector<double> Hdl64Elevations();

struct LidarOptions {
  std::vector<double> elevations = Hdl64Elevations();  // [rad]
  std::vector<double> azimuth_offsets;  // Of each beam [rad]; empty: all 0.
  int num_columns = 2083;               // Per turn: one each 0.1728 deg.
  double min_range = 0.9;               // [m]
  double max_range = 120.0;             // [m]
  double range_sigma = 0.02;            // [m]
  double dropout_rate = 0.05;           // Echoes missed however good they are.

  bool IsValid(std::string* error) const;
};

// Which scan it is; only the random part depends on it.
struct ScanId {
  uint64_t seed = 1;
  uint64_t frame = 0;
};

// How the sensor moves while it turns once. Points stay in the frame of the
// sensor at their own moment, as they are measured: column c of n is seen from
//
//   R exp((f - 1/2) turn),  t + (f - 1/2) velocity,   f = (c + phase) / n,  (3)
//
// with (R, t) the pose in the middle of the turn.
struct Sweep {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // In the world [m].
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();      // Of the sensor [rad].

  bool IsStill() const { return velocity.isZero(0.0) && turn.isZero(0.0); }
};

// A scene made ready for ray casting by Embree.
class LidarScene {
 public:
  // Returns a nullptr and sets *error if Embree refuses.
  static std::unique_ptr<LidarScene> Create(const Scene& scene,
                                            std::string* error);
  ~LidarScene();
  LidarScene(const LidarScene&) = delete;
  LidarScene& operator=(const LidarScene&) = delete;

  // Points in the sensor frame (x forward, y left, z up) with intensities in
  // [0, 1], beam by beam. `options` must be valid; num_threads 0 is all there
  // are. `others`, if given, is in the same world.
  PointCloud Scan(const Rigid3& world_from_sensor,
                  const LidarOptions& options,
                  const ScanId& id,
                  int num_threads,
                  const Sweep& sweep = {},
                  const LidarScene* others = nullptr) const;

 private:
  LidarScene() = default;

  RTCDeviceTy* device_ = nullptr;
  RTCSceneTy* scene_ = nullptr;
  std::vector<float> reflectances_;  // Per triangle.
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_LIDAR_H_
