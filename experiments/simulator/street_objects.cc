// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/street_objects.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace quatro {
namespace {

using Eigen::Vector3d;

constexpr double kStorey = 2.9;  // [m]
constexpr double kCellar = 5.0;  // Depth of a house below ground [m].

bool Chance(Random& random, double probability) {
  return random.Uniform() < probability;
}

using Patches = std::vector<WallPatch>;

void AddDoor(
    double x, double width, double floor, Random& random, Patches& patches) {
  const float shade = Shade(random, 0.3, 0.8);
  const double depth = Uniform(random, 0.15, 0.6);
  const double canopy = Uniform(random, 0.3, 1.1);
  patches.push_back({x, x + width, floor + 0.1, floor + 2.15, -depth, shade});
  patches.push_back(
      {x - 0.3, x + width + 0.3, floor + 2.3, floor + 2.42, canopy, shade});
}

void AddGarage(
    double x, double width, double floor, Random& random, Patches& patches) {
  const float shade = Shade(random, 0.3, 0.8);
  const double depth = Uniform(random, 0.2, 0.9);
  patches.push_back({x, x + width, floor - 0.3, floor + 2.1, -depth, shade});
}

void AddBay(
    double x, double width, double floor, Random& random, Patches& patches) {
  const float shade = Shade(random, 0.3, 0.8);
  const double out = Uniform(random, 0.4, 0.9);
  patches.push_back({x, x + width, floor - 1.0, floor + 2.6, out, shade});
  patches.push_back({x + 0.25,
                     x + width - 0.25,
                     floor + 0.9,
                     floor + 2.2,
                     out - 0.1,
                     Shade(random, 0.06, 0.2)});
}

void AddWindow(double x,
               double width,
               double floor,
               double recess,
               Random& random,
               Patches& patches) {
  const double sill = floor + Uniform(random, 0.8, 1.0);
  const float glass = Shade(random, 0.06, 0.2);
  patches.push_back({x, x + width, sill, sill + 1.35, -recess, glass});
  patches.push_back(
      {x - 0.08, x + width + 0.08, sill - 0.07, sill, 0.08, 0.6f});
}

void AddBalcony(
    double x, double width, double floor, Random& random, Patches& patches) {
  const double out = Uniform(random, 0.8, 1.3);
  patches.push_back({x - 0.5, x + width + 0.5, floor, floor + 0.95, out, 0.5f});
}

// The openings of one story, from left to right over a wall of the given width.
void AddOpenings(double wall_width,
                 double floor,
                 bool is_ground_floor,
                 double recess,
                 Random& random,
                 Patches& patches) {
  const double right = wall_width / 2.0;
  double x = -right + Uniform(random, 0.5, 1.4);
  while (x < right - 1.6) {
    const double room = right - 0.4 - x;
    const double kind = is_ground_floor ? random.Uniform() : 1.0;
    double width = Uniform(random, 0.9, 1.5);
    if (kind < 0.2) {
      AddDoor(x, width, floor, random, patches);
    } else if (kind < 0.3 && room > 2.6) {
      width = 2.5;
      AddGarage(x, width, floor, random, patches);
    } else if (kind < 0.4 && room > 2.8) {
      width = Uniform(random, 1.8, 2.6);
      AddBay(x, width, floor, random, patches);
    } else {
      if (room > 2.4 && Chance(random, 0.25)) width *= 1.6;
      AddWindow(x, width, floor, recess, random, patches);
      if (!is_ground_floor && Chance(random, 0.2)) {
        AddBalcony(x, width, floor, random, patches);
      }
    }
    x += width + Uniform(random, 0.7, 2.2);
  }
}

struct Walls {
  double height;  // [m]
  double floor;   // Floor of the first story [m].
  float reflectance;
};

void AddFacade(const Rigid3& world_from_facade,
               double width,
               const Walls& walls,
               bool has_openings,
               Random& random,
               Scene& scene) {
  const double left = -width / 2.0, right = width / 2.0;
  const float shade = walls.reflectance;
  if (!has_openings) {
    scene.AddWall(world_from_facade,
                  {left, right, -kCellar, walls.height, 0.0, shade},
                  {});
    return;
  }
  const double recess = Uniform(random, 0.1, 0.3);
  const double plinth = Uniform(random, 0.0, 0.1);
  for (double z = walls.floor; z < walls.height; z += kStorey) {
    const bool is_ground_floor = z == walls.floor;
    const double bottom = is_ground_floor ? -kCellar : z;
    Patches patches;
    if (is_ground_floor) {
      patches.push_back({left, right, bottom, z + 0.3, plinth, shade});
    }
    if (z + kStorey <= walls.height) {  // Otherwise the roof rests here.
      AddOpenings(width, z, is_ground_floor, recess, random, patches);
    }
    const double top = std::min(z + kStorey, walls.height);
    scene.AddWall(
        world_from_facade, {left, right, bottom, top, 0.0, shade}, patches);
  }
}

void AddDoorstep(const Rigid3& world_from_house,
                 double width,
                 double floor,
                 Random& random,
                 Scene& scene) {
  double x = Uniform(random, -0.4, 0.2) * width;
  for (int i = 1; i <= 3; ++i) {
    scene.AddBox(world_from_house,
                 {x, 0.0, -1.0},
                 {x + 1.3, 0.3 * i, floor * (4 - i) / 4.0},
                 0.4f);
  }
  const int num_bins = static_cast<int>(Uniform(random, 0.0, 4.0));
  for (int i = 0; i < num_bins; ++i) {
    x += Uniform(random, 1.5, 3.0);
    if (x > width / 2.0 - 0.8) break;
    const double behind = Uniform(random, 0.1, 0.5);
    const double height = Uniform(random, 0.8, 1.2);
    scene.AddBox(
        world_from_house, {x, behind, -0.5}, {x + 0.6, 1.1, height}, 0.2f);
  }
}

}  // namespace

