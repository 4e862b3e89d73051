// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/suma.h"

#include <glog/logging.h>

#include <sstream>

namespace quatro {
namespace {

// Of a first scan; with fewer nothing could be tracked later.
constexpr std::size_t kMinSurfels = 100;

}  // namespace

bool SumaOptions::IsValid(std::string* error) const {
  SphericalImage image;
  image.width = width;
  image.height = height;
  if (!image.IsValid(error) || !icp.IsValid(error) || !map.IsValid(error)) {
    return false;
  }
  std::ostringstream problem;
  if (!(min_range >= 0.0)) {
    problem << "min_range = " << min_range << ", must be >= 0";
  } else if (num_threads < 0) {
    problem << "num_threads = " << num_threads << ", must be >= 0";
  }
  *error = problem.str();
  return error->empty();
}

Suma::Suma(const SumaOptions& options) : options_(options), map_(options.map) {
  std::string error;
  CHECK(options.IsValid(&error)) << error;
}

TrackResult Suma::Start(const PointCloud& scan) {
  const auto image = FitImage(scan.points, options_.width, options_.height);
  if (!image) return {std::nullopt, "all points have one elevation"};
  SurfelMap map(options_.map);
  map.Update(MakeVertexMap(
                 scan.points, *image, options_.min_range, options_.num_threads),
             Rigid3{});
  if (map.surfels().size() < kMinSurfels) {
    return {std::nullopt,
            "the scan makes " + std::to_string(map.surfels().size()) +
                " surfels, must make " + std::to_string(kMinSurfels)};
  }
  image_ = *image;
  map_ = map;
  return {Rigid3{}, "the first scan"};
}

TrackResult Suma::Track(const PointCloud& scan,
                        const Rigid3& world_from_scan_guess) {
  const VertexMap vertices = MakeVertexMap(
      scan.points, image_, options_.min_range, options_.num_threads);
  const RenderedMap model = map_.Render(image_, world_from_scan_guess);
  const ProjectiveIcpSummary icp =
      AlignProjectively(vertices, model.view, Rigid3{}, options_.icp);
  if (!icp.model_from_scan) return {std::nullopt, icp.message};
  const Rigid3 world_from_scan = world_from_scan_guess * *icp.model_from_scan;
  map_.Update(vertices, world_from_scan);
  return {world_from_scan, icp.message};
}

}  // namespace quatro
