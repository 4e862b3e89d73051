// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A residential street along a road: houses 6 to 12 m from its axis, in
// terraces or apart, with front gardens behind fences, walls and hedges;
// side streets with houses of their own; parked cars, lamps, signs, boxes,
// trees and bushes; and what can be seen through the gaps.

#ifndef QUATRO_EXPERIMENTS_STREET_H_
#define QUATRO_EXPERIMENTS_STREET_H_

#include "experiments/road.h"
#include "experiments/scene.h"

namespace quatro {

// The ground and all that stands on it, in the world frame of the road. Drawn
// from the road's seed.
Scene MakeStreet(const Road& road);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_STREET_H_
