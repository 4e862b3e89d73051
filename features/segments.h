// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The upright segments of a scan: walls, poles and clusters. The ground is left
// out. Unlike points, segments do not depend on where the rings of the sensor
// cross a surface, so two scans that are far apart share them.
//
// A wall is the set of points p near a vertical plane whose normals are those
// of the plane,
//
//   |n . p - d| <= 2 voxels,  n horizontal, toward the sensor,             (1)
//
// without gaps of more than ten voxels. Planes are found by votes of all
// points for (n, d), the fullest first. What is left is divided into connected
// cells of two voxels in the plane: narrow and tall ones are poles, others of
// at most eight voxels are clusters.

#ifndef QUATRO_FEATURES_SEGMENTS_H_
#define QUATRO_FEATURES_SEGMENTS_H_

#include <Eigen/Core>
#include <vector>

#include "features/base/types.h"

namespace quatro {

// A part of a vertical plane [m]. The tangent is (-n_y, n_x).
struct Wall {
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  // n
  double offset = 0.0;                                // d
  double begin = 0.0;  // The extent along the tangent.
  double end = 0.0;
  double bottom = 0.0;  // The extent in z.
  double top = 0.0;

  // Along the tangent [m].
  double length() const { return end - begin; }

  // In z [m].
  double height() const { return top - bottom; }
};

// Something narrow that stands on the ground [m].
struct Post {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double width = 0.0;
  double bottom = 0.0;
  double top = 0.0;
  bool is_pole = false;  // Otherwise a cluster, such as a car or a bush.

  // In z [m].
  double height() const { return top - bottom; }
};

// All segments of a scan, the walls with the most points first.
struct Segments {
  std::vector<Wall> walls;
  std::vector<Post> posts;
};

// Finds the segments. z is up. Column i of `normals` is a unit vector toward
// the sensor, or zero if unknown; `voxel_size` is the distance between the
// points.
Segments FindSegments(const PointsRef& points,
                      const PointsRef& normals,
                      double voxel_size);

}  // namespace quatro

#endif  // QUATRO_FEATURES_SEGMENTS_H_