void AddHouse(const Rigid3& world_from_house,
              double width,
              double depth,
              Random& random,
              Scene& scene) {
  const int num_storeys = 1 + static_cast<int>(Uniform(random, 0.6, 3.6));
  Walls walls;
  walls.floor = Uniform(random, 0.0, 0.7);
  walls.height = walls.floor + kStorey * num_storeys + 0.4;
  walls.reflectance = Shade(random, 0.3, 0.75);
  const Rigid3 house_from_middle = Shift(0.0, -depth / 2.0, 0.0);
  for (int i = 0; i < 4; ++i) {  // Front, sides, back.
    const bool is_side = i % 2 == 1;
    const Rigid3 house_from_facade =
        house_from_middle * Turned(i * M_PI / 2.0) *
        Shift(0.0, (is_side ? width : depth) / 2.0, 0.0);
    const bool has_openings = i == 0 || (is_side && Chance(random, 0.5));
    AddFacade(world_from_house * house_from_facade,
              is_side ? depth : width,
              walls,
              has_openings,
              random,
              scene);
  }
  // The ridge runs along the street; eaves reach over the front.
  const double eaves = Uniform(random, 0.2, 0.6);
  const double ridge = Uniform(random, 0.3, 4.0);
  scene.AddPrism(world_from_house * Turned(M_PI / 2.0),
                 {{eaves, walls.height},
                  {-depth - eaves, walls.height},
                  {-depth / 2.0, walls.height + ridge}},
                 -width / 2.0,
                 width / 2.0,
                 0.3f);
  scene.AddCylinder(world_from_house * Shift(width / 2.0 - 0.2, 0.1, 0.0),
                    0.05,
                    -1.0,
                    walls.height,
                    0.5f);
  AddDoorstep(world_from_house, width, walls.floor, random, scene);
}

void AddShed(const Rigid3& world_from_shed, Random& random, Scene& scene) {
  const double width = Uniform(random, 2.0, 4.0);
  const double height = Uniform(random, 1.9, 2.5);
  const double depth = Uniform(random, 2.0, 5.0);
  scene.AddPrism(world_from_shed,
                 {{-width / 2.0, -2.0},
                  {width / 2.0, -2.0},
                  {width / 2.0, height},
                  {0.0, height + 0.6},
                  {-width / 2.0, height}},
                 -depth,
                 0.0,
                 Shade(random, 0.3, 0.6));
}

void AddBush(const Rigid3& world_from_bush, Random& random, Scene& scene) {
  const double radius = Uniform(random, 0.4, 1.2);
  const double across = radius * Uniform(random, 0.7, 1.3);
  const double height = Uniform(random, 0.4, 1.2);
  const float shade = Shade(random, 0.3, 0.5);
  scene.AddFoliage(world_from_bush * Shift(0.0, 0.0, 0.8 * height),
                   {radius, across, height},
                   static_cast<int>(300.0 * radius * (radius + height)),
                   0.14,
                   shade,
                   random);
}

