// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/presets.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "features/kd_tree.h"
#include "features/surface_share.h"
#include "features/voxel_grid.h"

namespace quatro {
namespace {

constexpr Eigen::Index kWantedVoxels = 15000;
constexpr Eigen::Index kNumSamples = 1000;
// Lengths are found on so many points; they hardly depend on more.
constexpr Eigen::Index kMaxExamined = 500'000;
constexpr double kWantedSurfaceShare = 2.0 / 3.0;
constexpr double kGrowth = 1.15;
constexpr double kMaxGrowth = 16.0;

RegistrationOptions InProportionTo(double voxel_size) {
  RegistrationOptions options =
      ScaledBy(voxel_size / RegistrationOptions().front_end.voxel_size,
               RegistrationOptions());
  options.front_end.voxel_size = voxel_size;
  options.front_end.normal_radius = 3.0 * voxel_size;
  options.front_end.fpfh_radius = 5.0 * voxel_size;
  options.noise_bound = voxel_size;
  return options;
}

// Without what the paper and its code do not have.
RegistrationOptions WithoutExtensions() {
  RegistrationOptions options;
  options.front_end.voxel_size = 0.3;
  options.front_end.normal_radius = 0.5;
  options.quatro.replace_missed_optimum = false;
  options.quatro.recover_translation = false;
  options.quatro.polish = false;
  options.search.max_rung = 0;
  return options;
}

RegistrationOptions MakePaper() {
  RegistrationOptions options = WithoutExtensions();
  options.front_end.fpfh_radius = 0.65;
  options.noise_bound = 0.15;
  options.quatro.tim_bound_factor = 1.0;
  options.quatro.gnc.start = GncStart::kIdentity;
  return options;
}

RegistrationOptions MakeReference() {
  RegistrationOptions options = WithoutExtensions();
  options.front_end.fpfh_radius = 0.75;
  options.noise_bound = 0.3;
  options.quatro.tim_bound_factor = 2.0;
  options.quatro.gnc.start = GncStart::kPlainFit;
  return options;
}

// At most kMaxExamined points, evenly over the order of the cloud.
PointCloud Thinned(const PointCloud& cloud) {
  const Eigen::Index num = cloud.points.cols();
  const Eigen::Index step = (num + kMaxExamined - 1) / kMaxExamined;
  PointCloud thinned;
  thinned.points = cloud.points(
      Eigen::all, Eigen::seq(0, num - 1, std::max<Eigen::Index>(1, step)));
  return thinned;
}

Eigen::Index CountVoxels(const PointCloud& cloud, double voxel_size) {
  std::string error;
  const auto voxels = SampleVoxels(cloud.points, voxel_size, &error);
  return voxels ? voxels->cols() : cloud.points.cols();
}

// The size at which the cloud keeps kWantedVoxels, by bisection in the
// logarithm. A cloud with fewer points than that gives a size far below their
// spacing.
double SizeForWantedVoxels(const PointCloud& cloud) {
  constexpr double kUsualMin = 0.01;  // [m]
  constexpr double kUsualMax = 10.0;  // [m]
  constexpr double kMinShare = 1e-4;  // Share of the extent of a smaller cloud.
  double low = std::log(kUsualMin);
  double high = std::log(kUsualMax);
  const double extent =
      (cloud.points.rowwise().maxCoeff() - cloud.points.rowwise().minCoeff())
          .maxCoeff();
  if (kMinShare * extent < kUsualMin && extent > 0.0 &&
      CountVoxels(cloud, kUsualMin) <= kWantedVoxels) {
    low = std::log(kMinShare * extent);
    high = std::log(kUsualMin);
  }
  const auto bisect = [&] {
    for (int i = 0; i < 8; ++i) {
      const double middle = 0.5 * (low + high);
      (CountVoxels(cloud, std::exp(middle)) > kWantedVoxels ? low : high) =
          middle;
    }
  };
  bisect();
  if (std::exp(high) >= kUsualMax && extent > kUsualMax) {
    low = std::log(kUsualMax);
    high = std::log(extent);
    bisect();
  }
  return std::exp(high);
}

// Median distance of a point from its nearest neighbour elsewhere [m].
double TypicalSpacing(const PointCloud& cloud) {
  const KdTree tree(cloud.points);
  const Eigen::Index n = cloud.points.cols();
  const Eigen::Index step = std::max<Eigen::Index>(1, n / kNumSamples);
  std::vector<double> squared;
  for (Eigen::Index i = 0; i < n; i += step) {
    const auto nearest = tree.Nearest(cloud.points.col(i), 2);
    if (nearest.size() == 2) squared.push_back(nearest[1].squared_distance);
  }
  if (squared.empty()) return 0.0;
  const auto middle =
      squared.begin() + static_cast<std::ptrdiff_t>(squared.size() / 2);
  std::nth_element(squared.begin(), middle, squared.end());
  return std::sqrt(*middle);
}

double SurfaceShareOfVoxels(const PointCloud& cloud, double voxel_size) {
  std::string error;
  const auto voxels = SampleVoxels(cloud.points, voxel_size, &error);
  const double radius = InProportionTo(voxel_size).front_end.normal_radius;
  return voxels ? SurfaceShare(KdTree(*voxels), radius) : 1.0;
}

// `voxel_size` enlarged until normals are those of surfaces; as it is where no
// size in reach does that.
double SizeForSurfaces(const PointCloud& cloud, double voxel_size) {
  const double largest = kMaxGrowth * voxel_size;
  double size = voxel_size;
  while (size <= largest) {
    if (SurfaceShareOfVoxels(cloud, size) >= kWantedSurfaceShare) return size;
    size *= kGrowth;
  }
  return voxel_size;
}

}  // namespace

std::vector<std::string> PresetNames() {
  return {"kitti", "paper", "kitti_paper", "reference", "indoor"};
}

std::optional<RegistrationOptions> MakePreset(const std::string& name) {
  if (name == "kitti") return InProportionTo(0.3);
  if (name == "paper" || name == "kitti_paper") return MakePaper();
  if (name == "reference") return MakeReference();
  if (name == "indoor") return InProportionTo(0.1);
  return std::nullopt;
}

RegistrationOptions MakeAutoOptions(const PointCloud& source,
                                    const PointCloud& target) {
  if (source.points.cols() == 0 || target.points.cols() == 0) {
    return MakeAutoOptions(0.3);
  }
  if (std::max(source.points.cols(), target.points.cols()) > kMaxExamined) {
    return MakeAutoOptions(Thinned(source), Thinned(target));
  }
  const double size =
      std::max(SizeForWantedVoxels(source), SizeForWantedVoxels(target));
  const double spacing =
      std::max(TypicalSpacing(source), TypicalSpacing(target));
  // Two digits: a size that can be quoted, and that small changes do not move.
  const double dense = std::max(size, spacing);
  const double chosen =
      std::max(SizeForSurfaces(source, dense), SizeForSurfaces(target, dense));
  const double unit = std::pow(10.0, std::floor(std::log10(chosen)) - 1.0);
  return MakeAutoOptions(std::round(chosen / unit) * unit);
}

RegistrationOptions MakeAutoOptions(double voxel_size) {
  RegistrationOptions options = InProportionTo(voxel_size);
  options.search.scale_factors = {1.0, 2.0, 3.5};
  options.refinement.method = RefinementMethod::kVgicp;
  return options;
}

}  // namespace quatro
