// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Odometry similar to A-LOAM. Extracts edges and planes of each scan
// (ring_features.h) and aligns them by line_plane_alignment.h
//
//   1. to the previous scan, starting from the constant-velocity guess,
//   2. to the map of all previous scans, starting from the result of 1.
//
// Both steps find new matches num_rounds times; step 1 stops earlier if the
// pose no longer moves. Before there is a velocity, the second scan may be
// meters ahead, so step 1 then has start_rounds. The map keeps one point per
// voxel and feature kind around the sensor.
//
// Differences from A-LOAM: step 2 runs for every scan, and its pose feeds the
// next guess. The map is one grid around the sensor instead of cubes of 50 m.
// Hidden points are rejected (LOAM's rule, which A-LOAM omits). A pose that the
// matches do not constrain is rejected. A-LOAM uses two rounds for the second
// scan, too. Scans are not corrected for motion.
//
// A scan whose rings cannot be identified is lost.
//
// Source: Zhang and Singh, "LOAM: Lidar Odometry and Mapping in Real-time", RSS
// 2014.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_ALOAM_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_ALOAM_H_

#include <optional>
#include <string>

#include "experiments/odometry/aloam/line_plane_alignment.h"
#include "experiments/odometry/aloam/ring_features.h"
#include "experiments/odometry/aloam/scan_to_scan.h"
#include "experiments/odometry/aloam/voxel_map.h"
#include "experiments/odometry/odometry.h"

namespace quatro {

struct AloamOptions {
  RingFeatureOptions features;
  LinePlaneOptions alignment;
  int num_rounds = 2;
  int start_rounds = 100;

  double max_scan_distance = 5.0;  // Match to the previous scan [m].
  double max_map_distance = 1.0;   // Fifth neighbor in the map [m].
  double edge_voxel = 0.4;         // Voxel of the map [m].
  double plane_voxel = 0.8;        // [m]
  double map_radius = 100.0;       // [m]

  int num_threads = 1;  // 0: all cores. Does not affect the result.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

class Aloam : public Odometry {
 public:
  // `options` must be valid.
  explicit Aloam(const AloamOptions& options);

 private:
  TrackResult Start(const PointCloud& scan) override;
  TrackResult Track(const PointCloud& scan,
                    const Rigid3& world_from_scan_guess) override;

  // Returns nullopt, with the reason in *message, if there are too few edge or
  // plane features.
  std::optional<RingFeatures> FindFeatures(const PointCloud& scan,
                                           std::string* message) const;
  LinePlaneSummary AlignToScan(const RingFeatures& features,
                               const Rigid3& world_from_scan) const;
  LinePlaneSummary AlignToMap(const Points& edges,
                              const Points& planes,
                              const Rigid3& world_from_scan) const;
  void Learn(const RingFeatures& features, const Rigid3& world_from_scan);

  AloamOptions options_;
  std::optional<ScanModel> last_;
  Rigid3 world_from_last_;
  bool has_velocity_ = false;
  VoxelMap edge_map_, plane_map_;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_ALOAM_H_
