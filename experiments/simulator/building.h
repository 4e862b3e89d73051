// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// One floor of a large building: corridors of different widths between blocks
// of shops, and halls in place of some blocks, with pillars, doors, shop
// fronts, furniture and objects along the walls.
//
// The corridors form a grid. z points up, and the floor is at z = 0.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_BUILDING_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_BUILDING_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "experiments/simulator/scene.h"

namespace quatro {

class Building {
 public:
  // `num_corridors_x` corridors run along y, by ascending x, and
  // `num_corridors_y` along x, by ascending y.
  Building(uint64_t seed, int num_corridors_x, int num_corridors_y);

  // The intersection of two corridor axes [m].
  Eigen::Vector2d Crossing(int i, int j) const;

  // There are no objects within 1 m of the corridor axes.
  Scene MakeScene() const;

 private:
  struct Corridor {
    double axis, half_width;  // [m]
  };

  void AddBlock(const Eigen::Vector2d& lower,
                const Eigen::Vector2d& upper,
                Random& random,
                Scene& scene) const;
  void AddHall(const Eigen::Vector2d& lower,
               const Eigen::Vector2d& upper,
               Random& random,
               Scene& scene) const;

  uint64_t seed_;
  double height_;
  std::vector<Corridor> xs_, ys_;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_BUILDING_H_
