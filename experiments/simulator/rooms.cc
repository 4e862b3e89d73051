// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/rooms.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/simulator/furniture.h"
#include "experiments/simulator/street_objects.h"
#include "features/base/random.h"

namespace quatro {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kClear = 2.0;  // Between a sensor and furniture [m].

// Bit for bit its own inverse, as (1) of the header requires.
Rigid3 HalfTurn() {
  return {Vector3d(-1.0, -1.0, 1.0).asDiagonal(), Vector3d::Zero()};
}

bool IsClear(const Vector2d& xy, const std::vector<Vector2d>& places) {
  return std::all_of(places.begin(), places.end(), [&](const Vector2d& place) {
    return (place - xy).norm() > kClear;
  });
}

void AddLevel(double half_length,
              double half_width,
              double z,
              float reflectance,
              Scene& scene) {
  scene.AddQuad({-half_length, -half_width, z},
                {half_length, -half_width, z},
                {half_length, half_width, z},
                {-half_length, half_width, z},
                reflectance);
}

// The i-th wall of a room, counter-clockwise from the one at y = -width / 2.
// Its face is y = 0 and points into the room.
Rigid3 WallFrame(const RoomOptions& room, int i) {
  const double half = (i % 2 == 0 ? room.width : room.length) / 2.0;
  return Rigid3{RotationZ(i * M_PI / 2.0), Vector3d::Zero()} *
         Place(0.0, -half, 0.0);
}

double WallLength(const RoomOptions& room, int i) {
  return i % 2 == 0 ? room.length : room.width;
}

// Copies of `cell` shifted along x by multiples of `period`, within +-half.
std::vector<WallPatch> Repeat(const std::vector<WallPatch>& cell,
                              double period,
                              double half) {
  std::vector<WallPatch> patches;
  const int num_cells = static_cast<int>(half / period);
  for (int i = -num_cells; i <= num_cells; ++i) {
    for (WallPatch patch : cell) {
      patch.left += i * period;
      patch.right += i * period;
      patches.push_back(patch);
    }
  }
  return patches;
}

class CorridorBuilder {
 public:
  explicit CorridorBuilder(const CorridorOptions& options)
      : options_(options),
        half_(options.length / 2.0),
        random_(Mix(options.seed) ^ 1),
        contents_(Mix(options.contents_seed) ^ 2) {}

  Scene Build() {
    const float shade = static_cast<float>(Uniform(random_, 0.4, 0.8));
    AddLevel(half_, options_.width / 2.0 + 12.0, 0.0, 0.3f, scene_);
    if (!options_.is_outdoors) {
      AddLevel(
          half_, options_.width / 2.0 + 12.0, options_.height, 0.7f, scene_);
    }
    for (const int i : {0, 2}) AddSide(i, shade);
    for (const int i : {1, 3}) {
      const double half = options_.width / 2.0;
      if (options_.is_outdoors) break;
      scene_.AddWall(WallFrame(options_, i),
                     {-half, half, 0.0, options_.height, 0.0, shade},
                     {});
    }
    if (!options_.is_outdoors && options_.num_features > 0) AddCeilingLamps();
    return std::move(scene_);
  }

 private:
  // The position along the wall of the i-th of n features.
  double DrawX(int i, int n) {
    const double step = 2.0 * (half_ - 2.0) / n;
    return -half_ + 2.0 + (i + Uniform(random_, 0.1, 0.9)) * step;
  }

  void AddSide(int wall, float shade) {
    const Rigid3 frame = WallFrame(options_, wall);
    std::vector<WallPatch> patches;
    if (options_.period > 0.0) {
      std::vector<WallPatch> cell;
      for (int i = 0; i < 2; ++i) {
        const double x = (i - 0.5 + Uniform(random_, -0.1, 0.1)) / 2.0;
        AddWallFeature(
            x * options_.period, options_.height, false, random_, cell);
      }
      patches = Repeat(cell, options_.period, half_ - options_.period);
    } else {
      const int num_here = (options_.num_features + (wall == 0 ? 1 : 0)) / 2;
      for (int i = 0; i < num_here; ++i)
        AddFeature(frame, i, num_here, patches);
    }
    scene_.AddWall(
        frame, {-half_, half_, 0.0, options_.height, 0.0, shade}, patches);
  }

