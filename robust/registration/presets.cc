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
// The number of points that lengths are determined from; more have little
// effect.
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

// Options without the extensions that the paper and its code do not have.
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
Points Thinned(const Points& points) {
  const Eigen::Index num = points.cols();
  const Eigen::Index step = (num + kMaxExamined - 1) / kMaxExamined;
  return points(Eigen::all,
                Eigen::seq(0, num - 1, std::max<Eigen::Index>(1, step)));
}

double WidthOf(const Points& points) {
  return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).maxCoeff();
}

// The logarithm of the least of 256 sizes in (low, high] at which the points
// keep at most kWantedVoxels, or `high`. Most points are on surfaces, so their
// number falls with the square of the size. This predicts which size to try
// next.
double FindSize(const Points& points, double low, double high) {
  constexpr int kNumSizes = 256;
  constexpr double kFall = 2.0;
  const double step = (high - low) / kNumSizes;
  std::string error;
  int too_many = 0;
  int few_enough = kNumSizes;
  int next = kNumSizes / 2;
  while (few_enough - too_many > 1) {
    const Eigen::Index num =
        CountVoxels(points, std::exp(low + next * step), &error)
            .value_or(points.cols());
    (num > kWantedVoxels ? too_many : few_enough) = next;
    const double distance =
        std::log(static_cast<double>(num) / kWantedVoxels) / (kFall * step);
    next += static_cast<int>(std::lround(distance));
    next =
        std::clamp(next, too_many + 1, std::max(too_many + 1, few_enough - 1));
  }
  return low + few_enough * step;
}

// The size at which the cloud keeps kWantedVoxels. A cloud with fewer points
// than that gives a size far below their spacing.
double SizeForWantedVoxels(const Points& points) {
  constexpr double kUsualMin = 0.01;  // [m]
  constexpr double kUsualMax = 10.0;  // [m]
  constexpr double kMinShare = 1e-4;  // Share of the extent of a smaller cloud.
  const double extent = WidthOf(points);
  double high = FindSize(points, std::log(kUsualMin), std::log(kUsualMax));
  if (std::exp(high) >= kUsualMax && extent > kUsualMax) {
    high = FindSize(points, std::log(kUsualMax), std::log(extent));
  } else if (std::exp(high) <= 1.03 * kUsualMin &&
             kMinShare * extent < kUsualMin && extent > 0.0) {
    high = FindSize(points, std::log(kMinShare * extent), high);
  }
  return std::exp(high);
}

// Whether the cloud has points, and distances that can be squared.
bool HasLengths(const Points& points) {
  if (points.cols() == 0) return false;
  const double width = WidthOf(points);
  return !(width > 0.0 && width < kMinCloudWidth);
}

// Median distance of a point from its nearest neighbor [m].
double TypicalSpacing(const Points& points) {
  const KdTree tree(points);
  const Eigen::Index n = points.cols();
  const Eigen::Index step = std::max<Eigen::Index>(1, n / kNumSamples);
  std::vector<double> squared;
  for (Eigen::Index i = 0; i < n; i += step) {
    const auto nearest = tree.Nearest(points.col(i), 2);
    if (nearest.size() == 2) squared.push_back(nearest[1].squared_distance);
  }
  if (squared.empty()) return 0.0;
  const auto middle =
      squared.begin() + static_cast<std::ptrdiff_t>(squared.size() / 2);
  std::nth_element(squared.begin(), middle, squared.end());
  return std::sqrt(*middle);
}

// If most voxels contain several points, the spacing is below the voxel size
// and not needed.
double SpacingIfSparse(const Points& points) {
  return points.cols() > 4 * kWantedVoxels ? 0.0 : TypicalSpacing(points);
}

double SurfaceShareOfVoxels(const Points& points, double voxel_size) {
  std::string error;
  const auto voxels = SampleVoxels(points, voxel_size, &error);
  const double radius = InProportionTo(voxel_size).front_end.normal_radius;
  return voxels ? SurfaceShare(KdTree(*voxels), radius) : 1.0;
}

// Enlarges `voxel_size` until most normals are those of surfaces. Returns it
// unchanged if no size up to kMaxGrowth times as large achieves that.
double SizeForSurfaces(const Points& points, double voxel_size) {
  const double largest = kMaxGrowth * voxel_size;
  double size = voxel_size;
  while (size <= largest) {
    if (SurfaceShareOfVoxels(points, size) >= kWantedSurfaceShare) return size;
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
  // The front end refuses clouds without points or width.
  if (!HasLengths(source.points) || !HasLengths(target.points)) {
    return MakeAutoOptions(0.3);
  }
  const Points p = Thinned(source.points);
  const Points q = Thinned(target.points);
  const double size = std::max(SizeForWantedVoxels(p), SizeForWantedVoxels(q));
  const double spacing = std::max(SpacingIfSparse(p), SpacingIfSparse(q));
  // Two digits: a size that can be quoted, and that small changes do not move.
  const double dense = std::max(size, spacing);
  const double chosen =
      std::max(SizeForSurfaces(p, dense), SizeForSurfaces(q, dense));
  const double unit = std::pow(10.0, std::floor(std::log10(chosen)) - 1.0);
  return MakeAutoOptions(std::round(chosen / unit) * unit);
}

RegistrationOptions MakeAutoOptions(double voxel_size) {
  RegistrationOptions options = InProportionTo(voxel_size);
  options.search.scale_factors = {1.0, 2.0, 3.5};
  options.search.max_rung = 2;  // A larger scale finds more than a third rung.
  options.ins.gravity = Gravity::kScans;
  options.refinement.method = RefinementMethod::kVgicp;
  return options;
}

}  // namespace quatro
