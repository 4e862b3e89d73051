// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/aloam/ring_features.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <sstream>

#include "features/voxel_grid.h"

namespace quatro {
namespace {

constexpr Eigen::Index kHalfWindow = 5;

// Neighbors of a chosen point are skipped up to the first step along the ring
// whose squared length exceeds this [m^2].
constexpr double kCloseSquared = 0.05;

// Collects points of one kind.
class Collector {
 public:
  void Add(const Eigen::Vector3d& point, int ring) {
    coordinates_.insert(coordinates_.end(), point.begin(), point.end());
    ring_.push_back(ring);
  }
  RingPoints Take() {
    return {
        Eigen::Map<const Points>(
            coordinates_.data(), 3, static_cast<Eigen::Index>(ring_.size())),
        std::move(ring_)};
  }

 private:
  std::vector<double> coordinates_;
  std::vector<int> ring_;
};

struct Collectors {
  Collector sharp, less_sharp, flat, less_flat;
};

// The points of a ring that are far enough from the sensor.
Points TakeRing(const PointsRef& points,
                const std::vector<Eigen::Index>& ring,
                double min_range) {
  Points taken(3, static_cast<Eigen::Index>(ring.size()));
  Eigen::Index n = 0;
  for (const Eigen::Index i : ring) {
    if (points.col(i).norm() >= min_range) taken.col(n++) = points.col(i);
  }
  return taken.leftCols(n);
}

double SquaredStep(const Points& p, Eigen::Index i) {
  return (p.col(i + 1) - p.col(i)).squaredNorm();
}

// The points that must not be chosen: those that may be hidden from elsewhere
// and those on surfaces nearly parallel to the beam.
std::vector<bool> FindHidden(const Points& p,
                             const RingFeatureOptions& options) {
  const Eigen::Index n = p.cols();
  std::vector<bool> hidden(static_cast<std::size_t>(n), false);
  const auto hide = [&](Eigen::Index first, Eigen::Index last) {
    for (Eigen::Index i = std::max<Eigen::Index>(0, first);
         i <= std::min(n - 1, last);
         ++i) {
      hidden[static_cast<std::size_t>(i)] = true;
    }
  };
  const double limit = options.max_relative_step * options.max_relative_step;
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    const double here = p.col(i).norm();
    const double next = p.col(i + 1).norm();
    const double nearer = std::min(here, next);
    if (SquaredStep(p, i) > limit * nearer * nearer) {
      if (here - next > options.min_rim) hide(i - kHalfWindow, i);
      if (next - here > options.min_rim) hide(i + 1, i + 1 + kHalfWindow);
    }
    if (i > 0 && SquaredStep(p, i - 1) > limit * here * here &&
        SquaredStep(p, i) > limit * here * here) {
      hide(i, i);
    }
  }
  return hidden;
}

// Equation (1); zero at the ends of the ring, which are never chosen.
std::vector<double> ComputeCurvature(const Points& p) {
  std::vector<double> curvature(static_cast<std::size_t>(p.cols()), 0.0);
  for (Eigen::Index i = kHalfWindow; i + kHalfWindow < p.cols(); ++i) {
    const Eigen::Vector3d sum =
        p.middleCols(i - kHalfWindow, 2 * kHalfWindow + 1).rowwise().sum();
    curvature[static_cast<std::size_t>(i)] =
        (sum - (2.0 * kHalfWindow + 1.0) * p.col(i)).squaredNorm();
  }
  return curvature;
}

// Marks the neighbors of `i` along the ring, up to the first gap.
void MarkNeighbors(const Points& p, Eigen::Index i, std::vector<bool>* taken) {
  (*taken)[static_cast<std::size_t>(i)] = true;
  for (Eigen::Index j = i; j < std::min(p.cols() - 1, i + kHalfWindow); ++j) {
    if (SquaredStep(p, j) > kCloseSquared) break;
    (*taken)[static_cast<std::size_t>(j + 1)] = true;
  }
  for (Eigen::Index j = i; j > std::max<Eigen::Index>(0, i - kHalfWindow);
       --j) {
    if (SquaredStep(p, j - 1) > kCloseSquared) break;
    (*taken)[static_cast<std::size_t>(j - 1)] = true;
  }
}

void ChooseFromRing(const Points& p,
                    int ring,
                    const RingFeatureOptions& options,
                    Collectors* chosen) {
  const Eigen::Index n = p.cols();
  if (n < 2 * kHalfWindow + 1) return;
  const std::vector<double> curvature = ComputeCurvature(p);
  std::vector<bool> taken = FindHidden(p, options);
  std::vector<bool> is_edge(static_cast<std::size_t>(n), false);
  const Eigen::Index inner = n - 2 * kHalfWindow;
  for (Eigen::Index s = 0; s < options.num_sectors; ++s) {
    const Eigen::Index begin = kHalfWindow + inner * s / options.num_sectors;
    const Eigen::Index end =
        kHalfWindow + inner * (s + 1) / options.num_sectors;
    std::vector<Eigen::Index> order(static_cast<std::size_t>(end - begin));
    std::iota(order.begin(), order.end(), begin);
    std::stable_sort(
        order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
          return curvature[static_cast<std::size_t>(a)] <
                 curvature[static_cast<std::size_t>(b)];
        });

    int num_edges = 0;
    for (auto it = order.rbegin(); it != order.rend(); ++it) {
      const auto i = static_cast<std::size_t>(*it);
      if (curvature[i] <= options.edge_curvature ||
          num_edges == options.max_less_sharp) {
        break;
      }
      if (taken[i]) continue;
      ++num_edges;
      is_edge[i] = true;
      if (num_edges <= options.max_sharp) chosen->sharp.Add(p.col(*it), ring);
      chosen->less_sharp.Add(p.col(*it), ring);
      MarkNeighbors(p, *it, &taken);
    }
    int num_flat = 0;
    for (const Eigen::Index at : order) {
      const auto i = static_cast<std::size_t>(at);
      if (curvature[i] >= options.edge_curvature ||
          num_flat == options.max_flat) {
        break;
      }
      if (taken[i]) continue;
      ++num_flat;
      chosen->flat.Add(p.col(at), ring);
      MarkNeighbors(p, at, &taken);
    }
  }

