// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A residential street along a road: houses 6 to 12 m from its axis, in
// terraces or apart, with front gardens behind fences, walls and hedges;
// side streets with houses of their own; parked cars, lamps, signs, boxes,
// trees and bushes; and what can be seen through the gaps.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_STREET_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_STREET_H_

#include <cstdint>

#include "experiments/simulator/road.h"
#include "experiments/simulator/scene.h"
#include "experiments/simulator/street_axis.h"

namespace quatro {

// The ground and all that stands on it, in the world frame of the road. Drawn
// from the road's seed.
Scene MakeStreet(const Road& road);

struct StreetSides {
  double reach = 58.0;   // Largest |d| that is built [m].
  double corner = 1.0;   // From a side street's kerb to the first house [m].
  double terrace = 0.3;  // Share of blocks that are without gaps.
  bool clear_mouths = false;  // No lamps and signs in side streets' mouths.
  double deeper = 0.0;        // By how much front gardens may be more so [m].
  double gap = 9.0;           // Largest between two houses [m].
  double park = 0.13;         // Share of lots without a house.
  double plants = 0.4;        // Most of a front garden, per metre of street.
};

// What stands on both sides of a street, without ground and side streets.
void AddStreetSides(const StreetAxis& street,
                    const StreetSides& sides,
                    uint64_t seed,
                    Scene& scene);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_STREET_H_
