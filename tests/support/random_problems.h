// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Random things for tests. Each is a function of its arguments alone, the seed
// among them, on every machine: a test names its seed and can be replayed.

#ifndef QUATRO_TESTS_SUPPORT_RANDOM_PROBLEMS_H_
#define QUATRO_TESTS_SUPPORT_RANDOM_PROBLEMS_H_

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "features/base/random.h"
#include "features/base/types.h"

namespace quatro {

// Normally distributed, of mean 0 and standard deviation 1 (Box and Muller).
inline double RandomNormal(Random& random) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - random.Uniform()));
  return radius * std::cos(2.0 * M_PI * random.Uniform());
}

// Normally distributed about the origin, `sigma` [m] on each axis.
inline Points RandomPoints(Eigen::Index n, double sigma, std::uint64_t seed) {
  Random random(seed);
  return Points::NullaryExpr(
      3, n, [&] { return sigma * RandomNormal(random); });
}

// Uniform over all directions.
inline Eigen::Vector3d RandomDirection(std::uint64_t seed) {
  return RandomPoints(1, 1.0, seed).col(0).normalized();
}

// Uniform over all rotations.
inline Eigen::Matrix3d RandomRotation(std::uint64_t seed) {
  Random random(seed);
  Eigen::Quaterniond q;
  for (double& x : q.coeffs()) x = RandomNormal(random);
  return q.normalized().toRotationMatrix();
}

// 0 .. n - 1 in random order.
inline std::vector<Eigen::Index> RandomPermutation(Eigen::Index n,
                                                   std::uint64_t seed) {
  Random random(seed);
  std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[random.Below(i)]);
  }
  return order;
}

// Points of a surface, and the surface's unit normal at each.
struct Surface {
  Points points;
  Points normals;
};

// A square of side `width` [m] in the plane z = 0, its normals upwards.
inline Surface RandomPlane(Eigen::Index n, double width, std::uint64_t seed) {
  Random random(seed);
  Surface plane{Points::Zero(3, n), Points::Zero(3, n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    plane.points(0, i) = width * (random.Uniform() - 0.5);
    plane.points(1, i) = width * (random.Uniform() - 0.5);
    plane.normals(2, i) = 1.0;
  }
  return plane;
}

// About the z axis from z = 0 up to `height` [m], its normals outwards.
inline Surface RandomCylinder(Eigen::Index n,
                              double radius,
                              double height,
                              std::uint64_t seed) {
  Random random(seed);
  Surface cylinder{Points::Zero(3, n), Points::Zero(3, n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double angle = 2.0 * M_PI * random.Uniform();
    cylinder.normals.col(i) << std::cos(angle), std::sin(angle), 0.0;
    cylinder.points.col(i) = radius * cylinder.normals.col(i);
    cylinder.points(2, i) = height * random.Uniform();
  }
  return cylinder;
}

// About the origin, its normals outwards.
inline Surface RandomSphere(Eigen::Index n, double radius, std::uint64_t seed) {
  Surface sphere;
  sphere.normals = RandomPoints(n, 1.0, seed).colwise().normalized();
  sphere.points = radius * sphere.normals;
  return sphere;
}

// A street corner 16 m wide as seen from the origin: the ground 2 m below (half
// of the points), two walls (a fifth each) and four poles of different widths,
// mixed, with normal noise of `sigma` [m].
inline Points RandomStreet(Eigen::Index n, double sigma, std::uint64_t seed) {
  const double poles[4][3] = {// x, y, radius [m]
                              {-4.0, -5.0, 0.2},
                              {-1.0, 4.0, 0.3},
                              {2.5, -3.0, 0.4},
                              {5.0, 5.5, 0.5}};
  Random random(seed);
  Points street(3, n);
  for (auto point : street.colwise()) {
    const double part = random.Uniform();
    const double u = random.Uniform();
    const double v = random.Uniform();
    const double across = 16.0 * u - 8.0;
    if (part < 0.5) {
      point << across, 16.0 * v - 8.0, -2.0;
    } else if (part < 0.7) {
      point << across, 8.0, 6.0 * v - 2.0;
    } else if (part < 0.9) {
      point << -8.0, across, 6.0 * v - 2.0;
    } else {
      const auto& [x, y, radius] = poles[random.Below(4)];
      point << x + radius * std::cos(2.0 * M_PI * u),
          y + radius * std::sin(2.0 * M_PI * u), 4.0 * v - 2.0;
    }
    for (double& coordinate : point) coordinate += sigma * RandomNormal(random);
  }
  return street;
}

}  // namespace quatro

#endif  // QUATRO_TESTS_SUPPORT_RANDOM_PROBLEMS_H_
