// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/scene.h"

#include <algorithm>
#include <cmath>

namespace quatro {
namespace {

using Eigen::Vector3d;

// Sorts, removes near-duplicates, and clips to [lower, upper].
std::vector<double> Breakpoints(std::vector<double> values,
                                double lower,
                                double upper) {
  constexpr double kMinGap = 1e-3;  // [m]
  for (double& value : values) value = std::clamp(value, lower, upper);
  values.push_back(lower);
  values.push_back(upper);
  std::sort(values.begin(), values.end());
  const auto last =
      std::unique(values.begin(), values.end(), [](double a, double b) {
        return b - a < kMinGap;
      });
  values.erase(last, values.end());
  return values;
}

// Uniform on the unit sphere.
Vector3d DrawDirection(Random& random) {
  const double z = Uniform(random, -1.0, 1.0);
  const double azimuth = Uniform(random, -M_PI, M_PI);
  const double radius = std::sqrt(1.0 - z * z);
  return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
}

}  // namespace

void Scene::AddTriangle(const Vector3d& a,
                        const Vector3d& b,
                        const Vector3d& c,
                        float reflectance) {
  const auto first = static_cast<uint32_t>(vertices.size());
  for (const Vector3d& vertex : {a, b, c}) {
    vertices.emplace_back(vertex.cast<float>());
  }
  triangles.push_back({first, first + 1, first + 2});
  reflectances.push_back(reflectance);
}

void Scene::AddQuad(const Vector3d& a,
                    const Vector3d& b,
                    const Vector3d& c,
                    const Vector3d& d,
                    float reflectance) {
  const auto first = static_cast<uint32_t>(vertices.size());
  for (const Vector3d& vertex : {a, b, c, d}) {
    vertices.emplace_back(vertex.cast<float>());
  }
  triangles.push_back({first, first + 1, first + 2});
  triangles.push_back({first, first + 2, first + 3});
  reflectances.insert(reflectances.end(), 2, reflectance);
}

void Scene::AddBox(const Rigid3& world_from_box,
                   const Vector3d& lower,
                   const Vector3d& upper,
                   float reflectance) {
  AddPrism(world_from_box,
           {{lower.x(), lower.z()},
            {upper.x(), lower.z()},
            {upper.x(), upper.z()},
            {lower.x(), upper.z()}},
           lower.y(),
           upper.y(),
           reflectance);
}

void Scene::AddPrism(const Rigid3& world_from_prism,
                     const std::vector<Eigen::Vector2d>& outline,
                     double y_min,
                     double y_max,
                     float reflectance) {
  const auto corner = [&](size_t i, double y) {
    const Eigen::Vector2d& xz = outline[i % outline.size()];
    return world_from_prism * Vector3d(xz.x(), y, xz.y());
  };
  for (size_t i = 0; i < outline.size(); ++i) {
    AddQuad(corner(i, y_min),
            corner(i + 1, y_min),
            corner(i + 1, y_max),
            corner(i, y_max),
            reflectance);
  }
  for (const double y : {y_min, y_max}) {
    for (size_t i = 1; i + 1 < outline.size(); ++i) {
      AddTriangle(corner(0, y), corner(i, y), corner(i + 1, y), reflectance);
    }
  }
}

void Scene::AddCylinder(const Rigid3& world_from_cylinder,
                        double radius,
                        double z_min,
                        double z_max,
                        float reflectance) {
  constexpr int kNumSides = 12;
  const Rigid3 cylinder_from_prism = {
      Eigen::AngleAxisd(M_PI / 2.0, Vector3d::UnitX()).toRotationMatrix(),
      Vector3d::Zero()};  // Takes the prism's y to z.
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < kNumSides; ++i) {
    const double angle = 2.0 * M_PI * i / kNumSides;
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  AddPrism(world_from_cylinder * cylinder_from_prism,
           outline,
           z_min,
           z_max,
           reflectance);
}

void Scene::AddWall(const Rigid3& world_from_wall,
                    const WallPatch& wall,
                    const std::vector<WallPatch>& patches) {
  std::vector<double> xs, zs;
  for (const WallPatch& patch : patches) {
    xs.insert(xs.end(), {patch.left, patch.right});
    zs.insert(zs.end(), {patch.bottom, patch.top});
  }
  xs = Breakpoints(xs, wall.left, wall.right);
  zs = Breakpoints(zs, wall.bottom, wall.top);

  const auto patch_at = [&](double x, double z) {
    for (auto patch = patches.rbegin(); patch != patches.rend(); ++patch) {
      if (patch->left < x && x < patch->right && patch->bottom < z &&
          z < patch->top) {
        return *patch;
      }
    }
    return wall;
  };
  const auto at = [&](double x, double offset, double z) {
    return world_from_wall * Vector3d(x, offset, z);
  };

  for (size_t i = 0; i + 1 < xs.size(); ++i) {
    for (size_t j = 0; j + 1 < zs.size(); ++j) {
      const double x0 = xs[i], x1 = xs[i + 1], z0 = zs[j], z1 = zs[j + 1];
      const double x = (x0 + x1) / 2.0, z = (z0 + z1) / 2.0;
      const WallPatch here = patch_at(x, z);
      const double y = here.offset;
      AddQuad(at(x0, y, z0),
              at(x1, y, z0),
              at(x1, y, z1),
              at(x0, y, z1),
              here.reflectance);
      // Reveals to the next cells on the right and above.
      if (i + 2 < xs.size()) {
        const double next = patch_at((x1 + xs[i + 2]) / 2.0, z).offset;
        if (next != y) {
          AddQuad(at(x1, y, z0),
                  at(x1, next, z0),
                  at(x1, next, z1),
                  at(x1, y, z1),
                  wall.reflectance);
        }
      }
      if (j + 2 < zs.size()) {
        const double next = patch_at(x, (z1 + zs[j + 2]) / 2.0).offset;
        if (next != y) {
          AddQuad(at(x0, y, z1),
                  at(x1, y, z1),
                  at(x1, next, z1),
                  at(x0, next, z1),
                  wall.reflectance);
        }
      }
    }
  }
}

void Scene::AddFoliage(const Rigid3& world_from_foliage,
                       const Vector3d& radii,
                       int num_leaves,
                       double leaf_size,
                       float reflectance,
                       Random& random) {
  constexpr double kInnermost = 0.65;  // Fraction of the radius.
  constexpr double kLumps = 0.18;
  const double phase = Uniform(random, 0.0, 2.0 * M_PI);
  for (int i = 0; i < num_leaves; ++i) {
    const Vector3d out = DrawDirection(random);
    const double lump =
        1.0 + kLumps * std::sin(3.0 * std::atan2(out.y(), out.x()) + phase) *
                  std::cos(4.0 * out.z() + phase);
    const Vector3d center =
        lump * Uniform(random, kInnermost, 1.0) * radii.cwiseProduct(out);
    const Vector3d normal = DrawDirection(random);
    const Vector3d side = normal.unitOrthogonal() * leaf_size;
    const Vector3d up = normal.cross(side) * Uniform(random, 0.6, 1.2);
    AddTriangle(world_from_foliage * (center - side / 2.0 - up / 3.0),
                world_from_foliage * (center + side / 2.0 - up / 3.0),
                world_from_foliage * (center + up * 2.0 / 3.0),
                reflectance);
  }
}

void Scene::Append(const Scene& part, const Rigid3& world_from_part) {
  const auto first = static_cast<uint32_t>(vertices.size());
  for (const Eigen::Vector3f& vertex : part.vertices) {
    const Vector3d moved = world_from_part * Vector3d(vertex.cast<double>());
    vertices.emplace_back(moved.cast<float>());
  }
  for (const auto& [a, b, c] : part.triangles) {
    triangles.push_back({first + a, first + b, first + c});
  }
  reflectances.insert(
      reflectances.end(), part.reflectances.begin(), part.reflectances.end());
}

void Scene::AddSurface(
    const std::vector<double>& us,
    const std::vector<double>& vs,
    const std::function<Vector3d(double u, double v)>& point,
    const std::function<float(double u, double v)>& reflectance) {
  const auto first = static_cast<uint32_t>(vertices.size());
  const auto num_vs = static_cast<uint32_t>(vs.size());
  for (const double u : us) {
    for (const double v : vs) vertices.emplace_back(point(u, v).cast<float>());
  }
  for (uint32_t i = 0; i + 1 < us.size(); ++i) {
    for (uint32_t j = 0; j + 1 < num_vs; ++j) {
      const uint32_t a = first + i * num_vs + j, b = a + 1;
      const uint32_t d = a + num_vs, c = d + 1;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
      reflectances.insert(
          reflectances.end(),
          2,
          reflectance((us[i] + us[i + 1]) / 2.0, (vs[j] + vs[j + 1]) / 2.0));
    }
  }
}

}  // namespace quatro
