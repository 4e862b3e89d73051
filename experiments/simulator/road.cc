// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/road.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "experiments/simulator/scene.h"
#include "features/base/random.h"

namespace quatro {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kAxisStep = 0.25;    // [m]
constexpr double kKerbHeight = 0.12;  // [m]
constexpr double kKerbWidth = 0.03;   // [m]

double SmoothStep(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

bool RoadOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(length >= 50.0 && length <= 20000.0)) {
    problem << "length = " << length << ", must be in [50, 20000]";
  } else if (!(std::abs(slope) <= 0.35)) {
    problem << "slope = " << slope << ", must be within +-0.35";
  } else if (!(curve_end > curve_begin)) {
    problem << "curve_end = " << curve_end
            << ", must be > curve_begin = " << curve_begin;
  } else if (!(std::abs(curve_climb) <= 0.35)) {
    problem << "curve_climb = " << curve_climb << ", must be within +-0.35";
  } else if (!(std::abs(curve_bank) <= 0.15)) {
    problem << "curve_bank = " << curve_bank << ", must be within +-0.15";
  } else if (!(undulation >= 0.0 && undulation <= 0.5)) {
    problem << "undulation = " << undulation << ", must be in [0, 0.5]";
  } else if (!(half_width >= 3.5 && half_width <= 8.0)) {
    problem << "half_width = " << half_width << ", must be in [3.5, 8]";
  } else if (!(tilt_sigma >= 0.0 && tilt_sigma <= 0.2)) {
    problem << "tilt_sigma = " << tilt_sigma << ", must be in [0, 0.2]";
  }
  *error = problem.str();
  return error->empty();
}

Road::Road(const RoadOptions& options) : options_(options) {
  Random random(2 * options.seed);
  const auto draw_phase = [&] { return Uniform(random, 0.0, 2.0 * M_PI); };
  // The sum of amplitude [rad] times frequency [rad/m], which limits the
  // curvature, is less than 1 / (100 m).
  for (const auto& [amplitude, length] :
       {std::pair(0.3, 320.0), std::pair(0.04, 110.0)}) {
    const double scale = Uniform(random, 0.4, 1.0);
    heading_waves_.push_back(
        {scale * amplitude, 2.0 * M_PI / length, 0.0, draw_phase()});
  }
  for (const double length : {13.0, 21.0, 34.0, 55.0}) {
    const double direction = draw_phase();
    const double frequency = 2.0 * M_PI / length;
    ground_waves_.push_back({options.undulation * length / 40.0,
                             frequency * std::cos(direction),
                             frequency * std::sin(direction),
                             draw_phase()});
  }
  for (Waves* waves : {&roll_waves_, &pitch_waves_}) {
    constexpr int kNumWaves = 3;
    for (int i = 0; i < kNumWaves; ++i) {
      const double frequency = 2.0 * M_PI / Uniform(random, 6.0, 25.0);
      waves->push_back({options.tilt_sigma * std::sqrt(2.0 / kNumWaves),
                        frequency,
                        0.0,
                        draw_phase()});
    }
  }
  left_garden_slope_ = Uniform(random, -0.04, 0.04);
  right_garden_slope_ = Uniform(random, -0.04, 0.04);
  for (double s = Uniform(random, 10.0, 50.0); s < options.length - 10.0;
       s += Uniform(random, 45.0, 90.0)) {
    const double width = Uniform(random, 6.5, 9.0);
    const double kind = random.Uniform();
    if (kind < 0.65) side_streets_.push_back({s, width, 1});
    if (kind > 0.35) side_streets_.push_back({s, width, -1});
  }
  if (options.crossing >= 0.0) AddCrossing();
  Vector2d point = Vector2d::Zero();
  for (double s = 0.0; s <= options.length + kAxisStep; s += kAxisStep) {
    axis_.push_back(point);
    const double heading = Heading(s + kAxisStep / 2.0);
    point += kAxisStep * Vector2d(std::cos(heading), std::sin(heading));
  }
}

