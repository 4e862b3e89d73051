// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/furniture.h"

#include <algorithm>
#include <cmath>

namespace quatro {
namespace {

using Eigen::Vector3d;

void AddTable(const Rigid3& frame, Random& random, Scene& scene) {
  const double half_x = Uniform(random, 0.4, 1.0);
  const double half_y = Uniform(random, 0.35, 0.5);
  const double height = Uniform(random, 0.7, 0.8);
  const float shade = Shade(random, 0.3, 0.7);
  scene.AddBox(frame,
               {-half_x, -half_y, height - 0.04},
               {half_x, half_y, height},
               shade);
  for (const double x : {-half_x + 0.05, half_x - 0.05}) {
    for (const double y : {-half_y + 0.05, half_y - 0.05}) {
      scene.AddCylinder(frame * Shift(x, y, 0.0), 0.025, 0.0, height, shade);
    }
  }
  const int num_chairs = static_cast<int>(Uniform(random, 0.0, 4.0));
  for (int i = 0; i < num_chairs; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const Rigid3 chair =
        frame *
        Shift(Uniform(random, -half_x, half_x), side * (half_y + 0.2), 0.0) *
        Rigid3{RotationZ(Uniform(random, -0.5, 0.5)), Vector3d::Zero()};
    scene.AddBox(chair, {-0.22, -0.22, 0.42}, {0.22, 0.22, 0.46}, shade);
    scene.AddBox(chair,
                 {-0.22, side * 0.2 - 0.02, 0.46},
                 {0.22, side * 0.2 + 0.02, 0.9},
                 shade);
    scene.AddCylinder(chair, 0.04, 0.0, 0.42, 0.2f);
  }
}

void AddShelf(const Rigid3& frame, Random& random, Scene& scene) {
  const double half = Uniform(random, 0.5, 1.5);
  const double height = Uniform(random, 1.2, 2.2);
  const float shade = Shade(random, 0.3, 0.7);
  scene.AddBox(frame, {-half, -0.02, 0.0}, {half, 0.02, height}, shade);
  for (const double x : {-half, half}) {
    scene.AddBox(
        frame, {x - 0.02, -0.25, 0.0}, {x + 0.02, 0.25, height}, shade);
  }
  for (double z = 0.1; z < height; z += 0.4) {
    scene.AddBox(frame, {-half, -0.25, z}, {half, 0.25, z + 0.03}, shade);
    const double from = Uniform(random, -half, half);
    scene.AddBox(frame,
                 {from, -0.2, z},
                 {std::min(half, from + 0.5), 0.2, z + 0.3},
                 Shade(random, 0.2, 0.8));
  }
}

void AddSofa(const Rigid3& frame, Random& random, Scene& scene) {
  const double half = Uniform(random, 0.5, 1.1);
  const float shade = Shade(random, 0.15, 0.5);
  scene.AddBox(frame, {-half, -0.4, 0.05}, {half, 0.4, 0.42}, shade);
  scene.AddBox(frame, {-half, -0.4, 0.4}, {half, -0.22, 0.85}, shade);
}

void AddCrates(const Rigid3& frame, Random& random, Scene& scene) {
  const int num_crates = 1 + static_cast<int>(Uniform(random, 0.0, 3.0));
  for (int i = 0; i < num_crates; ++i) {
    const double half = Uniform(random, 0.2, 0.6);
    scene.AddBox(
        frame *
            Shift(Uniform(random, -0.6, 0.6), Uniform(random, -0.6, 0.6), 0.0) *
            Rigid3{RotationZ(Uniform(random, 0.0, M_PI)), Vector3d::Zero()},
        {-half, -half, 0.0},
        {half, half, Uniform(random, 0.4, 1.6)},
        Shade(random, 0.2, 0.7));
  }
}

void AddPottedPlant(const Rigid3& frame, Random& random, Scene& scene) {
  const double radius = Uniform(random, 0.25, 0.6);
  const double height = Uniform(random, 0.4, 1.0);
  scene.AddCylinder(frame, 0.22, 0.0, 0.45, 0.4f);
  scene.AddFoliage(frame * Shift(0.0, 0.0, 0.5 + height / 2.0),
                   {radius, radius, height / 2.0 + 0.1},
                   static_cast<int>(250.0 * radius),
                   0.1,
                   0.4f,
                   random);
}

void AddStand(const Rigid3& frame, Random& random, Scene& scene) {
  const double half = Uniform(random, 0.3, 0.6);
  const double height = Uniform(random, 1.5, 2.1);
  scene.AddBox(frame, {-0.3, -0.3, 0.0}, {0.3, 0.3, 0.06}, 0.3f);
  scene.AddCylinder(frame, 0.04, 0.0, height, 0.3f);
  scene.AddBox(frame, {-half, 0.04, height - 0.9}, {half, 0.08, height}, 0.8f);
}

void AddCounter(const Rigid3& frame, Random& random, Scene& scene) {
  const double half = Uniform(random, 0.6, 1.5);
  const double height = Uniform(random, 0.9, 1.2);
  const float shade = Shade(random, 0.3, 0.7);
  scene.AddBox(frame, {-half, -0.3, 0.0}, {half, 0.3, height}, shade);
  scene.AddBox(frame,
               {half - 0.5, 0.3, 0.0},
               {half, Uniform(random, 0.5, 0.9), height},
               shade);
}

}  // namespace

void AddFurniture(const Rigid3& world_from_furniture,
                  Random& random,
                  Scene& scene) {
  using Add = void (*)(const Rigid3&, Random&, Scene&);
  constexpr Add kKinds[] = {AddTable,
                            AddTable,
                            AddShelf,
                            AddSofa,
                            AddCrates,
                            AddPottedPlant,
                            AddStand,
                            AddCounter};
  kKinds[random.Below(std::size(kKinds))](world_from_furniture, random, scene);
}

void AddThingAtWall(const Rigid3& world_from_wall,
                    Random& random,
                    Scene& scene) {
  switch (random.Below(5)) {
    case 0: {  // Bench.
      const double half = Uniform(random, 0.5, 1.0);
      scene.AddBox(
          world_from_wall, {-half, 0.05, 0.4}, {half, 0.45, 0.46}, 0.5f);
      for (const double x : {-half + 0.1, half - 0.1}) {
        scene.AddBox(
            world_from_wall, {x, 0.1, 0.0}, {x + 0.06, 0.4, 0.4}, 0.3f);
      }
      return;
    }
    case 1: {  // Bin.
      scene.AddCylinder(world_from_wall * Shift(0.0, 0.25, 0.0),
                        Uniform(random, 0.15, 0.22),
                        0.0,
                        Uniform(random, 0.5, 0.9),
                        0.3f);
      return;
    }
    case 2: {  // Cabinet.
      const double half = Uniform(random, 0.3, 0.8);
      scene.AddBox(
          world_from_wall,
          {-half, 0.0, 0.0},
          {half, Uniform(random, 0.25, 0.5), Uniform(random, 0.8, 1.9)},
          Shade(random, 0.3, 0.7));
      return;
    }
    case 3:
      AddPottedPlant(world_from_wall * Shift(0.0, 0.4, 0.0), random, scene);
      return;
    default:  // Fire extinguisher.
      scene.AddCylinder(
          world_from_wall * Shift(0.0, 0.1, 0.0), 0.08, 0.5, 1.1, 0.5f);
      return;
  }
}

void AddWallFeature(double x,
                    double wall_height,
                    bool with_passages,
                    Random& random,
                    std::vector<WallPatch>& patches) {
  const double door = std::min(2.1, wall_height - 0.2);
  const float shade = Shade(random, 0.3, 0.8);
  const double kind = random.Uniform();
  if (kind < 0.4) {  // Door with its frame.
    const double half = Uniform(random, 0.4, 0.9);
    const double depth = Uniform(random, 0.05, 0.3);
    patches.push_back(
        {x - half - 0.08, x + half + 0.08, 0.0, door + 0.08, 0.03, shade});
    patches.push_back({x - half, x + half, 0.0, door, -depth, shade});
  } else if (kind < 0.55) {  // Window.
    const double half = Uniform(random, 0.4, 1.2);
    const double top = wall_height - 0.4;
    patches.push_back({x - half,
                       x + half,
                       0.9,
                       std::max(1.2, std::min(top, 2.4)),
                       -Uniform(random, 0.1, 0.3),
                       Shade(random, 0.06, 0.2)});
  } else if (kind < 0.7) {  // Pilaster.
    const double half = Uniform(random, 0.15, 0.35);
    patches.push_back({x - half,
                       x + half,
                       0.0,
                       wall_height,
                       Uniform(random, 0.1, 0.35),
                       shade});
  } else if (kind < 0.85) {  // Niche or shop front.
    const double half = Uniform(random, 0.5, 2.2);
    patches.push_back({x - half,
                       x + half,
                       0.0,
                       std::min(wall_height - 0.1, Uniform(random, 2.0, 3.2)),
                       -Uniform(random, 0.3, 1.5),
                       shade});
  } else if (with_passages) {
    const double half = Uniform(random, 0.7, 1.4);
    patches.push_back({x - half,
                       x + half,
                       0.0,
                       std::min(wall_height - 0.1, 2.4),
                       -Uniform(random, 3.0, 9.0),
                       shade});
  } else {  // A box on the wall.
    const double half = Uniform(random, 0.2, 0.6);
    patches.push_back({x - half,
                       x + half,
                       Uniform(random, 0.3, 1.0),
                       Uniform(random, 1.2, 1.8),
                       Uniform(random, 0.1, 0.3),
                       shade});
  }
}

}  // namespace quatro
