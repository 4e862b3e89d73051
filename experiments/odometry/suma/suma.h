// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Odometry like SuMa's, without its closing of loops: the scan as an image
// (experiments/odometry/suma/vertex_map.h) onto what the map of surfels
// (surfel_map.h) would look like from the guess, by
// experiments/odometry/suma/projective_icp.h; then the scan is taken into the
// map.
//
// Where there is no velocity yet the second scan may be metres ahead of the
// guess: partners are then sought start_distance away, and start_rounds times
// the map is drawn anew from where the last round ended, the distance falling
// evenly to that of icp.
//
// The image's rows span the elevations of the first scan: no beam need be
// known.
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
  int width = 720;  // Of the image [pixels].
  int height = 64;
  double min_range = 3.0;  // Nearer points are the car's own [m].
  ProjectiveIcpOptions icp;
  int start_rounds = 20;
  double start_distance = 6.0;  // [m]
  SurfelMapOptions map;

  int num_threads = 1;  // 0: all cores. Never changes the answer.

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
