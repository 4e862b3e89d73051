// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A scan as an image, with one point and one surface normal per pixel. With
// azimuth a and elevation e of a point (x, y, z) in the sensor frame,
//
//   u = width  (1/2 - a / 2 pi),          a = atan2(y, x),                 (1)
//   v = height (top - e) / (top - bottom),  e = atan2(z, hypot(x, y)),
//
// the point belongs to pixel (floor u, floor v). If several points fall into a
// pixel, the nearest is kept.
//
// A normal is the direction of smallest spread of the pixels in a 5 x 3 window
// whose range is similar to that of the center pixel, oriented toward the
// sensor. The difference of two neighbors, as in SuMa, would be dominated by
// noise: pixels are 0.1 m apart at 10 m, and the range noise is 0.02 m.
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

// Maps points to pixels by (1).
struct SphericalImage {
  int width = 720;
  int height = 64;
  double top = 0.05;      // Elevation of the upper edge [rad].
  double bottom = -0.43;  // Elevation of the lower edge [rad].

  // The number of pixels.
  Eigen::Index size() const { return Eigen::Index{width} * height; }

  // The azimuth width of a pixel.
  double PixelWidth() const { return 2.0 * M_PI / width; }  // [rad]

  // The elevation height of a pixel.
  double PixelHeight() const { return (top - bottom) / height; }  // [rad]

  // Equation (1). Returns the index v width + u, or -1 outside the image and
  // for a point at the sensor.
  Eigen::Index Project(const Eigen::Vector3d& point) const;

  // The unit vector through the center of pixel (u, v).
  Eigen::Vector3d Ray(int u, int v) const;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Chooses top and bottom so that the image contains the elevations of a scan,
// except for the outermost thousandth. Returns nullopt if all points have one
// elevation, or if there are no points.
std::optional<SphericalImage> FitImage(const PointsRef& points,
                                       int width,
                                       int height);

// A scan by pixels: points, and normals where known.
struct VertexMap {
  SphericalImage image;
  Points vertices;  // Per pixel [m]; zero: no point.
  Points normals;   // Unit, toward the sensor; zero: no normal.

  // Returns whether the pixel has a point.
  bool HasVertex(Eigen::Index pixel) const {
    return !vertices.col(pixel).isZero(0.0);
  }

  // Returns whether the pixel has a normal.
  bool HasNormal(Eigen::Index pixel) const {
    return !normals.col(pixel).isZero(0.0);
  }
};

// `points` are in the sensor frame; points nearer than `min_range` [m] are left
// out.
VertexMap MakeVertexMap(const PointsRef& points,
                        const SphericalImage& image,
                        double min_range,
                        int num_threads);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_SUMA_VERTEX_MAP_H_
