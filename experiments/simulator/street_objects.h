// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Objects in a street, one per call, with random details.
//
// A frame has its origin on the ground and z up. Objects that face the street
// do so with +y; x runs along their front, which is centered on the origin. All
// objects extend below the ground, which need not be level.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_STREET_OBJECTS_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_STREET_OBJECTS_H_

#include "experiments/simulator/scene.h"
#include "features/base/random.h"
#include "features/base/rigid3.h"

namespace quatro {

// A house of one to four stories with windows, doors and an occasional garage,
// bay or balcony on its four sides; steps, a rain pipe and bins in front of it.
// [m]
void AddHouse(const Rigid3& world_from_house,
              double width,
              double depth,
              Random& random,
              Scene& scene);

void AddShed(const Rigid3& world_from_shed, Random& random, Scene& scene);

void AddBush(const Rigid3& world_from_bush, Random& random, Scene& scene);

void AddTree(const Rigid3& world_from_tree, Random& random, Scene& scene);

// The car faces +x. [m]
void AddCar(const Rigid3& world_from_car,
            double length,
            Random& random,
            Scene& scene);

// The edge of a garden, made of pieces that follow the ground.
struct Border {
  enum Kind { kNone, kWall, kPickets, kHedge };
  Kind kind = kNone;
  double height = 1.0;  // [m]
  double piece = 0.8;   // Length of one piece [m].
  float reflectance = 0.4f;
};

Border DrawBorder(Random& random);

// The `index`-th piece, centered on the frame's origin.
void AddBorderPiece(const Rigid3& world_from_piece,
                    const Border& border,
                    int index,
                    Random& random,
                    Scene& scene);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_STREET_OBJECTS_H_
