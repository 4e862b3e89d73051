// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/city.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "experiments/simulator/street.h"
#include "experiments/simulator/street_axis.h"
#include "features/base/random.h"

namespace quatro {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHalfWidth = 5.5;     // Half of a roadway [m].
constexpr double kOutskirts = 60.0;    // Around the outermost streets [m].
constexpr double kBendLength = 310.0;  // Wavelength of (1) [m].

double DistanceToClosest(const std::vector<double>& axes, double x) {
  double distance = std::abs(x - axes.front());
  for (const double axis : axes) {
    distance = std::min(distance, std::abs(x - axis));
  }
  return distance;
}

// Grid lines of the ground, fine near the curbs and coarse inside the blocks.
std::vector<double> GridLines(const std::vector<double>& axes) {
  std::vector<double> lines;
  for (double x = axes.front() - kOutskirts; x < axes.back() + kOutskirts;) {
    const double distance = DistanceToClosest(axes, x);
    if (distance > kHalfWidth + 2.0) lines.push_back(x);
    x += distance < 16.0 ? 0.8 : 1.6;
  }
  for (const double axis : axes) {
    for (const double beyond :
         {-kHalfWidth, -4.4, -3.3, -2.2, -1.1, 0.0, 0.03, 0.7, 1.6, 1.9}) {
      const double d = kHalfWidth + beyond;
      lines.push_back(axis + d);
      if (d > 0.0) lines.push_back(axis - d);
    }
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

// One street of the plan as a StreetAxis for street.h.
class CityStreet : public StreetAxis {
 public:
  CityStreet(const City& city,
             bool is_along_u,
             double axis,
             double begin,
             double end,
             const std::vector<double>& crossings)
      : city_(city),
        is_along_u_(is_along_u),
        axis_(axis),
        begin_(begin),
        length_(end - begin) {
    for (const double crossing : crossings) {
      for (const int side : {1, -1}) {
        side_streets_.push_back({crossing - begin, 2.0 * kHalfWidth, side});
      }
    }
  }

  double length() const override { return length_; }
  double half_width() const override { return kHalfWidth; }
  const std::vector<SideStreet>& side_streets() const override {
    return side_streets_;
  }
  double Heading(double s) const override {
    constexpr double kStep = 0.5;  // [m]
    const Vector3d ahead =
        SurfacePoint(s + kStep, 0.0) - SurfacePoint(s - kStep, 0.0);
    return std::atan2(ahead.y(), ahead.x());
  }
  Vector3d SurfacePoint(double s, double d) const override {
    return city_.SurfacePoint(is_along_u_ ? Vector2d(begin_ + s, axis_ + d)
                                          : Vector2d(axis_ - d, begin_ + s));
  }

 private:
  const City& city_;
  const bool is_along_u_;
  const double axis_, begin_, length_;
  std::vector<SideStreet> side_streets_;
};

}  // namespace

bool CityOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (num_streets_u < 1 || num_streets_u > 9) {
    problem << "num_streets_u = " << num_streets_u << ", must be in [1, 9]";
  } else if (num_streets_v < 1 || num_streets_v > 9) {
    problem << "num_streets_v = " << num_streets_v << ", must be in [1, 9]";
  } else if (!(block >= 70.0 && block <= 300.0)) {
    problem << "block = " << block << ", must be in [70, 300]";
  } else if (!(bend >= 0.0 && bend <= 15.0)) {
    problem << "bend = " << bend << ", must be in [0, 15]";
  } else if (!(max_grade >= 0.0 && max_grade <= 0.27)) {
    problem << "max_grade = " << max_grade << ", must be in [0, 0.27]";
  } else if (!(terrace >= 0.0 && terrace <= 1.0)) {
    problem << "terrace = " << terrace << ", must be in [0, 1]";
  }
  *error = problem.str();
  return error->empty();
}

City::City(const CityOptions& options) : options_(options) {
  Random random(Mix(options.seed) ^ 7);
  const auto draw_phase = [&] { return Uniform(random, 0.0, 2.0 * M_PI); };
  for (const auto& [axes, num] : {std::pair(&us_, options.num_streets_u),
                                  std::pair(&vs_, options.num_streets_v)}) {
    double axis = 0.0;
    for (int i = 0; i < num; ++i) {
      axes->push_back(axis);
      axis += options.block * Uniform(random, 0.85, 1.15);
    }
  }
  bend_frequency_ = 2.0 * M_PI / kBendLength;
  bend_phase_u_ = draw_phase();
  bend_phase_v_ = draw_phase();
  // Two crossing sinusoidal hills, whose grades add up where they are steepest.
  double azimuth = draw_phase();
  for (const double length : {260.0, 170.0}) {
    const double frequency = 2.0 * M_PI / length;
    waves_.push_back(
        {std::tan(options.max_grade) / std::sqrt(2.0) / frequency,
         frequency * Vector2d(std::cos(azimuth), std::sin(azimuth)),
         draw_phase()});
    azimuth += M_PI / 2.0;
  }
  for (const double length : {13.0, 21.0, 34.0, 55.0}) {
    azimuth = draw_phase();
    waves_.push_back(
        {0.05 * length / 40.0,
         2.0 * M_PI / length * Vector2d(std::cos(azimuth), std::sin(azimuth)),
         draw_phase()});
  }
}

Vector2d City::Plan(const Crossing& crossing) const {
  return {us_[static_cast<size_t>(crossing.x())],
          vs_[static_cast<size_t>(crossing.y())]};
}

double City::BeyondKerb(const Vector2d& uv) const {
  return std::max(
      0.0,
      std::min(DistanceToClosest(us_, uv.x()), DistanceToClosest(vs_, uv.y())) -
          kHalfWidth);
}

Vector3d City::SurfacePoint(const Vector2d& uv) const {
  constexpr double kKerbHeight = 0.12, kKerbWidth = 0.03;  // [m]
  const double beyond = BeyondKerb(uv);
  double height = kKerbHeight * std::min(1.0, beyond / kKerbWidth) +
                  0.02 * std::min(beyond, 1.6);
  for (const Wave& wave : waves_) {
    height += wave.amplitude * std::sin(wave.frequency.dot(uv) + wave.phase);
  }
  return {uv.x() + options_.bend *
                       std::sin(bend_frequency_ * uv.y() + bend_phase_u_),
          uv.y() + options_.bend *
                       std::sin(bend_frequency_ * uv.x() + bend_phase_v_),
          height};
}

Rigid3 City::WorldFromCar(const Vector2d& uv, const Vector2d& direction) const {
  constexpr double kHalfBase = 1.35, kHalfTrack = 0.75;  // [m]
  const Vector2d forward = direction.normalized();
  const Vector2d to_left = kHalfTrack * Vector2d(-forward.y(), forward.x());
  const Vector3d ahead = SurfacePoint(uv + kHalfBase * forward) -
                         SurfacePoint(uv - kHalfBase * forward);
  const Vector3d left = SurfacePoint(uv + to_left) - SurfacePoint(uv - to_left);
  const Vector3d x = ahead.normalized();
  const Vector3d z = ahead.cross(left).normalized();
  Rigid3 world_from_car;
  world_from_car.rotation << x, z.cross(x), z;
  world_from_car.translation = SurfacePoint(uv);
  return world_from_car;
}

void City::AddGround(Random& random, Scene& scene) const {
  scene.AddSurface(
      GridLines(us_),
      GridLines(vs_),
      [&](double u, double v) -> Vector3d {
        const Vector2d uv(u, v);
        const double tuft =
            BeyondKerb(uv) > 1.7 ? Uniform(random, -0.04, 0.06) : 0.0;
        return SurfacePoint(uv) + Vector3d(0.0, 0.0, tuft);
      },
      [&](double u, double v) {
        const double beyond = BeyondKerb({u, v});
        if (beyond > 1.7) {
          return static_cast<float>(Uniform(random, 0.25, 0.45));
        }
        return beyond > 0.0 ? 0.35f : 0.25f;
      });
}

Scene City::MakeScene() const {
  Random random(Mix(options_.seed) ^ 8);
  Scene scene;
  AddGround(random, scene);
  StreetSides sides;
  sides.clear_mouths = true;
  sides.terrace = options_.terrace;
  sides.reach = std::min(58.0, 0.42 * options_.block);
  // More open than the street of road.h, so that voxels, matches and the inlier
  // share are similar to KITTI's (compare_kitti.py).
  sides.deeper = 6.0;
  sides.gap = 20.0;
  sides.park = 0.2;
  sides.plants = 1.0;
  // The corners of the blocks belong to the streets along u.
  sides.corner = 4.0;
  for (const double axis : vs_) {
    AddStreetSides(CityStreet(*this,
                              true,
                              axis,
                              us_.front() - kOutskirts,
                              us_.back() + kOutskirts,
                              us_),
                   sides,
                   random.Next() >> 2,
                   scene);
  }
  sides.corner = 26.0;
  for (const double axis : us_) {
    AddStreetSides(CityStreet(*this,
                              false,
                              axis,
                              vs_.front() - kOutskirts,
                              vs_.back() + kOutskirts,
                              vs_),
                   sides,
                   random.Next() >> 2,
                   scene);
  }
  return scene;
}

std::vector<Vector2d> PlanDrive(const City& city,
                                const std::vector<Crossing>& route,
                                double spacing) {
  constexpr double kLane = 1.3;   // To the right of the axis [m].
  constexpr double kTurn = 9.0;   // A turn starts at this distance [m].
  constexpr double kFine = 0.05;  // [m]
  std::vector<Vector2d> fine;
  const auto add_line = [&](const Vector2d& from, const Vector2d& to) {
    const double length = (to - from).norm();
    for (double t = 0.0; t < length; t += kFine) {
      fine.emplace_back(from + t / length * (to - from));
    }
  };
  const auto unit = [&](size_t i) -> Vector2d {
    return (city.Plan(route[i + 1]) - city.Plan(route[i])).normalized();
  };
  const auto right_of = [](const Vector2d& along) {
    return Vector2d(along.y(), -along.x());
  };
  Vector2d from = city.Plan(route[0]) + kLane * right_of(unit(0));
  for (size_t i = 0; i + 1 < route.size(); ++i) {
    const Vector2d along = unit(i);
    const Vector2d corner = city.Plan(route[i + 1]);
    if (i + 2 == route.size() || unit(i + 1).dot(along) > 0.5) {
      const Vector2d to = corner + kLane * right_of(along);
      add_line(from, to);
      from = to;
      continue;
    }
    // A parabola between the two lanes.
    const Vector2d next = unit(i + 1);
    const Vector2d control =
        corner + kLane * (right_of(along) + right_of(next));
    const Vector2d begin = control - kTurn * along;
    const Vector2d end = control + kTurn * next;
    add_line(from, begin);
    for (double t = 0.0; t < 1.0; t += kFine / kTurn / 2.0) {
      fine.emplace_back((1.0 - t) * (1.0 - t) * begin +
                        2.0 * t * (1.0 - t) * control + t * t * end);
    }
    from = end;
  }
  std::vector<Vector2d> drive = {fine.front()};
  double since = 0.0;
  for (size_t i = 1; i < fine.size(); ++i) {
    since +=
        (city.SurfacePoint(fine[i]) - city.SurfacePoint(fine[i - 1])).norm();
    if (since < spacing) continue;
    drive.push_back(fine[i]);
    since -= spacing;
  }
  return drive;
}

}  // namespace quatro
