// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/suma/suma.h"

#include <glog/logging.h>

#include <sstream>

namespace quatro {
namespace {

// The minimum for the first scan; with fewer surfels, later scans cannot be
// tracked.
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
  } else if (start_rounds < 1) {
    problem << "start_rounds = " << start_rounds << ", must be >= 1";
  } else if (!(start_distance >= icp.max_distance)) {
    problem << "start_distance = " << start_distance
            << ", must be >= icp.max_distance = " << icp.max_distance;
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
                " surfels, must make at least " + std::to_string(kMinSurfels)};
  }
  image_ = *image;
  map_ = map;
  return {Rigid3{}, "the first scan"};
}

ProjectiveIcpSummary Suma::AlignToMap(const VertexMap& vertices,
                                      const Rigid3& world_from_scan_guess,
                                      double max_distance) const {
  ProjectiveIcpOptions icp = options_.icp;
  icp.max_distance = max_distance;
  const RenderedMap model = map_.Render(image_, world_from_scan_guess);
  return AlignProjectively(vertices, model.view, Rigid3{}, icp);
}

TrackResult Suma::Track(const PointCloud& scan,
                        const Rigid3& world_from_scan_guess) {
  const VertexMap vertices = MakeVertexMap(
      scan.points, image_, options_.min_range, options_.num_threads);
  const double end_distance = options_.icp.max_distance;
  const int num_rounds = has_velocity_ ? 1 : options_.start_rounds;
  Rigid3 world_from_scan = world_from_scan_guess;
  std::string message;
  for (int left = num_rounds - 1; left >= 0; --left) {
    const double extra =
        num_rounds > 1
            ? (options_.start_distance - end_distance) * left / (num_rounds - 1)
            : 0.0;
    const ProjectiveIcpSummary icp =
        AlignToMap(vertices, world_from_scan, end_distance + extra);
    if (!icp.model_from_scan) return {std::nullopt, icp.message};
    world_from_scan = Normalized(world_from_scan * *icp.model_from_scan);
    message = icp.message;
  }
  map_.Update(vertices, world_from_scan);
  has_velocity_ = true;
  return {world_from_scan, message};
}

}  // namespace quatro
