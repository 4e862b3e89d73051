// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A map of disks. A surfel is a point, a normal, a radius and a confidence as
// log odds l. A measured vertex v with normal n has the radius
//
//   r = sqrt(2) |v| s / clamp(|n . v| / |v|, 1/2, 1),   s a pixel [rad], (1)
//
// A measurement consistent with a surfel at distance d along its normal, with
// angle a between the normals, adds
//
//   odds(p exp(-a^2 / sigma_a^2) exp(-d^2 / sigma_d^2)),
//   odds(x) = log(x / (1 - x));                                            (2)
//
// an inconsistent one subtracts odds(p) and starts a new surfel with log odds
// zero. Surfels are removed if their log odds are not positive after the time
// for confirmation, if they have not been seen for long, or if they are far
// away.
//
// Source: SuMa (see experiments/odometry/suma/vertex_map.h), Section III.D.
// Unlike SuMa, disks are drawn by the CPU, pixel by pixel. There are no submaps
// because there is no loop closure.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_SUMA_SURFEL_MAP_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_SUMA_SURFEL_MAP_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/odometry/suma/vertex_map.h"
#include "features/base/rigid3.h"

namespace quatro {

struct SurfelMapOptions {
  double max_distance = 0.3;    // Along the normal [m].
  double max_angle = 0.52;      // Between the normals [rad].
  double blend = 0.1;           // Weight of a new measurement.
  double stable = 0.65;         // p
  double sigma_angle = 0.5;     // [rad]
  double sigma_distance = 0.3;  // [m]
  int confirm_within = 5;       // Scans.
  int forget_after = 100;       // Scans.
  double radius = 100.0;        // Around the sensor [m].

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

struct Surfel {
  Eigen::Vector3d position;  // In the map [m].
  Eigen::Vector3d normal;    // Unit.
  double radius = 0.0;       // [m]
  double log_odds = 0.0;
  int created = 0;  // Index of the scan.
  int seen = 0;     // The last consistent scan.
};

// The map as seen from the sensor.
struct RenderedMap {
  VertexMap view;                     // In the sensor's frame.
  std::vector<std::int32_t> surfels;  // Per pixel; -1: none.
};

class SurfelMap {
 public:
  // `options` must be valid.
  explicit SurfelMap(const SurfelMapOptions& options);

  RenderedMap Render(const SphericalImage& image,
                     const Rigid3& map_from_sensor) const;

  // Adds a scan to the map and increments the scan counter.
  void Update(const VertexMap& scan, const Rigid3& map_from_sensor);

  const std::vector<Surfel>& surfels() const { return surfels_; }

 private:
  SurfelMapOptions options_;
  std::vector<Surfel> surfels_;
  int num_scans_ = 0;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_SUMA_SURFEL_MAP_H_
