// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Places with floors, some of them self-similar:
//
//   corridor   between two long walls, in a building or beside a road
//   hall       pillars, partitions, furniture, shop fronts in its walls
//   colonnade  pillars on a grid that extends beyond the sensor's range
//   terrace    a street of identical houses on both sides
//   room       a room of a few meters with furniture along its walls
//
// The world frame has its origin on the floor in the middle, x along the longer
// side and z up. A place with a symmetry S looks the same from a sensor at T
// and from a sensor at S T:
//
//   S { points of the scene } = { points of the scene }.                   (1)
//
// For a shift, (1) does not hold at the far ends.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_ROOMS_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_ROOMS_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "experiments/simulator/scene.h"

namespace quatro {

struct RoomOptions {
  uint64_t seed = 1;           // Seed of walls and pillars.
  uint64_t contents_seed = 1;  // Seed of movable objects.
  double length = 30.0;        // [m]
  double width = 20.0;         // [m]
  double height = 4.0;         // [m]

  // There is no furniture within 2 m of these places [m].
  std::vector<Eigen::Vector2d> places;
};

struct CorridorOptions : RoomOptions {
  bool is_outdoors = false;  // Walls beside a road, no ceiling.

  // The number of doors, niches, pilasters, side passages, lamps and objects
  // along the walls, which distinguish places along the corridor. With 0, only
  // its ends do.
  int num_features = 20;

  // The period at which the features repeat [m]; 0: they do not repeat.
  double period = 0.0;
};

// Closed by walls at its ends, except outdoors.
Scene MakeCorridor(const CorridorOptions& options);

struct HallOptions : RoomOptions {
  bool has_half_turn = false;  // S = R_z(pi).
};

Scene MakeHall(const HallOptions& options);

// A room with furniture only at the walls, so that the middle is free. It has
// no symmetry.
Scene MakeRoom(const RoomOptions& options);

// The symmetries S are shifts by spacing.x() along x and by spacing.y() along
// y, and R_z(pi). `height` is that of the ceiling; there is a pillar at the
// origin.
Scene MakeColonnade(uint64_t seed,
                    double height,
                    const Eigen::Vector2d& spacing);

// The symmetries S are shifts by `period` along x, and R_z(pi).
Scene MakeTerrace(uint64_t seed, double period);

// Adds crates, posts and bushes within 25 m of the origin, at least 2 m from
// `places`, to break a symmetry.
void AddOddThings(int num_things,
                  const std::vector<Eigen::Vector2d>& places,
                  double max_y,
                  Random& random,
                  Scene& scene);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_ROOMS_H_