  void AddFeature(const Rigid3& frame,
                  int i,
                  int n,
                  std::vector<WallPatch>& patches) {
    const double x = DrawX(i, n);
    if (Uniform(random_, 0.0, 1.0) < 0.65) {
      AddWallFeature(
          x, options_.height, !options_.is_outdoors, random_, patches);
    } else if (!options_.is_outdoors) {
      AddThingAtWall(frame * Place(x, 0.0, 0.0), contents_, scene_);
    } else if (contents_.Uniform() < 0.5) {
      scene_.AddCylinder(frame * Place(x, 0.5, 0.0), 0.08, 0.0, 7.0, 0.5f);
    } else {
      AddCar(frame * Place(x, 1.2, 0.0), 4.2, contents_, scene_);
    }
  }

  void AddCeilingLamps() {
    const double top = options_.height;
    const double step =
        options_.period > 0.0 ? options_.period : Uniform(random_, 2.5, 5.0);
    const int num_lamps = static_cast<int>(half_ / step - 0.5);
    for (int i = -num_lamps; i <= num_lamps; ++i) {
      scene_.AddBox(Place(i * step, 0.0, 0.0),
                    {-0.6, -0.15, top - 0.07},
                    {0.6, 0.15, top},
                    0.8f);
    }
  }

  const CorridorOptions& options_;
  const double half_;
  Random random_, contents_;
  Scene scene_;
};

// With a half turn, builds only one half of the hall; Build() adds the other.
class HallBuilder {
 public:
  explicit HallBuilder(const HallOptions& options)
      : options_(options),
        random_(Mix(options.seed) ^ 3),
        contents_(Mix(options.contents_seed) ^ 4) {
    for (const Vector2d& place : options.places) {
      places_.push_back(place);
      if (options.has_half_turn) places_.emplace_back(-place);
    }
  }

  Scene Build() {
    constexpr double kPassages = 12.0;  // More than the deepest recess [m].
    Scene whole;
    for (const auto& [z, shade] :
         {std::pair(0.0, 0.35f), std::pair(options_.height, 0.7f)}) {
      AddLevel(options_.length / 2.0 + kPassages,
               options_.width / 2.0 + kPassages,
               z,
               shade,
               whole);
    }
    for (int i = 0; i < (options_.has_half_turn ? 2 : 4); ++i) AddWallOf(i);
    AddPillars();
    AddPartitions();
    AddContents();
    whole.Append(scene_, Rigid3());
    if (options_.has_half_turn) whole.Append(scene_, HalfTurn());
    return whole;
  }

 private:
  // True for exactly one of two points that the half turn swaps.
  bool IsMine(double x, double y) const {
    return !options_.has_half_turn || x > 0.0 || (x == 0.0 && y > 0.0);
  }

  void AddWallOf(int i) {
    const double half = WallLength(options_, i) / 2.0;
    std::vector<WallPatch> patches;
    for (double x = -half + Uniform(random_, 1.0, 5.0); x < half - 2.5;
         x += Uniform(random_, 2.0, 8.0)) {
      AddWallFeature(x, options_.height, true, random_, patches);
    }
    scene_.AddWall(WallFrame(options_, i),
                   {-half, half, 0.0, options_.height, 0.0, 0.6f},
                   patches);
  }

