// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Places with floors, and places that look like themselves:
//
//   corridor   between two long walls, in a building or beside a road
//   hall       pillars, partitions, furniture, shop fronts in its walls
//   colonnade  pillars on a grid that goes on beyond the sensor's range
//   terrace    a street of one house, built again and again on both sides
//
// The world frame has its origin on the floor in the middle, x along the
// longer side and z up. A place with a symmetry S looks the same from a sensor
// at T as from one at S T:
//
//   S { points of the scene } = { points of the scene }.                   (1)
//
// For a shift, (1) holds but for the far ends.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_ROOMS_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_ROOMS_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "experiments/simulator/scene.h"

namespace quatro {

struct RoomOptions {
  uint64_t seed = 1;           // Of walls and pillars.
  uint64_t contents_seed = 1;  // Of what can be moved.
  double length = 30.0;        // [m]
  double width = 20.0;         // [m]
  double height = 4.0;         // [m]

  // No furniture within 2 m of these [m].
  std::vector<Eigen::Vector2d> places;
};

struct CorridorOptions : RoomOptions {
  bool is_outdoors = false;  // Walls beside a road, and no ceiling.

  // Doors, niches, pilasters, side passages, lamps, things along the walls:
  // all that tells where along the corridor one is. 0: nothing does but its
  // ends.
  int num_features = 20;

  // Those repeat after so many metres; 0: they don't.
  double period = 0.0;
};

// Closed by walls at its ends, unless it is outdoors.
Scene MakeCorridor(const CorridorOptions& options);

struct HallOptions : RoomOptions {
  bool has_half_turn = false;  // S = R_z(pi).
};

Scene MakeHall(const HallOptions& options);

// S: shifts by spacing.x() along x and by spacing.y() along y, and R_z(pi).
// `height` of the ceiling; a pillar stands at the origin.
Scene MakeColonnade(uint64_t seed,
                    double height,
                    const Eigen::Vector2d& spacing);

// S: shifts by `period` along x, and R_z(pi).
Scene MakeTerrace(uint64_t seed, double period);

// Crates, posts and bushes that stand about within 25 m of the origin and
// break a symmetry; 2 m clear of `places`.
void AddOddThings(int num_things,
                  const std::vector<Eigen::Vector2d>& places,
                  double max_y,
                  Random& random,
                  Scene& scene);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_ROOMS_H_
