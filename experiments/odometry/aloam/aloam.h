// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Odometry like A-LOAM's: edges and planes of each scan (features/
// ring_features.h), aligned by
// experiments/odometry/aloam/line_plane_alignment.h
//
//   1. to the scan before it, from the guess of constant velocity,
//   2. to the map of all before it, from 1,
//
// each time with matches found anew num_rounds times, or until nothing moves.
// Where there is no velocity yet the second scan may be metres ahead: step 1
// then has start_rounds. The map keeps one point a voxel of either kind around
// the sensor.
//
// Unlike A-LOAM, step 2 is done for every scan and its pose feeds the next
// guess; the map is one grid around the sensor in place of cubes of 50 m;
// hidden points are rejected (LOAM's rule, which A-LOAM leaves out); a pose
// that the matches do not hold is refused; A-LOAM starts with two rounds as
// well. Scans are not corrected for motion.
//
// A scan whose rings can't be told is lost.
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

  double max_scan_distance = 5.0;  // Of matches to the scan before [m].
  double max_map_distance = 1.0;   // And of the fifth neighbor in the map [m].
  double edge_voxel = 0.4;         // Of the map [m].
  double plane_voxel = 0.8;        // [m]
  double map_radius = 100.0;       // [m]

  int num_threads = 1;  // 0: all cores. Never changes the answer.

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

  // Nullopt, with the reason in *message, if there are too few of either kind.
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