  void AddPillars() {
    const double step_x = Uniform(random_, 5.0, 10.0);
    const double step_y = Uniform(random_, 5.0, 10.0);
    const double radius = Uniform(random_, 0.2, 0.45);
    const bool are_round = random_.Uniform() < 0.5;
    const auto num_x = static_cast<int>((options_.length / 2.0 - 1.0) / step_x);
    const auto num_y = static_cast<int>((options_.width / 2.0 - 1.0) / step_y);
    for (int i = -num_x; i <= num_x; ++i) {
      for (int j = -num_y; j <= num_y; ++j) {
        const Vector2d xy(i * step_x, j * step_y);
        const bool is_there = random_.Uniform() < 0.85;
        if (!is_there || !IsMine(xy.x(), xy.y()) || !IsClear(xy, places_)) {
          continue;
        }
        const Rigid3 frame = Place(xy.x(), xy.y(), 0.0);
        if (are_round) {
          scene_.AddCylinder(frame, radius, 0.0, options_.height, 0.6f);
        } else {
          scene_.AddBox(frame,
                        {-radius, -radius, 0.0},
                        {radius, radius, options_.height},
                        0.6f);
        }
      }
    }
  }

  // Free-standing walls along x or y.
  void AddPartitions() {
    const auto num_partitions = static_cast<int>(
        Uniform(random_, 0.0, options_.has_half_turn ? 2.0 : 4.0));
    for (int i = 0; i < num_partitions; ++i) {
      const double x = Uniform(random_, -0.4, 0.4) * options_.length;
      const double y = Uniform(random_, -0.4, 0.4) * options_.width;
      const double half = Uniform(random_, 1.0, 0.15 * options_.width + 1.0);
      const bool along_x = random_.Uniform() < 0.5;
      const double height =
          std::min(options_.height, Uniform(random_, 1.2, 5.0));
      const Rigid3 frame = Place(x, y, along_x ? 0.0 : M_PI / 2.0);
      bool is_clear = true;
      for (double t = -half; t <= half; t += 0.5) {
        const Vector3d point = frame * Vector3d(t, 0.0, 0.0);
        is_clear = is_clear && IsClear(point.head<2>(), places_);
      }
      if (!is_clear) continue;
      scene_.AddBox(frame, {-half, -0.08, 0.0}, {half, 0.08, height}, 0.55f);
    }
  }

  void AddContents() {
    const double density = Uniform(contents_, 0.01, 0.05);  // [1/m^2]
    const auto num_things =
        static_cast<int>(density * options_.length * options_.width *
                         (options_.has_half_turn ? 0.5 : 1.0));
    for (int i = 0; i < num_things; ++i) {
      const double x = Uniform(contents_, -0.5, 0.5) * (options_.length - 4.0);
      const double y = Uniform(contents_, -0.5, 0.5) * (options_.width - 4.0);
      const double yaw = Uniform(contents_, -M_PI, M_PI);
      if (!IsClear({x, y}, places_)) continue;
      AddFurniture(Place(x, y, yaw), contents_, scene_);
    }
    for (int i = 0; i < (options_.has_half_turn ? 2 : 4); ++i) {
      const double half = WallLength(options_, i) / 2.0;
      for (double x = -half + Uniform(contents_, 1.0, 8.0); x < half - 1.0;
           x += Uniform(contents_, 2.0, 12.0)) {
        AddThingAtWall(
            WallFrame(options_, i) * Place(x, 0.0, 0.0), contents_, scene_);
      }
    }
  }

  const HallOptions& options_;
  Random random_, contents_;
  std::vector<Vector2d> places_;
  Scene scene_;
};

}  // namespace

Scene MakeCorridor(const CorridorOptions& options) {
  return CorridorBuilder(options).Build();
}

Scene MakeHall(const HallOptions& options) {
  return HallBuilder(options).Build();
}

Scene MakeRoom(const RoomOptions& options) {
  constexpr double kFromWall = 0.6;  // Of the middle of furniture [m].
  Random random(Mix(options.seed) ^ 7);
  Random contents(Mix(options.contents_seed) ^ 8);
  Scene scene;
  AddLevel(options.length, options.width, 0.0, 0.4f, scene);
  AddLevel(options.length, options.width, options.height, 0.7f, scene);
  for (int i = 0; i < 4; ++i) {
    const double half = WallLength(options, i) / 2.0;
    std::vector<WallPatch> patches;
    for (double x = -half + Uniform(random, 1.0, 1.5); x < half - 1.0;
         x += Uniform(random, 1.5, 3.0)) {
      AddWallFeature(x, options.height, false, random, patches);
    }
    const Rigid3 frame = WallFrame(options, i);
    scene.AddWall(frame,
                  {-half,
                   half,
                   0.0,
                   options.height,
                   0.0,
                   static_cast<float>(Uniform(random, 0.4, 0.8))},
                  patches);
    for (double x = -half + Uniform(contents, 0.5, 1.5); x < half - 0.5;
         x += Uniform(contents, 0.8, 2.0)) {
      if (contents.Uniform() < 0.4) {
        AddThingAtWall(frame * Place(x, 0.0, 0.0), contents, scene);
      } else {
        const double yaw = Uniform(contents, -0.3, 0.3);
        AddFurniture(frame * Place(x, kFromWall, yaw), contents, scene);
      }
    }
  }
  return scene;
}

