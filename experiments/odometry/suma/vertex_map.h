// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A scan as an image: one point a pixel, and the surface's normal there. With
// azimuth a and elevation e of a point (x, y, z) in the sensor's frame,
//
//   u = width  (1/2 - a / 2 pi),          a = atan2(y, x),                 (1)
//   v = height (top - e) / (top - bottom),  e = atan2(z, hypot(x, y)),
//
// it belongs to pixel (floor u, floor v). Of several the nearest is kept.
//
// Normals are those of least spread of the pixels in a window of 5 x 3 whose
// range is like the middle's, turned to the sensor. A difference of two
// neighbors, as in SuMa, would be lost in the noise: pixels are 0.1 m apart at
// 10 m, and ranges 0.02 m off.
//
// Source: Behley and Stachniss, "Efficient Surfel-Based SLAM using 3D Laser
// Range Data in Urban Environments" (SuMa), RSS 2018, Section III.A.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_SUMA_VERTEX_MAP_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_SUMA_VERTEX_MAP_H_

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>

#include "features/base/types.h"

namespace quatro {

// Where a point falls in the image, by (1).
struct SphericalImage {
  int width = 720;
  int height = 64;
  double top = 0.05;      // Elevation of the upper edge [rad].
  double bottom = -0.43;  // Of the lower edge [rad].

  // Pixels.
  Eigen::Index size() const { return Eigen::Index{width} * height; }

  // Of one pixel in azimuth.
  double PixelWidth() const { return 2.0 * M_PI / width; }  // [rad]

  // Of one pixel in elevation.
  double PixelHeight() const { return (top - bottom) / height; }  // [rad]

  // Equation (1). The index v width + u, or -1 outside the image and for the
  // sensor's own place.
  Eigen::Index Project(const Eigen::Vector3d& point) const;

  // Unit vector through the middle of pixel (u, v).
  Eigen::Vector3d Ray(int u, int v) const;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Edges so that the elevations of a scan, but for the outermost thousandth,
// are within the image. Nullopt if all points have one elevation, or there are
// none.
std::optional<SphericalImage> FitImage(const PointsRef& points,
                                       int width,
                                       int height);

// A scan by pixels: points, and normals where they are known.
struct VertexMap {
  SphericalImage image;
  Points vertices;  // By pixel [m]; zero where there is none.
  Points normals;   // Unit, towards the sensor; zero where there is none.

  // Whether anything was seen there.
  bool HasVertex(Eigen::Index pixel) const {
    return !vertices.col(pixel).isZero(0.0);
  }

  // Whether the surface there is known.
  bool HasNormal(Eigen::Index pixel) const {
    return !normals.col(pixel).isZero(0.0);
  }
};

// Of `points` in the sensor's frame; those nearer than `min_range` [m] are left
// out.
VertexMap MakeVertexMap(const PointsRef& points,
                        const SphericalImage& image,
                        double min_range,
                        int num_threads);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_SUMA_VERTEX_MAP_H_
