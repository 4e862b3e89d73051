// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A city of blocks between crossing streets, on hills, and a car that drives
// through it.
//
// The plan is a grid with u to the east and v to the north. Its streets run
// along u or v. It is bent onto the ground by
//
//   x = u + A sin(k v + a),   y = v + A sin(k u + b),   z = h(u, v),      (1)
//
// so that streets curve and do not cross at exactly right angles. h contains
// hills, undulations of 13 to 55 m, curbs, sidewalks and rough gardens.

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
  double block = 90.0;      // Approximate distance between streets [m].
  double bend = 6.0;        // A of (1) [m].
  double max_grade = 0.05;  // Steepest hill [rad].
  double terrace = 0.3;     // Share of blocks without gaps.

  bool IsValid(std::string* error) const;
};

// An intersection: the u-th of the streets along v and the v-th of the streets
// along u.
using Crossing = Eigen::Vector2i;

class City {
 public:
  // `options` must be valid.
  explicit City(const CityOptions& options);

  const CityOptions& options() const { return options_; }
  Eigen::Vector2d Plan(const Crossing& crossing) const;           // (u, v)
  Eigen::Vector3d SurfacePoint(const Eigen::Vector2d& uv) const;  // (1)

  // The frame of a car that drives along `direction` of the plan: origin on the
  // ground, x ahead, z normal to the ground under the car.
  Rigid3 WorldFromCar(const Eigen::Vector2d& uv,
                      const Eigen::Vector2d& direction) const;

  // The ground and all objects.
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

// The path of a drive on the right-hand side of the streets from crossing to
// crossing, in even steps of `spacing` [m]. Consecutive crossings must be
// neighbors, and the car does not turn back on the spot.
std::vector<Eigen::Vector2d> PlanDrive(const City& city,
                                       const std::vector<Crossing>& route,
                                       double spacing);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_CITY_H_
