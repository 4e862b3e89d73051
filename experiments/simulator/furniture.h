// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Objects in a building, one per call, with random details. A frame has its
// origin on the floor and z up.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_FURNITURE_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_FURNITURE_H_

#include <vector>

#include "experiments/simulator/scene.h"
#include "features/base/random.h"
#include "features/base/rigid3.h"

namespace quatro {

// A table with chairs, a shelf, a counter, a sofa, crates, a potted plant or a
// stand. All points are within 1.8 m of the frame's z axis.
void AddFurniture(const Rigid3& world_from_furniture,
                  Random& random,
                  Scene& scene);

// A low and narrow object at a wall whose face is the plane y = 0: a bench, a
// bin, a cabinet, a plant or a fire extinguisher. [m]
void AddThingAtWall(const Rigid3& world_from_wall,
                    Random& random,
                    Scene& scene);

// A door, a window, a niche, a pilaster, a shop front or, if `with_passages`, a
// side passage, centered at x in a wall of the given height. [m]
void AddWallFeature(double x,
                    double wall_height,
                    bool with_passages,
                    Random& random,
                    std::vector<WallPatch>& patches);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_FURNITURE_H_
