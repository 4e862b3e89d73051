// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A map of disks. A surfel is a point, a normal, a radius and how well it is
// confirmed, as log odds l. Of a measured vertex v with normal n the radius is
//
//   r = sqrt(2) |v| s / clamp(|n . v| / |v|, 1/2, 1),   s a pixel [rad], (1)
//
// and one that agrees with a surfel at distance d along its normal, turned by
// a, adds
//
//   odds(p exp(-a^2 / sigma_a^2) exp(-d^2 / sigma_d^2)),
//   odds(x) = log(x / (1 - x));                                            (2)
//
// one that does not takes odds(p) away and starts a surfel of its own, at zero.
// Surfels that are not above zero are forgotten once they have had time to be
// confirmed, and so are those not seen for long or far away.
//
// Source: SuMa (see experiments/odometry/suma/vertex_map.h), Section III.D.
// Unlike there, disks are drawn by the CPU, pixel by pixel, and there are no
// submaps, as there is no closing of loops.

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
  double max_distance = 0.3;    // Along the normal, to agree [m].
  double max_angle = 0.52;      // [rad]
  double blend = 0.1;           // Of a measurement into a surfel.
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
  int created = 0;  // The scan.
  int seen = 0;     // The last scan that agreed.
};

// What the sensor would see of the map.
struct RenderedMap {
  VertexMap view;                     // In the sensor's frame.
  std::vector<std::int32_t> surfels;  // By pixel; -1 for none.
};

class SurfelMap {
 public:
  // `options` must be valid.
  explicit SurfelMap(const SurfelMapOptions& options);

  RenderedMap Render(const SphericalImage& image,
                     const Rigid3& map_from_sensor) const;

  // Takes a scan in; scans are counted.
  void Update(const VertexMap& scan, const Rigid3& map_from_sensor);

  const std::vector<Surfel>& surfels() const { return surfels_; }

 private:
  SurfelMapOptions options_;
  std::vector<Surfel> surfels_;
  int num_scans_ = 0;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_SUMA_SURFEL_MAP_H_
