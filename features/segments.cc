// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/segments.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>

namespace quatro {
namespace {

// Lengths in voxels.
constexpr double kWallThickness = 2.0;  // To either side of the plane.
constexpr double kMaxGap = 10.0;
constexpr double kMinWallLength = 10.0;
constexpr double kMinWallHeight = 5.0;
constexpr double kCell = 2.0;
constexpr double kMaxPoleWidth = 4.0;
constexpr double kMaxClusterWidth = 8.0;
constexpr double kMinPostHeight = 4.0;

constexpr double kMaxWallNormalZ = 0.3;
constexpr double kMinWallCosine = 0.966;         // 15 deg
constexpr double kMaxStructureNormalZ = 0.7071;  // 45 deg
constexpr int kNumAzimuths = 72;
constexpr int kMinWallPoints = 30;
constexpr int kMinPostPoints = 8;
constexpr std::size_t kMaxNumWalls = 40;
constexpr std::size_t kMaxNumPosts = 80;

// A pair of small integers as one key.
std::int64_t Key(std::int64_t a, std::int64_t b) {
  return (a << 32) + (b & 0xffffffff);
}

std::int64_t Floor(double value) {
  return static_cast<std::int64_t>(std::floor(value));
}

// The horizontal direction of an azimuth bin.
Eigen::Vector2d Direction(int azimuth) {
  const double angle = 2.0 * M_PI * azimuth / kNumAzimuths;
  return {std::cos(angle), std::sin(angle)};
}

Eigen::Vector2d Tangent(const Eigen::Vector2d& normal) {
  return {-normal.y(), normal.x()};
}

// Finds walls among the points of a cloud, and remembers which points are used.
class WallFinder {
 public:
  WallFinder(const PointsRef& points,
             const PointsRef& normals,
             double voxel_size)
      : points_(points),
        normals_(normals),
        voxel_(voxel_size),
        is_used_(static_cast<std::size_t>(points.cols()), false) {
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const Eigen::Vector3d normal = normals.col(i);
      if (normal.isZero(0.0) || std::abs(normal.z()) > kMaxWallNormalZ) {
        continue;
      }
      upright_.push_back(i);
    }
  }

  std::vector<Wall> Find() {
    std::vector<Wall> walls;
    for (const Bin& bin : FillBins()) {
      if (walls.size() >= kMaxNumWalls) break;
      const auto num_unused = std::count_if(
          bin.points.begin(), bin.points.end(), [&](Eigen::Index i) {
            return !IsUsed(i);
          });
      if (num_unused < kMinWallPoints) continue;
      AddWalls(Direction(bin.azimuth), bin.offset, &walls);
    }
    return walls;
  }

  bool IsUsed(Eigen::Index i) const {
    return is_used_[static_cast<std::size_t>(i)];
  }

 private:
  // The points with about the same n and d.
  struct Bin {
    int azimuth = 0;
    double offset = 0.0;  // The middle.
    std::vector<Eigen::Index> points;
  };

  // The bins that may contain a wall, the fullest first.
  std::vector<Bin> FillBins() const {
    std::unordered_map<std::int64_t, Bin> by_key;
    const double width = kWallThickness * voxel_;
    for (const Eigen::Index i : upright_) {
      const Eigen::Vector2d n = normals_.col(i).head<2>();
      const Eigen::Vector2d p = points_.col(i).head<2>();
      const double turns = std::atan2(n.y(), n.x()) / (2.0 * M_PI);
      const auto azimuth = static_cast<int>(std::lround(turns * kNumAzimuths));
      for (const int turn : {-1, 0, 1}) {
        const int other = (azimuth + turn + 2 * kNumAzimuths) % kNumAzimuths;
        const std::int64_t step = Floor(Direction(other).dot(p) / width);
        Bin& bin = by_key[Key(other, step)];
        bin.azimuth = other;
        bin.offset = (static_cast<double>(step) + 0.5) * width;
        bin.points.push_back(i);
      }
    }
    std::vector<Bin> bins;
    for (auto& [key, bin] : by_key) {
      if (bin.points.size() >= static_cast<std::size_t>(kMinWallPoints)) {
        bins.push_back(std::move(bin));
      }
    }
    std::sort(bins.begin(), bins.end(), [](const Bin& a, const Bin& b) {
      if (a.points.size() != b.points.size()) {
        return a.points.size() > b.points.size();
      }
      return a.azimuth != b.azimuth ? a.azimuth < b.azimuth
                                    : a.offset < b.offset;
    });
    return bins;
  }

