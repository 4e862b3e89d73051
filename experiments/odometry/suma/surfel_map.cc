// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/suma/surfel_map.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

namespace quatro {
namespace {

// Disks no farther apart than this along a ray are on one surface [m].
constexpr double kSameSurface = 0.1;

// A disk is drawn up to this number of pixels from its center.
constexpr int kMaxReach = 4;

double LogOdds(double probability) {
  return std::log(probability / (1.0 - probability));
}

// Equation (1).
double SurfelRadius(const Eigen::Vector3d& vertex,
                    const Eigen::Vector3d& normal,
                    const SphericalImage& image) {
  const double range = vertex.norm();
  const double pixel = std::max(image.PixelWidth(), image.PixelHeight());
  const double cosine =
      std::clamp(std::abs(normal.dot(vertex)) / range, 0.5, 1.0);
  return std::sqrt(2.0) * range * pixel / cosine;
}

// Rays through the centers of all pixels.
Points RaysOf(const SphericalImage& image) {
  Points rays(3, image.size());
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      rays.col(Eigen::Index{v} * image.width + u) = image.Ray(u, v);
    }
  }
  return rays;
}

// Whether `vertex`, at `offset` from the center of its disk, replaces the
// content of the pixel. On the same surface the smaller offset wins, otherwise
// the nearer vertex.
bool IsBefore(const Eigen::Vector3d& vertex,
              double offset,
              const Eigen::Vector3d& there,
              double offset_there) {
  const double behind = vertex.norm() - there.norm();
  if (std::abs(behind) <= kSameSurface) return offset < offset_there;
  return behind < 0.0;
}

// `offsets` by pixel: distance of the drawn point from the center of its disk
// [m].
void Draw(std::int32_t index,
          const Eigen::Vector3d& position,
          const Eigen::Vector3d& normal,
          double radius,
          const Points& rays,
          std::vector<double>* offsets,
          RenderedMap* rendered) {
  const SphericalImage& image = rendered->view.image;
  const Eigen::Index middle = image.Project(position);
  if (middle < 0) return;
  const auto u = static_cast<int>(middle % image.width);
  const auto v = static_cast<int>(middle / image.width);
  const double range = position.norm();
  const double angle = std::atan2(radius, range);
  const double cosine = std::hypot(position.x(), position.y()) / range;
  const auto reach = [](double pixels) {
    return static_cast<int>(std::min<double>(kMaxReach, std::ceil(pixels)));
  };
  const int across = reach(angle / (image.PixelWidth() * cosine));
  const int down = reach(angle / image.PixelHeight());
  for (int row = std::max(0, v - down);
       row <= std::min(image.height - 1, v + down);
       ++row) {
    for (int i = -across; i <= across; ++i) {
      const int column = (u + i + image.width) % image.width;
      const Eigen::Index pixel = Eigen::Index{row} * image.width + column;
      const Eigen::Vector3d ray = rays.col(pixel);
      const double facing = normal.dot(ray);
      Eigen::Vector3d vertex =
          facing < 0.0 ? Eigen::Vector3d(normal.dot(position) / facing * ray)
                       : position;
      if ((vertex - position).squaredNorm() > radius * radius) {
        if (pixel != middle) continue;
        vertex = position;  // Each disk covers at least one pixel.
      }
      const double offset = (vertex - position).norm();
      double& offset_there = (*offsets)[static_cast<std::size_t>(pixel)];
      if (rendered->view.HasVertex(pixel) &&
          !IsBefore(vertex,
                    offset,
                    rendered->view.vertices.col(pixel),
                    offset_there)) {
        continue;
      }
      offset_there = offset;
      rendered->view.vertices.col(pixel) = vertex;
      rendered->view.normals.col(pixel) = normal;
      rendered->surfels[static_cast<std::size_t>(pixel)] = index;
    }
  }
}

}  // namespace

