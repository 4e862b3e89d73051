// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A lidar or a depth camera during one frame, stationary or moving uniformly.
//
// The ray d of a beam and a column (ray_pattern.h) measures the point
// d (r + n), with the distance r to the first triangle that it hits and
//
//   n ~ N(0, sigma^2),   sigma = range_sigma + range_sigma_growth r^2.     (1)
//
// An echo is missed with probability
//
//   1 - (1 - dropout_rate) / (1 + (r / r0)^8),
//   r0 = max_range sqrt(reflectance / 0.8 * sqrt(cos(incidence))),        (2)
//
// so that asphalt fades out at about 30 m and a white facade at normal
// incidence at 100 m. Noise, phase and misses are hashes of (seed, frame, beam,
// column), so a scan is bit for bit the same for any number of threads.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_LIDAR_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_LIDAR_H_

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "experiments/simulator/ray_pattern.h"
#include "experiments/simulator/scene.h"
#include "features/base/rigid3.h"
#include "features/io/point_cloud.h"

// Embree's types.
struct RTCDeviceTy;
struct RTCSceneTy;

namespace quatro {

// The time between two frames of a sequence [s].
inline constexpr double kFramePeriod = 0.1;

// The beams of a Velodyne HDL-64E, top to bottom: 32 from +2 to -8.33 deg in
// steps of 1/3 deg, 32 from -8.83 to -24.33 deg in steps of 1/2 deg. [rad]
std::vector<double> Hdl64Elevations();

// A sensor; the default is the HDL-64E, a column every 0.1728 deg.
struct LidarOptions : RayPattern {
  LidarOptions() {
    elevations = Hdl64Elevations();
    num_columns = 2083;
  }

  double min_range = 0.9;           // [m]
  double max_range = 120.0;         // [m]
  double range_sigma = 0.02;        // [m]
  double range_sigma_growth = 0.0;  // As for depth cameras [1/m].
  double dropout_rate = 0.05;       // Probability of a miss at any range.

  bool IsValid(std::string* error) const;
};

// Identifies a scan. Only noise, phase and misses depend on it.
struct ScanId {
  uint64_t seed = 1;
  uint64_t frame = 0;
};

// The motion of the sensor during one frame. Points are in the frame of the
// sensor at the time of their ray. A ray at the fraction f is cast from
//
//   R exp((f - 1/2) turn),  t + (f - 1/2) velocity,                        (3)
//
// where (R, t) is the pose in the middle of the frame.
struct Sweep {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // In the world [m].
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();      // Rotation vector [rad].

  bool IsStill() const { return velocity.isZero(0.0) && turn.isZero(0.0); }
};

// A scene prepared for ray casting with Embree.
class LidarScene {
 public:
  // Returns nullptr and sets *error if Embree fails.
  static std::unique_ptr<LidarScene> Create(const Scene& scene,
                                            std::string* error);
  ~LidarScene();
  LidarScene(const LidarScene&) = delete;
  LidarScene& operator=(const LidarScene&) = delete;

  // Points in the sensor frame (x forward, y left, z up) with intensities in
  // [0, 1], beam by beam. `options` must be valid; num_threads 0 uses all
  // cores. `others`, if given, contains more objects of the same world.
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
