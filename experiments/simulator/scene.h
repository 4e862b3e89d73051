// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The input of a simulated sensor: opaque triangles, each with a reflectance.
//
// Shapes are added in their own frame, `world_from_shape`, with z up. Winding
// order and overlaps do not affect the sensor. Random details are drawn from a
// Random that the caller seeds, so the same seed gives the same scene.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_SCENE_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_SCENE_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "features/base/random.h"
#include "features/base/rigid3.h"

namespace quatro {

inline double Uniform(Random& random, double lower, double upper) {
  return lower + (upper - lower) * random.Uniform();
}

// A random reflectance.
inline float Shade(Random& random, double lower, double upper) {
  return static_cast<float>(Uniform(random, lower, upper));
}

// A translation [m].
inline Rigid3 Shift(double x, double y, double z) {
  return {Eigen::Matrix3d::Identity(), Eigen::Vector3d(x, y, z)};
}

// A rotation about the z axis.
inline Rigid3 Turned(double yaw) {
  return {RotationZ(yaw), Eigen::Vector3d::Zero()};
}

// A place on the ground and a heading.
inline Rigid3 Place(double x, double y, double yaw) {
  return {RotationZ(yaw), Eigen::Vector3d(x, y, 0.0)};
}

// A rectangle of a wall that protrudes or is recessed.
struct WallPatch {
  double left, right, bottom, top;  // [m], in the wall's x and z.
  double offset;                    // [m], outward; negative is a recess.
  float reflectance;
};

struct Scene {
  std::vector<Eigen::Vector3f> vertices;           // [m], in the world frame.
  std::vector<std::array<uint32_t, 3>> triangles;  // Indices into vertices.
  std::vector<float> reflectances;                 // In [0, 1], per triangle.

  void AddTriangle(const Eigen::Vector3d& a,
                   const Eigen::Vector3d& b,
                   const Eigen::Vector3d& c,
                   float reflectance);

  // Corners in order around the quadrilateral.
  void AddQuad(const Eigen::Vector3d& a,
               const Eigen::Vector3d& b,
               const Eigen::Vector3d& c,
               const Eigen::Vector3d& d,
               float reflectance);

  void AddBox(const Rigid3& world_from_box,
              const Eigen::Vector3d& lower,
              const Eigen::Vector3d& upper,
              float reflectance);

  // A convex `outline` in the x-z plane, extruded from y_min to y_max.
  void AddPrism(const Rigid3& world_from_prism,
                const std::vector<Eigen::Vector2d>& outline,
                double y_min,
                double y_max,
                float reflectance);

  // A cylinder about the z axis, closed at both ends.
  void AddCylinder(const Rigid3& world_from_cylinder,
                   double radius,
                   double z_min,
                   double z_max,
                   float reflectance);

  // A wall in the plane y = 0, whose face is toward +y, from left to right and
  // bottom to top [m]. Reveals join the patches to it; if patches overlap, the
  // last one counts.
  void AddWall(const Rigid3& world_from_wall,
               const WallPatch& wall,
               const std::vector<WallPatch>& patches);

  // Leaves: small triangles scattered in the outer shell of an irregular
  // ellipsoid about the frame's origin. `leaf_size` is their side [m].
  void AddFoliage(const Rigid3& world_from_foliage,
                  const Eigen::Vector3d& radii,
                  int num_leaves,
                  double leaf_size,
                  float reflectance,
                  Random& random);

  // Appends a copy of `part`.
  void Append(const Scene& part, const Rigid3& world_from_part);

  // The surface point(u, v) over a grid of parameters.
  void AddSurface(
      const std::vector<double>& us,
      const std::vector<double>& vs,
      const std::function<Eigen::Vector3d(double u, double v)>& point,
      const std::function<float(double u, double v)>& reflectance);
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_SCENE_H_