void Road::AddCrossing() {
  constexpr double kWidth = 8.0, kAlone = 30.0;  // [m]
  std::erase_if(side_streets_, [&](const SideStreet& street) {
    return std::abs(street.s - options_.crossing) < kAlone;
  });
  const auto after = std::find_if(
      side_streets_.begin(),
      side_streets_.end(),
      [&](const SideStreet& street) { return street.s > options_.crossing; });
  side_streets_.insert(after,
                       {SideStreet{options_.crossing, kWidth, 1},
                        SideStreet{options_.crossing, kWidth, -1}});
}

double Road::Curve(double s, double d) const {
  const double length = options_.curve_end - options_.curve_begin;
  const double t = std::clamp((s - options_.curve_begin) / length, 0.0, 1.0);
  const double past = std::max(0.0, s - options_.curve_end);
  const double more_grade = std::tan(options_.slope + options_.curve_climb) -
                            std::tan(options_.slope);
  return more_grade * (length * t * t / 2.0 + past) +
         std::tan(options_.curve_bank) * t * d;
}

double Road::Sum(const Waves& waves, double s, double d) {
  double sum = 0.0;
  for (const Wave& wave : waves) {
    sum += wave.amplitude *
           std::sin(wave.along_s * s + wave.along_d * d + wave.phase);
  }
  return sum;
}

double Road::Heading(double s) const { return Sum(heading_waves_, s, 0.0); }

double Road::Height(double s, double d) const {
  const int side = d > 0.0 ? 1 : -1;
  double raised = 1.0;  // 0 at the mouth of a side street.
  for (const SideStreet& street : side_streets_) {
    if (street.side != side) continue;
    raised *= SmoothStep(std::abs(s - street.s) - street.width / 2.0);
  }
  const double on_road = std::min(std::abs(d), options_.half_width);
  const double beyond_kerb = std::abs(d) - on_road;
  const double on_pavement = std::min(beyond_kerb, kPavementWidth);
  const double in_garden = beyond_kerb - on_pavement;
  const double kerb = kKerbHeight * std::min(1.0, beyond_kerb / kKerbWidth);
  const double profile =
      -0.02 * on_road + raised * (kerb + 0.02 * on_pavement) +
      (side > 0 ? left_garden_slope_ : right_garden_slope_) * in_garden;
  return std::tan(options_.slope) * s + Curve(s, d) + Sum(ground_waves_, s, d) +
         profile;
}

Vector3d Road::SurfacePoint(double s, double d) const {
  const auto num_steps = static_cast<double>(axis_.size() - 1);
  const double position = std::clamp(s / kAxisStep, 0.0, num_steps - 1e-6);
  const auto i = static_cast<size_t>(position);
  const double t = position - static_cast<double>(i);
  const double heading = Heading(s);
  const Vector2d normal(-std::sin(heading), std::cos(heading));
  const Vector2d xy = (1.0 - t) * axis_[i] + t * axis_[i + 1] + d * normal;
  return {xy.x(), xy.y(), Height(s, d)};
}

Rigid3 Road::WorldFromSensor(double s, double lateral, double yaw) const {
  const Eigen::AngleAxisd pitch(Sum(pitch_waves_, s, 0.0), Vector3d::UnitY());
  const Eigen::AngleAxisd roll(Sum(roll_waves_, s, 0.0), Vector3d::UnitX());
  const Rigid3 ground_from_body = {(pitch * roll).toRotationMatrix(),
                                   Vector3d::Zero()};
  const Rigid3 body_from_sensor = {Eigen::Matrix3d::Identity(),
                                   Vector3d(0.0, 0.0, kSensorHeight)};
  return WorldFromGround(s, kLane + lateral, yaw) * ground_from_body *
         body_from_sensor;
}

}  // namespace quatro