void AddTree(const Rigid3& world_from_tree, Random& random, Scene& scene) {
  const double trunk = Uniform(random, 0.08, 0.25);
  const double crown = Uniform(random, 1.2, 3.0);
  const double base = Uniform(random, 0.8, 2.8);  // Base of the crown.
  const float shade = Shade(random, 0.3, 0.5);
  scene.AddCylinder(world_from_tree, trunk, -1.0, base + crown, 0.35f);
  scene.AddFoliage(world_from_tree * Shift(0.0, 0.0, base + 1.1 * crown),
                   {crown, crown, 1.2 * crown},
                   static_cast<int>(280.0 * crown * crown),
                   0.22,
                   shade,
                   random);
}

void AddCar(const Rigid3& world_from_car,
            double length,
            Random& random,
            Scene& scene) {
  const bool is_van = Chance(random, 0.15);
  const double half = length / 2.0;
  const double side = Uniform(random, 0.82, 0.92);
  const double belt = Uniform(random, 0.8, 0.95);
  const double roof =
      is_van ? Uniform(random, 1.8, 2.1) : Uniform(random, 1.38, 1.6);
  const double rear = is_van ? 0.15 : Uniform(random, 0.4, 1.1);
  const double front = is_van ? 0.7 : 1.1;
  const double axle = half - 0.85, well = 0.36;
  const float paint = Shade(random, 0.15, 0.7);

  for (const auto& [from, to] : {std::pair(-half, -axle - well),
                                 std::pair(-axle + well, axle - well),
                                 std::pair(axle + well, half)}) {
    scene.AddBox(world_from_car, {from, -side, 0.2}, {to, side, 0.62}, paint);
  }
  scene.AddPrism(world_from_car,
                 {{-half + 0.08, 0.6},
                  {half, 0.6},
                  {half - 0.15, belt - 0.12},
                  {half - 1.1, belt},
                  {-half + 0.03, belt}},
                 -side,
                 side,
                 paint);
  scene.AddPrism(world_from_car,
                 {{-half + 0.1, belt},
                  {half - front, belt},
                  {half - front - 0.75, roof},
                  {-half + rear, roof}},
                 -side + 0.12,
                 side - 0.12,
                 is_van ? paint : 0.2f);
  const Eigen::Matrix3d sideways =
      Eigen::AngleAxisd(M_PI / 2.0, Vector3d::UnitX()).toRotationMatrix();
  for (const double x : {-axle, axle}) {
    for (const double y : {-side + 0.14, side - 0.14}) {
      const Rigid3 car_from_wheel = {sideways, Vector3d(x, y, 0.31)};
      scene.AddCylinder(
          world_from_car * car_from_wheel, 0.31, -0.1, 0.1, 0.12f);
    }
  }
}

Border DrawBorder(Random& random) {
  const double kind = random.Uniform();
  Border border;
  border.kind = kind < 0.2    ? Border::kNone
                : kind < 0.35 ? Border::kWall
                : kind < 0.55 ? Border::kPickets
                              : Border::kHedge;
  border.height = border.kind == Border::kHedge ? Uniform(random, 0.5, 1.6)
                                                : Uniform(random, 0.4, 1.2);
  border.piece = border.kind == Border::kPickets ? 0.16 : 0.8;
  border.reflectance = Shade(random, 0.3, 0.6);
  return border;
}

void AddBorderPiece(const Rigid3& world_from_piece,
                    const Border& border,
                    int index,
                    Random& random,
                    Scene& scene) {
  const double height = border.height;
  const double half = border.piece / 2.0 + 0.01;
  switch (border.kind) {
    case Border::kNone:
      return;
    case Border::kPickets: {
      const bool is_post = index % 12 == 0;
      scene.AddBox(world_from_piece,
                   {-0.04, is_post ? -0.1 : 0.0, -0.3},
                   {0.04, 0.03, is_post ? height + 0.1 : height},
                   border.reflectance);
      return;
    }
    case Border::kWall: {
      const double post = index % 4 == 0 ? 0.15 : 0.0;
      scene.AddBox(world_from_piece,
                   {-half, -0.12 - post / 2.0, -0.5},
                   {half, 0.12 + post / 2.0, height + post},
                   border.reflectance);
      return;
    }
    case Border::kHedge:
      scene.AddBox(world_from_piece,
                   {-half, -0.2, -0.3},
                   {half, 0.2, height - 0.25},
                   border.reflectance);
      scene.AddFoliage(world_from_piece * Shift(0.0, 0.0, height / 2.0),
                       {half + 0.25, 0.5, height / 2.0 + 0.15},
                       static_cast<int>(110.0 * height),
                       0.12,
                       border.reflectance,
                       random);
      return;
  }
}

}  // namespace quatro
