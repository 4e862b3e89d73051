// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A city of blocks between streets that cross, on hills, and a car that drives
// through it.
//
// It is planned on a grid, u to the east and v to the north, whose streets run
// along u or v, and bent onto the ground by
//
//   x = u + A sin(k v + a),   y = v + A sin(k u + b),   z = h(u, v),      (1)
//
// so that streets curve and cross at angles that are not quite right. h has
// hills, waves of the size of a car, kerbs, pavements and rough gardens.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_CITY_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_CITY_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/simulator/scene.h"
#include "features/base/rigid3.h"

namespace quatro {

struct CityOptions {
  uint64_t seed = 1;
  int num_streets_u = 3;    // Streets that run along v, by ascending u.
  int num_streets_v = 3;    // Streets that run along u, by ascending v.
  double block = 90.0;      // From one street to the next, about [m].
  double bend = 6.0;        // A of (1) [m].
  double max_grade = 0.05;  // Steepest hill [rad].
  double terrace = 0.3;     // Share of blocks without gaps.

  bool IsValid(std::string* error) const;
};

// Where two streets cross: the u-th of those along v, the v-th of those along
// u.
using Crossing = Eigen::Vector2i;

class City {
 public:
  // `options` must be valid.
  explicit City(const CityOptions& options);

  const CityOptions& options() const { return options_; }
  Eigen::Vector2d Plan(const Crossing& crossing) const;           // (u, v)
  Eigen::Vector3d SurfacePoint(const Eigen::Vector2d& uv) const;  // (1)

  // Origin on the ground, x ahead, z its normal over the footprint of a car
  // that drives along `direction` of the plan.
  Rigid3 WorldFromCar(const Eigen::Vector2d& uv,
                      const Eigen::Vector2d& direction) const;

  // The ground and what stands on it.
  Scene MakeScene() const;

 private:
  struct Wave {
    double amplitude;
    Eigen::Vector2d frequency;  // [rad/m]
    double phase;
  };

  void AddGround(Random& random, Scene& scene) const;
  double BeyondKerb(const Eigen::Vector2d& uv) const;

  CityOptions options_;
  std::vector<double> us_, vs_;  // Axes of the streets.
  double bend_frequency_, bend_phase_u_, bend_phase_v_;
  std::vector<Wave> waves_;
};

// The plan of a drive on the right-hand side of the streets from crossing to
// crossing, in even steps of `spacing` [m]. Crossings that follow each other
// must be neighbours, and no one turns back on the spot.
std::vector<Eigen::Vector2d> PlanDrive(const City& city,
                                       const std::vector<Crossing>& route,
                                       double spacing);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_CITY_H_
