// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The ground of a street, and the pose of a car on it.
//
// Places are (s, d): s meters along the axis, d to its left. With the axis
// c(s), its normal n(s) to the left and the ground h,
//
//   x_in_world = ( c(s) + d n(s), h(s, d) ),                              (1)
//   h = s tan(slope) + curve(s, d) + waves(s, d) + profile(s, d).
//
// The axis curves gently, with a radius above 100 m. The waves are sinusoids.
// The profile has a crown, curbs (lowered at the mouths of side streets),
// sidewalks and gardens. Between curve_begin and curve_end the grade d h / d s
// and the bank d h / d d change linearly, so that the road is a parabola there,
// as in road construction.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_ROAD_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_ROAD_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/simulator/street_axis.h"
#include "features/base/rigid3.h"

namespace quatro {

// Length of the street before the first and after the last pose [m]; few echoes
// come from farther away.
inline constexpr double kMargin = 90.0;

struct RoadOptions {
  uint64_t seed = 1;
  double length = 250.0;     // [m]
  double slope = 0.0;        // Slope of the axis [rad].
  double undulation = 0.05;  // Amplitude per 40 m of wavelength [m].
  double half_width = 4.5;   // Roadway with parked cars [m].

  // A crest (climb < 0) or a sag: the change of grade between curve_begin and
  // curve_end [m], and the change of bank, positive if the right side is lower
  // [rad].
  double curve_begin = 0.0;
  double curve_end = 1.0;
  double curve_climb = 0.0;
  double curve_bank = 0.0;

  // Side streets on both sides at this place [m], without others within 30 m;
  // negative: the seed places them.
  double crossing = -1.0;

  // Standard deviation of a car's roll and pitch on its suspension [rad].
  double tilt_sigma = 0.0052;

  bool IsValid(std::string* error) const;
};

class Road final : public StreetAxis {
 public:
  static constexpr double kSensorHeight = 1.73;  // Above the ground [m].
  static constexpr double kLane = -1.0;          // d of a moving car [m].
  static constexpr double kPavementWidth = 1.6;  // [m]

  // `options` must be valid.
  explicit Road(const RoadOptions& options);

  const RoadOptions& options() const { return options_; }
  double length() const override { return options_.length; }
  double half_width() const override { return options_.half_width; }
  const std::vector<SideStreet>& side_streets() const override {
    return side_streets_;
  }

  double Heading(double s) const override;
  Eigen::Vector3d SurfacePoint(double s, double d) const override;  // (1)

  // The sensor on a car, `lateral` [m] to the left of its lane. The origin is
  // in the sensor, with the axes of WorldFromGround except for the suspension.
  Rigid3 WorldFromSensor(double s, double lateral, double yaw) const;

 private:
  // The sinusoid amplitude sin(along_s s + along_d d + phase).
  struct Wave {
    double amplitude, along_s, along_d, phase;
  };
  using Waves = std::vector<Wave>;

  static double Sum(const Waves& waves, double s, double d);
  void AddCrossing();
  double Curve(double s, double d) const;
  double Height(double s, double d) const;

  RoadOptions options_;
  std::vector<SideStreet> side_streets_;
  Waves heading_waves_, ground_waves_, roll_waves_, pitch_waves_;
  double left_garden_slope_, right_garden_slope_;  // [m/m], outward.
  std::vector<Eigen::Vector2d> axis_;              // c at even steps.
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_ROAD_H_
