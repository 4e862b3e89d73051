// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/auto_voxel_size.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "features/cells.h"
#include "features/surface_share.h"
#include "features/voxel_count.h"
#include "features/voxel_grid.h"

namespace quatro {
namespace {

constexpr std::size_t kWantedVoxels = 15'000;
constexpr double kTolerance = 0.03;  // Of the number of voxels.
constexpr Eigen::Index kMaxExamined = 500'000;
constexpr Eigen::Index kMaxSpaced = 4 * kWantedVoxels;
constexpr std::size_t kNumSpacings = 1000;
constexpr double kNormalRadius = 3.0;  // In voxels.
constexpr double kWantedSurfaceShare = 2.0 / 3.0;
constexpr double kGrowth = 1.15;
constexpr double kMaxGrowth = 16.0;

// At most kMaxExamined points, evenly over the order of the cloud.
Points Thinned(const Points& points) {
  const Eigen::Index num = points.cols();
  const Eigen::Index step = (num + kMaxExamined - 1) / kMaxExamined;
  return points(Eigen::all, Eigen::seq(0, num - 1, step));
}

// A cloud, and what is found about it.
struct Examined {
  explicit Examined(const Points& all)
      : thinned(all.cols() > kMaxExamined ? Thinned(all) : Points()),
        points(thinned.cols() > 0 ? thinned : all),
        counter(points) {}

  Points thinned;
  const Points& points;
  VoxelCounter counter;
};

bool AreFinite(const Points& points) {
  return points.cols() > 0 && points.allFinite();
}

// Whether distances can be squared.
bool HasLengths(const Examined& cloud) {
  const double width = cloud.counter.width();
  return width < 1.0 / kMinCloudWidth &&
         !(width > 0.0 && width < kMinCloudWidth);
}

// The size at which the cloud has kWantedVoxels, from `size` on, or zero if it
// has fewer at all sizes. Most points are on surfaces, so their number falls
// with about the square of the size.
double SizeForWantedVoxels(const VoxelCounter& counter, double size) {
  constexpr int kMaxSteps = 20;
  constexpr double kFall = 2.0;
  if (counter.num_points() <= kWantedVoxels) return 0.0;
  for (int step = 0; step < kMaxSteps; ++step) {
    if (size < counter.min_voxel_size()) return 0.0;
    const double ratio = counter.Estimate(size) / kWantedVoxels;
    if (std::abs(ratio - 1.0) < kTolerance) return size;
    size *= std::pow(ratio, 1.0 / kFall);
  }
  return size;
}

// The larger of both clouds' sizes for kWantedVoxels.
double SizeForWantedVoxels(const Examined& p, const Examined& q) {
  constexpr double kFirstShare = 1.0 / 300.0;  // Of the width.
  const double first =
      kFirstShare * std::max(p.counter.width(), q.counter.width());
  if (!(first > 0.0)) return 0.0;
  const auto rank = [first](const Examined& cloud) {
    const double smallest = cloud.counter.min_voxel_size();
    return std::tuple(cloud.counter.Estimate(std::max(first, smallest)),
                      cloud.counter.width(),
                      cloud.points.cols());
  };
  const bool p_is_larger = rank(p) >= rank(q);
  const VoxelCounter& larger = (p_is_larger ? p : q).counter;
  const VoxelCounter& smaller = (p_is_larger ? q : p).counter;
  const double size = SizeForWantedVoxels(larger, first);
  const double tried = std::max(size, smaller.min_voxel_size());
  if (smaller.Estimate(tried) <= (1.0 + kTolerance) * kWantedVoxels) {
    return size;
  }
  return std::max(size, SizeForWantedVoxels(smaller, tried));
}

// The median over about kNumSpacings points of the squared distance to the
// nearest other point. Infinity if most have none within `radius`.
double SquaredSpacing(const Points& points, double radius) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const Cells cells = *Cells::Make(points, radius);
  const std::size_t n = cells.order().size();
  const std::size_t step = std::max<std::size_t>(1, n / kNumSpacings);
  Cells::Walk walk(cells);
  std::vector<std::int32_t> near;
  std::vector<double> squared;
  for (std::size_t k = 0; k < n; k += step) {
    const std::int32_t i = cells.order()[k];
    const Eigen::Vector3d point = points.col(i);
    walk.FindNear(*cells.KeyOf(point), &near);
    double least = kNone;
    for (const std::int32_t j : near) {
      if (j == i) continue;
      least = std::min(least, (points.col(j) - point).squaredNorm());
    }
    // A more distant one may not be the nearest.
    squared.push_back(least <= radius * radius ? least : kNone);
  }
  const auto middle =
      squared.begin() + static_cast<std::ptrdiff_t>(squared.size() / 2);
  std::nth_element(squared.begin(), middle, squared.end());
  return *middle;
}

// The larger of `size` and the typical distance of a point from its nearest
// neighbor. If there are many points, most voxels contain several of them, and
// the distance is smaller.
double AtLeastTheSpacing(double size, const Examined& cloud) {
  constexpr double kLeastShare = 1e-3;  // Of the width.
  const Eigen::Index n = cloud.points.cols();
  const double width = cloud.counter.width();
  if (n < 2 || n > kMaxSpaced || width == 0.0) return size;
  double radius = std::max(size, kLeastShare * width);
  double squared = SquaredSpacing(cloud.points, radius);
  while (!std::isfinite(squared)) {
    radius *= 2.0;
    squared = SquaredSpacing(cloud.points, radius);
  }
  return std::max(size, std::sqrt(squared));
}

// One point for each voxel of a size, and of larger ones.
class Sampled {
 public:
  Sampled(const Examined& cloud, double size)
      : points_(cloud.points(Eigen::all, cloud.counter.FirstPoints(size))),
        counter_(points_) {}

