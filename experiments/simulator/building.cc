// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/building.h"

#include <algorithm>
#include <cmath>

#include "experiments/simulator/furniture.h"
#include "features/base/rigid3.h"

namespace quatro {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

}  // namespace

Building::Building(uint64_t seed, int num_corridors_x, int num_corridors_y)
    : seed_(seed) {
  Random random(Mix(seed) ^ 9);
  height_ = Uniform(random, 3.0, 4.5);
  for (const auto& [corridors, num] :
       {std::pair(&xs_, num_corridors_x), std::pair(&ys_, num_corridors_y)}) {
    double axis = 0.0;
    for (int i = 0; i < num; ++i) {
      corridors->push_back({axis, Uniform(random, 1.6, 4.0)});
      axis += Uniform(random, 18.0, 34.0);
    }
  }
}

Vector2d Building::Crossing(int i, int j) const {
  return {xs_[static_cast<size_t>(i)].axis, ys_[static_cast<size_t>(j)].axis};
}

// Shops with their fronts facing the surrounding corridors.
void Building::AddBlock(const Vector2d& lower,
                        const Vector2d& upper,
                        Random& random,
                        Scene& scene) const {
  const Vector2d middle = (lower + upper) / 2.0;
  const Vector2d half = (upper - lower) / 2.0;
  for (int i = 0; i < 4; ++i) {
    const double half_length = i % 2 == 0 ? half.x() : half.y();
    const double out = i % 2 == 0 ? half.y() : half.x();
    // The face of the wall is y = 0 and points out of the block.
    const Rigid3 frame =
        Place(middle.x(), middle.y(), i * M_PI / 2.0) * Place(0.0, out, 0.0);
    std::vector<WallPatch> patches;
    for (double x = -half_length + Uniform(random, 1.5, 4.0);
         x < half_length - 2.5;
         x += Uniform(random, 2.5, 7.0)) {
      AddWallFeature(x, height_, false, random, patches);
    }
    scene.AddWall(frame,
                  {-half_length,
                   half_length,
                   0.0,
                   height_,
                   0.0,
                   static_cast<float>(Uniform(random, 0.4, 0.8))},
                  patches);
    for (double x = -half_length + Uniform(random, 1.0, 8.0);
         x < half_length - 1.0;
         x += Uniform(random, 4.0, 15.0)) {
      AddThingAtWall(frame * Place(x, 0.0, 0.0), random, scene);
    }
  }
}

// A hall open to the surrounding corridors.
void Building::AddHall(const Vector2d& lower,
                       const Vector2d& upper,
                       Random& random,
                       Scene& scene) const {
  const double radius = Uniform(random, 0.25, 0.5);
  const double step = Uniform(random, 5.0, 9.0);
  for (double x = lower.x(); x <= upper.x(); x += step) {
    for (double y = lower.y(); y <= upper.y(); y += step) {
      scene.AddCylinder(Place(x, y, 0.0), radius, 0.0, height_, 0.6f);
    }
  }
  const Vector2d size = upper - lower;
  const auto num_things = static_cast<int>(0.04 * size.x() * size.y());
  for (int i = 0; i < num_things; ++i) {
    const double x = Uniform(random, lower.x() + 1.5, upper.x() - 1.5);
    const double y = Uniform(random, lower.y() + 1.5, upper.y() - 1.5);
    AddFurniture(Place(x, y, Uniform(random, -M_PI, M_PI)), random, scene);
  }
}

Scene Building::MakeScene() const {
  constexpr double kOuter = 12.0;  // Beyond the outer walls [m].
  Random random(Mix(seed_) ^ 10);
  Scene scene;
  const double x0 = xs_.front().axis - xs_.front().half_width;
  const double x1 = xs_.back().axis + xs_.back().half_width;
  const double y0 = ys_.front().axis - ys_.front().half_width;
  const double y1 = ys_.back().axis + ys_.back().half_width;
  for (const auto& [z, shade] :
       {std::pair(0.0, 0.35f), std::pair(height_, 0.7f)}) {
    scene.AddQuad({x0 - kOuter, y0 - kOuter, z},
                  {x1 + kOuter, y0 - kOuter, z},
                  {x1 + kOuter, y1 + kOuter, z},
                  {x0 - kOuter, y1 + kOuter, z},
                  shade);
  }
  // The outer walls face inward.
  const Vector2d middle((x0 + x1) / 2.0, (y0 + y1) / 2.0);
  for (int i = 0; i < 4; ++i) {
    const double half = (i % 2 == 0 ? x1 - x0 : y1 - y0) / 2.0;
    const double out = (i % 2 == 0 ? y1 - y0 : x1 - x0) / 2.0;
    std::vector<WallPatch> patches;
    for (double x = -half + Uniform(random, 1.0, 6.0); x < half - 2.5;
         x += Uniform(random, 2.5, 8.0)) {
      AddWallFeature(x, height_, true, random, patches);
    }
    scene.AddWall(
        Place(middle.x(), middle.y(), i * M_PI / 2.0) * Place(0.0, -out, 0.0),
        {-half, half, 0.0, height_, 0.0, 0.6f},
        patches);
  }
  for (size_t i = 0; i + 1 < xs_.size(); ++i) {
    for (size_t j = 0; j + 1 < ys_.size(); ++j) {
      const Vector2d lower(xs_[i].axis + xs_[i].half_width,
                           ys_[j].axis + ys_[j].half_width);
      const Vector2d upper(xs_[i + 1].axis - xs_[i + 1].half_width,
                           ys_[j + 1].axis - ys_[j + 1].half_width);
      if (random.Uniform() < 0.3) {
        AddHall(lower, upper, random, scene);
      } else {
        AddBlock(lower, upper, random, scene);
      }
    }
  }
  return scene;
}

}  // namespace quatro
