// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Odometry similar to SuMa, without loop closure. Each scan, as an image
// (experiments/odometry/suma/vertex_map.h), is aligned by
// experiments/odometry/suma/projective_icp.h with the surfel map (surfel_map.h)
// rendered from the guess. The scan is then added to the map.
//
// Before there is a velocity, the second scan may be meters ahead of the guess.
// Matches are then searched within start_distance, and the map is rendered
// again start_rounds times from the last pose, while the distance decreases
// linearly to that of icp.
//
// The rows of the image span the elevations of the first scan, so the beams
// need not be known.
//
// Source: Behley and Stachniss, "Efficient Surfel-Based SLAM using 3D Laser
// Range Data in Urban Environments", RSS 2018.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_SUMA_SUMA_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_SUMA_SUMA_H_

#include <string>

#include "experiments/odometry/odometry.h"
#include "experiments/odometry/suma/projective_icp.h"
#include "experiments/odometry/suma/surfel_map.h"
#include "experiments/odometry/suma/vertex_map.h"

namespace quatro {

struct SumaOptions {
  int width = 720;  // Image size [pixels].
  int height = 64;
  double min_range = 3.0;  // Nearer points are the vehicle's own [m].
  ProjectiveIcpOptions icp;
  int start_rounds = 20;
  double start_distance = 6.0;  // [m]
  SurfelMapOptions map;

  int num_threads = 1;  // 0: all cores. Does not affect the result.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

class Suma : public Odometry {
 public:
  // `options` must be valid.
  explicit Suma(const SumaOptions& options);

 private:
  TrackResult Start(const PointCloud& scan) override;
  TrackResult Track(const PointCloud& scan,
                    const Rigid3& world_from_scan_guess) override;

  // The pose in the frame of the guess.
  ProjectiveIcpSummary AlignToMap(const VertexMap& vertices,
                                  const Rigid3& world_from_scan_guess,
                                  double max_distance) const;

  SumaOptions options_;
  bool has_velocity_ = false;
  SphericalImage image_;
  SurfelMap map_;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_SUMA_SUMA_H_