bool SurfelMapOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(max_distance > 0.0 && sigma_distance > 0.0 && sigma_angle > 0.0)) {
    problem << "max_distance, sigma_distance, sigma_angle = " << max_distance
            << ", " << sigma_distance << ", " << sigma_angle << ", must be > 0";
  } else if (!(max_angle > 0.0 && max_angle <= M_PI)) {
    problem << "max_angle = " << max_angle << ", must be in (0, pi]";
  } else if (!(blend >= 0.0 && blend <= 1.0)) {
    problem << "blend = " << blend << ", must be in [0, 1]";
  } else if (!(stable > 0.5 && stable < 1.0)) {
    problem << "stable = " << stable << ", must be in (0.5, 1)";
  } else if (confirm_within < 1 || forget_after < 1) {
    problem << "confirm_within, forget_after = " << confirm_within << ", "
            << forget_after << ", must be >= 1";
  } else if (!(radius > 0.0)) {
    problem << "radius = " << radius << ", must be > 0";
  }
  *error = problem.str();
  return error->empty();
}

SurfelMap::SurfelMap(const SurfelMapOptions& options) : options_(options) {
  std::string error;
  CHECK(options.IsValid(&error)) << error;
}

RenderedMap SurfelMap::Render(const SphericalImage& image,
                              const Rigid3& map_from_sensor) const {
  const Eigen::Index n = image.size();
  RenderedMap rendered{
      {image, Points::Zero(3, n), Points::Zero(3, n)},
      std::vector<std::int32_t>(static_cast<std::size_t>(n), -1)};
  const Points rays = RaysOf(image);
  std::vector<double> offsets(static_cast<std::size_t>(n), 0.0);
  const Rigid3 sensor_from_map = Inverse(map_from_sensor);
  for (std::size_t i = 0; i < surfels_.size(); ++i) {
    const Surfel& surfel = surfels_[i];
    const Eigen::Vector3d position = sensor_from_map * surfel.position;
    const Eigen::Vector3d normal = sensor_from_map.rotation * surfel.normal;
    // The back of a surface is not visible.
    if (!(normal.dot(position) < 0.0)) continue;
    Draw(static_cast<std::int32_t>(i),
         position,
         normal,
         surfel.radius,
         rays,
         &offsets,
         &rendered);
  }
  return rendered;
}

void SurfelMap::Update(const VertexMap& scan, const Rigid3& map_from_sensor) {
  const RenderedMap rendered = Render(scan.image, map_from_sensor);
  const int now = num_scans_++;
  const double min_cosine = std::cos(options_.max_angle);
  std::vector<Surfel> added;
  for (Eigen::Index i = 0; i < scan.image.size(); ++i) {
    if (!scan.HasNormal(i)) continue;
    const Eigen::Vector3d vertex =
        map_from_sensor * Eigen::Vector3d(scan.vertices.col(i));
    const Eigen::Vector3d normal =
        map_from_sensor.rotation * scan.normals.col(i);
    const double radius =
        SurfelRadius(scan.vertices.col(i), scan.normals.col(i), scan.image);

    const std::int32_t index = rendered.surfels[static_cast<std::size_t>(i)];
    if (index >= 0) {
      Surfel& surfel = surfels_[static_cast<std::size_t>(index)];
      const double distance = surfel.normal.dot(vertex - surfel.position);
      const double cosine = std::min(1.0, surfel.normal.dot(normal));
      if (std::abs(distance) <= options_.max_distance && cosine >= min_cosine) {
        // Equation (2).
        const double a = std::acos(cosine) / options_.sigma_angle;
        const double d = distance / options_.sigma_distance;
        surfel.log_odds += LogOdds(options_.stable * std::exp(-a * a - d * d));
        // Moves the disk along its normal only, not sideways.
        surfel.position += options_.blend * distance * surfel.normal;
        surfel.normal =
            ((1.0 - options_.blend) * surfel.normal + options_.blend * normal)
                .normalized();
        surfel.radius = std::min(surfel.radius, radius);
        surfel.seen = now;
        continue;
      }
      surfel.log_odds -= LogOdds(options_.stable);
    }
    added.push_back({vertex, normal, radius, 0.0, now, now});
  }
  surfels_.insert(surfels_.end(), added.begin(), added.end());
  std::erase_if(surfels_, [&](const Surfel& surfel) {
    return (surfel.log_odds <= 0.0 &&
            now - surfel.created >= options_.confirm_within) ||
           now - surfel.seen > options_.forget_after ||
           (surfel.position - map_from_sensor.translation).squaredNorm() >
               options_.radius * options_.radius;
  });
}

}  // namespace quatro
