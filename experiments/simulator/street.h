// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A residential street along a road: houses 6 to 12 m from its axis, terraced
// or detached, with front gardens behind fences, walls and hedges; side streets
// with their own houses; parked cars, lamps, signs, boxes, trees and bushes;
// and whatever is visible through the gaps.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_STREET_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_STREET_H_

#include <cstdint>

#include "experiments/simulator/road.h"
#include "experiments/simulator/scene.h"
#include "experiments/simulator/street_axis.h"

namespace quatro {

// The ground and all objects, in the world frame of the road, drawn from the
// road's seed.
Scene MakeStreet(const Road& road);

struct StreetSides {
  double reach = 58.0;        // Largest |d| with objects [m].
  double corner = 1.0;        // Side street's curb to a house [m].
  double terrace = 0.3;       // Share of blocks without gaps between houses.
  bool clear_mouths = false;  // No lamps and signs at side streets.
  double deeper = 0.0;        // Extra depth of front gardens [m].
  double gap = 9.0;           // Largest gap between two houses [m].
  double park = 0.13;         // Share of lots without a house.
  double plants = 0.4;        // Largest number per meter of front garden.
};

// The objects on both sides of a street, without ground and side streets.
void AddStreetSides(const StreetAxis& street,
                    const StreetSides& sides,
                    uint64_t seed,
                    Scene& scene);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_STREET_H_
