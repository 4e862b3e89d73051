// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/suma/vertex_map.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstddef>
#include <sstream>
#include <vector>

#include "features/base/parallel.h"

namespace quatro {
namespace {

constexpr int kHalfWidth = 2;
constexpr int kHalfHeight = 1;
constexpr int kMinNeighbors = 6;

// Neighbors whose ranges differ by more belong to another surface [m, m/m].
constexpr double kMaxStep = 0.2;
constexpr double kMaxRelativeStep = 0.1;

// A window is a line if its spread across is less than this fraction of its
// spread along.
constexpr double kMinSpread = 1e-3;

// Returns the normal at (u, v), or zero.
Eigen::Vector3d NormalAt(const VertexMap& map, int u, int v) {
  const SphericalImage& image = map.image;
  const Eigen::Vector3d middle =
      map.vertices.col(Eigen::Index{v} * image.width + u);
  const double range = middle.norm();
  const double max_step = kMaxStep + kMaxRelativeStep * range;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  int num_neighbors = 0;
  for (int row = std::max(0, v - kHalfHeight);
       row <= std::min(image.height - 1, v + kHalfHeight);
       ++row) {
    for (int i = -kHalfWidth; i <= kHalfWidth; ++i) {
      const int column = (u + i + image.width) % image.width;
      const Eigen::Index pixel = Eigen::Index{row} * image.width + column;
      if (!map.HasVertex(pixel)) continue;
      const Eigen::Vector3d p = map.vertices.col(pixel);
      if (std::abs(p.norm() - range) > max_step) continue;
      const Eigen::Vector3d offset = p - middle;
      sum += offset;
      squares += offset * offset.transpose();
      ++num_neighbors;
    }
  }
  if (num_neighbors < kMinNeighbors) return Eigen::Vector3d::Zero();
  const double n = num_neighbors;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(squares / n - sum * sum.transpose() / (n * n));
  const Eigen::Vector3d& values = solver.eigenvalues();
  if (!(values[1] > kMinSpread * values[2])) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d normal = solver.eigenvectors().col(0).normalized();
  return normal.dot(middle) > 0.0 ? -normal : normal;
}

}  // namespace

Eigen::Index SphericalImage::Project(const Eigen::Vector3d& point) const {
  const double planar = std::hypot(point.x(), point.y());
  if (!(planar > 0.0)) return -1;
  const double azimuth = std::atan2(point.y(), point.x());
  const double elevation = std::atan2(point.z(), planar);
  // The left and right edges of the image both point backward.
  const int u = std::clamp(
      static_cast<int>(width * (0.5 - azimuth / (2.0 * M_PI))), 0, width - 1);
  const double row = std::floor(height * (top - elevation) / (top - bottom));
  if (!(row >= 0.0 && row < height)) return -1;
  return static_cast<Eigen::Index>(row) * width + u;
}

Eigen::Vector3d SphericalImage::Ray(int u, int v) const {
  const double azimuth = M_PI - (u + 0.5) * PixelWidth();
  const double elevation = top - (v + 0.5) * PixelHeight();
  return {std::cos(elevation) * std::cos(azimuth),
          std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

bool SphericalImage::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (width < 16 || width > 8192 || height < 4 || height > 1024) {
    problem << "width, height = " << width << ", " << height
            << ", must be in [16, 8192], [4, 1024]";
  } else if (!(top > bottom && top <= 0.5 * M_PI && bottom >= -0.5 * M_PI)) {
    problem << "top, bottom = " << top << ", " << bottom
            << ", must be in [-pi/2, pi/2] and top > bottom";
  }
  *error = problem.str();
  return error->empty();
}

std::optional<SphericalImage> FitImage(const PointsRef& points,
                                       int width,
                                       int height) {
  std::vector<double> elevations;
  for (const auto& point : points.colwise()) {
    const double planar = std::hypot(point.x(), point.y());
    if (planar > 0.0) elevations.push_back(std::atan2(point.z(), planar));
  }
  if (elevations.empty()) return std::nullopt;
  std::sort(elevations.begin(), elevations.end());
  const std::size_t outermost = elevations.size() / 1000;
  const double bottom = elevations[outermost];
  const double top = elevations[elevations.size() - 1 - outermost];
  if (!(top > bottom)) return std::nullopt;
  SphericalImage image;
  image.width = width;
  image.height = height;
  // The outermost beams are at the centers of their rows.
  const double half_row = 0.5 * (top - bottom) / (height - 1);
  image.top = std::min(0.5 * M_PI, top + half_row);
  image.bottom = std::max(-0.5 * M_PI, bottom - half_row);
  return image;
}

VertexMap MakeVertexMap(const PointsRef& points,
                        const SphericalImage& image,
                        double min_range,
                        int num_threads) {
  VertexMap map{
      image, Points::Zero(3, image.size()), Points::Zero(3, image.size())};
  for (const auto& point : points.colwise()) {
    const Eigen::Index pixel = image.Project(point);
    if (pixel < 0 || point.norm() < min_range) continue;
    if (!map.HasVertex(pixel) ||
        point.squaredNorm() < map.vertices.col(pixel).squaredNorm()) {
      map.vertices.col(pixel) = point;
    }
  }
  ParallelFor(
      num_threads, image.height, 1, [&](Eigen::Index begin, Eigen::Index end) {
        for (auto v = static_cast<int>(begin); v < end; ++v) {
          for (int u = 0; u < image.width; ++u) {
            const Eigen::Index pixel = Eigen::Index{v} * image.width + u;
            if (map.HasVertex(pixel)) {
              map.normals.col(pixel) = NormalAt(map, u, v);
            }
          }
        }
      });
  return map;
}

}  // namespace quatro