  Points rest(3, inner);
  Eigen::Index num_rest = 0;
  for (Eigen::Index i = kHalfWindow; i < n - kHalfWindow; ++i) {
    if (!is_edge[static_cast<std::size_t>(i)]) rest.col(num_rest++) = p.col(i);
  }
  std::string error;
  const std::optional<Points> sampled =
      SampleVoxels(rest.leftCols(num_rest), options.less_flat_voxel, &error);
  if (!sampled) return;  // The ring is too wide for the voxel grid.
  for (const auto& point : sampled->colwise()) {
    chosen->less_flat.Add(point, ring);
  }
}

}  // namespace

bool RingFeatureOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (num_sectors < 1) {
    problem << "num_sectors = " << num_sectors << ", must be >= 1";
  } else if (max_sharp < 0 || max_less_sharp < max_sharp || max_flat < 0) {
    problem << "max_sharp = " << max_sharp
            << ", max_less_sharp = " << max_less_sharp
            << ", max_flat = " << max_flat
            << ", must be >= 0 and max_sharp <= max_less_sharp";
  } else if (!(edge_curvature > 0.0)) {
    problem << "edge_curvature = " << edge_curvature << ", must be > 0";
  } else if (!(less_flat_voxel > 0.0 && std::isfinite(less_flat_voxel))) {
    problem << "less_flat_voxel = " << less_flat_voxel
            << ", must be > 0 and finite";
  } else if (!(min_range >= 0.0)) {
    problem << "min_range = " << min_range << ", must be >= 0";
  } else if (!(max_relative_step > 0.0 && min_rim > 0.0)) {
    problem << "max_relative_step = " << max_relative_step
            << ", min_rim = " << min_rim << ", must be > 0";
  }
  *error = problem.str();
  return error->empty();
}

RingFeatures FindRingFeatures(const PointsRef& points,
                              const ScanRings& rings,
                              const RingFeatureOptions& options) {
  Collectors chosen;
  for (std::size_t r = 0; r < rings.rings.size(); ++r) {
    ChooseFromRing(TakeRing(points, rings.rings[r], options.min_range),
                   static_cast<int>(r),
                   options,
                   &chosen);
  }
  return {chosen.sharp.Take(),
          chosen.less_sharp.Take(),
          chosen.flat.Take(),
          chosen.less_flat.Take()};
}

}  // namespace quatro