  bool ShowsSurfaces(double size) const {
    const Points sampled = points_(Eigen::all, counter_.FirstPoints(size));
    return SurfaceShare(sampled, kNormalRadius * size) >= kWantedSurfaceShare;
  }

 private:
  Points points_;
  VoxelCounter counter_;
};

// Enlarges `size` until most normals of both clouds are those of surfaces, or
// of one of them if there is no such size for the other.
double SizeForSurfaces(const Examined& p, const Examined& q, double size) {
  const Sampled clouds[] = {{p, size}, {q, size}};
  const double largest = kMaxGrowth * size;
  double least[] = {0.0, 0.0};  // Of each cloud alone; zero if there is none.
  for (double larger = size; larger <= largest; larger *= kGrowth) {
    bool all_show = true;
    for (const int k : {0, 1}) {
      const bool shows = clouds[k].ShowsSurfaces(larger);
      if (shows && least[k] == 0.0) least[k] = larger;
      all_show = all_show && shows;
    }
    if (all_show) return larger;
  }
  return std::max({size, least[0], least[1]});
}

}  // namespace

std::optional<double> AutoVoxelSize(const Points& source,
                                    const Points& target) {
  if (!AreFinite(source) || !AreFinite(target)) return std::nullopt;
  const Examined p(source);
  const Examined q(target);
  if (!HasLengths(p) || !HasLengths(q)) return std::nullopt;
  double size = SizeForWantedVoxels(p, q);
  size = std::max(AtLeastTheSpacing(size, p), AtLeastTheSpacing(size, q));
  if (!(size > 0.0)) return std::nullopt;
  // A cloud with a stray point may be too wide for voxels. The front end then
  // says so.
  if (size >= p.counter.min_voxel_size() &&
      size >= q.counter.min_voxel_size()) {
    size = SizeForSurfaces(p, q, size);
  }
  const double unit = std::pow(10.0, std::floor(std::log10(size)) - 1.0);
  return std::round(size / unit) * unit;
}

}  // namespace quatro