  // Points by their coordinate along the tangent.
  using Part = std::vector<std::pair<double, Eigen::Index>>;

  // Unused points that satisfy (1).
  Part Collect(const Eigen::Vector2d& normal, double offset) const {
    Part found;
    const Eigen::Vector2d tangent = Tangent(normal);
    for (const Eigen::Index i : upright_) {
      const Eigen::Vector2d p = points_.col(i).head<2>();
      if (is_used_[static_cast<std::size_t>(i)] ||
          std::abs(normal.dot(p) - offset) > kWallThickness * voxel_ ||
          normal.dot(normals_.col(i).head<2>()) < kMinWallCosine) {
        continue;
      }
      found.emplace_back(tangent.dot(p), i);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  // Adds the parts of a plane that are long and tall enough. A part is fitted,
  // and its points are collected again near the fit, because the direction of a
  // bin is coarse.
  void AddWalls(const Eigen::Vector2d& normal,
                double offset,
                std::vector<Wall>* walls) {
    for (const Part& coarse : PartsNear(normal, offset)) {
      const Wall fit = Fit(coarse, normal);
      for (const Part& part : PartsNear(fit.normal, fit.offset)) {
        const Wall wall = Fit(part, normal);
        if (wall.length() < kMinWallLength * voxel_ ||
            wall.height() < kMinWallHeight * voxel_) {
          continue;
        }
        for (const auto& [along, i] : part) {
          is_used_[static_cast<std::size_t>(i)] = true;
        }
        walls->push_back(wall);
      }
    }
  }

  // The points of a plane, divided at gaps, without those that are too few.
  std::vector<Part> PartsNear(const Eigen::Vector2d& normal,
                              double offset) const {
    std::vector<Part> parts;
    const Part found = Collect(normal, offset);
    std::ptrdiff_t begin = 0;
    for (std::size_t k = 1; k <= found.size(); ++k) {
      if (k < found.size() &&
          found[k].first - found[k - 1].first <= kMaxGap * voxel_) {
        continue;
      }
      const auto end = static_cast<std::ptrdiff_t>(k);
      if (end - begin >= kMinWallPoints) {
        parts.emplace_back(found.begin() + begin, found.begin() + end);
      }
      begin = end;
    }
    return parts;
  }

  // The line of least squares in the plane, and its extents.
  Wall Fit(const Part& part, const Eigen::Vector2d& direction) const {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const auto& [along, i] : part) {
      mean += points_.col(i).head<2>();
    }
    mean /= static_cast<double>(part.size());
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
    std::vector<double> heights;
    for (const auto& [along, i] : part) {
      const Eigen::Vector2d d = points_.col(i).head<2>() - mean;
      scatter += d * d.transpose();
      heights.push_back(points_(2, i));
    }
    std::sort(heights.begin(), heights.end());
    Wall wall;
    wall.normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(scatter)
                      .eigenvectors()
                      .col(0);
    if (wall.normal.dot(direction) < 0.0) wall.normal = -wall.normal;
    wall.offset = wall.normal.dot(mean);
    const Eigen::Vector2d tangent = Tangent(wall.normal);
    wall.begin = tangent.dot(points_.col(part.front().second).head<2>());
    wall.end = tangent.dot(points_.col(part.back().second).head<2>());
    wall.bottom = heights[heights.size() / 20];
    wall.top = heights[heights.size() - 1 - heights.size() / 20];
    return wall;
  }

  const PointsRef& points_;
  const PointsRef& normals_;
  double voxel_;
  std::vector<bool> is_used_;
  std::vector<Eigen::Index> upright_;  // Points that may be on a wall.
};

// The post of connected points, unless they are too few, too wide or too low.
std::optional<Post> PostOf(const PointsRef& points,
                           const std::vector<Eigen::Index>& columns,
                           double voxel_size) {
  if (columns.size() < static_cast<std::size_t>(kMinPostPoints)) {
    return std::nullopt;
  }
  Eigen::Vector3d low = points.col(columns.front());
  Eigen::Vector3d high = low;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Index i : columns) {
    low = low.cwiseMin(points.col(i));
    high = high.cwiseMax(points.col(i));
    sum += points.col(i).head<2>();
  }
  Post post;
  post.center = sum / static_cast<double>(columns.size());
  post.width = (high - low).head<2>().maxCoeff();
  post.bottom = low.z();
  post.top = high.z();
  if (post.width > kMaxClusterWidth * voxel_size ||
      post.height() < kMinPostHeight * voxel_size) {
    return std::nullopt;
  }
  post.is_pole =
      post.width <= kMaxPoleWidth * voxel_size && post.height() >= post.width;
  return post;
}

// The posts of the structure that is on no wall.
std::vector<Post> FindPosts(const PointsRef& points,
                            const PointsRef& normals,
                            const WallFinder& walls,
                            double voxel_size) {
  std::unordered_map<std::int64_t, std::vector<Eigen::Index>> cells;
  const double width = kCell * voxel_size;
  const auto key_of = [&](const Eigen::Vector3d& p, int dx, int dy) {
    return Key(Floor(p.x() / width) + dx, Floor(p.y() / width) + dy);
  };
  std::vector<Eigen::Index> seeds;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d normal = normals.col(i);
    if (walls.IsUsed(i) || normal.isZero(0.0) ||
        std::abs(normal.z()) > kMaxStructureNormalZ) {
      continue;
    }
    cells[key_of(points.col(i), 0, 0)].push_back(i);
    seeds.push_back(i);
  }
  // Removes and returns the points in cells connected to that of the seed.
  const auto take_connected = [&](Eigen::Index seed) {
    std::vector<Eigen::Index> connected;
    const auto take = [&](std::int64_t key) {
      const auto cell = cells.find(key);
      if (cell == cells.end()) return;
      connected.insert(
          connected.end(), cell->second.begin(), cell->second.end());
      cells.erase(cell);
    };
    take(key_of(points.col(seed), 0, 0));
    for (std::size_t k = 0; k < connected.size(); ++k) {
      const Eigen::Vector3d p = points.col(connected[k]);
      for (const int dx : {-1, 0, 1}) {
        for (const int dy : {-1, 0, 1}) take(key_of(p, dx, dy));
      }
    }
    return connected;
  };
  std::vector<Post> posts;
  for (const Eigen::Index seed : seeds) {
    const std::vector<Eigen::Index> connected = take_connected(seed);
    if (const auto post = PostOf(points, connected, voxel_size)) {
      posts.push_back(*post);
    }
  }
  std::stable_sort(
      posts.begin(), posts.end(), [](const Post& a, const Post& b) {
        return a.height() > b.height();
      });
  posts.resize(std::min(posts.size(), kMaxNumPosts));
  return posts;
}

}  // namespace

Segments FindSegments(const PointsRef& points,
                      const PointsRef& normals,
                      double voxel_size) {
  WallFinder finder(points, normals, voxel_size);
  Segments segments;
  segments.walls = finder.Find();
  segments.posts = FindPosts(points, normals, finder, voxel_size);
  return segments;
}

}  // namespace quatro