Scene MakeColonnade(uint64_t seed,
                    double height,
                    const Eigen::Vector2d& spacing) {
  constexpr double kHalf = 130.0;  // [m]
  Random random(Mix(seed) ^ 5);
  const double radius = Uniform(random, 0.2, 0.5);
  const double beam = Uniform(random, 0.1, 0.4);
  Scene scene;
  AddLevel(kHalf, kHalf, 0.0, 0.3f, scene);
  AddLevel(kHalf, kHalf, height, 0.6f, scene);
  const auto num_x = static_cast<int>(kHalf / spacing.x());
  const auto num_y = static_cast<int>(kHalf / spacing.y());
  for (int i = -num_x; i <= num_x; ++i) {
    const double x = i * spacing.x();
    scene.AddBox(Rigid3(),
                 {x - 0.15, -kHalf, height - beam},
                 {x + 0.15, kHalf, height},
                 0.5f);
    for (int j = -num_y; j <= num_y; ++j) {
      scene.AddBox(Place(x, j * spacing.y(), 0.0),
                   {-radius, -radius, 0.0},
                   {radius, radius, height},
                   0.6f);
    }
  }
  return scene;
}

Scene MakeTerrace(uint64_t seed, double period) {
  constexpr double kHalf = 180.0;  // [m]
  Random random(Mix(seed) ^ 6);
  const double setback = Uniform(random, 6.5, 12.0);
  const double gap = random.Uniform() < 0.5 ? 0.0 : Uniform(random, 1.0, 3.0);
  const bool has_trees = random.Uniform() < 0.5;
  const bool has_lamps = random.Uniform() < 0.5;
  const double depth = Uniform(random, 8.0, 12.0);
  const Random of_house(random.Next()), of_tree(random.Next());
  Scene cell;  // One house, its front toward -y.
  Random house = of_house, tree = of_tree;
  AddHouse(Place(0.0, setback, M_PI), period - gap, depth, house, cell);
  if (has_trees) AddTree(Place(period / 2.0, 5.5, 0.0), tree, cell);
  if (has_lamps) {
    cell.AddCylinder(Place(period / 4.0, 5.0, 0.0), 0.08, -0.2, 7.0, 0.5f);
  }
  cell.AddBox(Rigid3(),
              {-period / 2.0, 4.5, -0.3},
              {period / 2.0, setback + depth, 0.12},
              0.35f);
  Scene scene;
  AddLevel(kHalf, 60.0, 0.0, 0.25f, scene);
  const auto num_cells = static_cast<int>(kHalf / period);
  for (int i = -num_cells; i <= num_cells; ++i) {
    const Rigid3 shift = Place(i * period, 0.0, 0.0);
    scene.Append(cell, shift);
    scene.Append(cell, HalfTurn() * shift);
  }
  return scene;
}

void AddOddThings(int num_things,
                  const std::vector<Vector2d>& places,
                  double max_y,
                  Random& random,
                  Scene& scene) {
  for (int i = 0; i < num_things;) {
    const Vector2d xy(Uniform(random, -25.0, 25.0),
                      Uniform(random, -1.0, 1.0) * max_y);
    if (!IsClear(xy, places)) continue;
    AddFurniture(
        Place(xy.x(), xy.y(), Uniform(random, -M_PI, M_PI)), random, scene);
    ++i;
  }
}

}  // namespace quatro
