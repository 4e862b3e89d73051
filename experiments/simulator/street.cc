// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/street.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "experiments/simulator/street_objects.h"
#include "features/base/random.h"

namespace quatro {
namespace {

using Eigen::Vector3d;

// Builds the street. Sides are +1 (left) and -1; e = |d| is a distance from the
// axis. All functions draw from one random generator, so their order affects
// the street.
class StreetBuilder {
 public:
  StreetBuilder(const StreetAxis& road, const StreetSides& sides, uint64_t seed)
      : road_(road),
        sides_(sides),
        length_(road.length()),
        kerb_(road.half_width()),
        garden_(kerb_ + Road::kPavementWidth + 0.2),
        random_(2 * seed + 1) {}

  Scene Build() {
    AddGround();
    AddSides();
    for (const SideStreet& street : road_.side_streets()) AddSideStreet(street);
    return std::move(scene_);
  }

  Scene BuildSides() {
    AddSides();
    return std::move(scene_);
  }

 private:
  void AddSides() {
    for (const int side : {1, -1}) {
      AddLots(side);
      AddParkedCars(side);
      AddStreetFurniture(side);
      AddStreetTrees(side);
      AddBackdrop(side);
    }
  }

  double Draw(double lower, double upper) {
    return Uniform(random_, lower, upper);
  }
  bool Chance(double probability) { return random_.Uniform() < probability; }

  // A frame on the ground whose y axis points toward the axis of the street.
  Rigid3 Facing(double s, double e, int side) const {
    return road_.WorldFromUpright(s, side * e) * Turned(side > 0 ? M_PI : 0.0);
  }

  void AddGround() {
    std::vector<double> ss, ds;
    for (double s = 0.0; s <= length_; s += 0.5) ss.push_back(s);
    for (double e = sides_.reach; e > 14.0; e -= 1.5) ds.push_back(-e);
    for (double e = 14.0; e > kerb_ + 2.0; e -= 0.4) ds.push_back(-e);
    for (const double e : {2.0, 1.6, 1.0, 0.5, 0.03, 0.0, -0.7, -1.8, -2.9}) {
      ds.push_back(-kerb_ - e);
    }
    const std::vector<double> right = ds;
    ds.push_back(0.0);
    for (auto d = right.rbegin(); d != right.rend(); ++d) ds.push_back(-*d);

    const auto is_garden = [&](double s, double d) {
      return std::abs(d) > garden_ - 0.1 &&
             !road_.IsInSideStreet(s, d > 0.0 ? 1 : -1, 0.0);
    };
    scene_.AddSurface(
        ss,
        ds,
        [&](double s, double d) -> Vector3d {
          const double tuft = is_garden(s, d) ? Draw(-0.04, 0.06) : 0.0;
          return road_.SurfacePoint(s, d) + Vector3d(0.0, 0.0, tuft);
        },
        [&](double s, double d) {
          if (is_garden(s, d)) return static_cast<float>(Draw(0.25, 0.45));
          return std::abs(d) < kerb_ ? 0.25f : 0.35f;
        });
  }

  // A border from (s0, e0) to (s1, e1).
  void AddBorder(const Border& border,
                 double s0,
                 double e0,
                 double s1,
                 double e1,
                 int side) {
    const double along = s1 - s0, outward = e1 - e0;
    const auto num_pieces =
        static_cast<int>(std::hypot(along, outward) / border.piece);
    const double yaw = -side * std::atan2(outward, along);
    for (int i = 0; i < num_pieces; ++i) {
      const double t = (i + 0.5) / num_pieces;
      AddBorderPiece(
          Facing(s0 + t * along, e0 + t * outward, side) * Turned(yaw),
          border,
          i,
          random_,
          scene_);
    }
  }

  void AddPlant(double s, double e, int side, double tree_probability) {
    const Rigid3 frame = Facing(s, e, side);
    if (Chance(tree_probability)) {
      AddTree(frame, random_, scene_);
    } else {
      AddBush(frame, random_, scene_);
    }
  }

  void AddFrontGarden(double s0, double s1, double setback, int side) {
    const double depth = setback - garden_;
    if (depth < 1.0) return;
    const Border border = DrawBorder(random_);
    const double gate = Draw(s0 + 1.0, s1 - 3.5);
    const double past_gate = gate + Draw(1.0, 3.0);
    AddBorder(border, s0, garden_, gate, garden_, side);
    AddBorder(border, past_gate, garden_, s1, garden_, side);
    if (Chance(0.5)) {
      AddBorder(DrawBorder(random_), s0, garden_, s0, setback, side);
    }
    const auto num_plants =
        static_cast<int>(Draw(0.0, sides_.plants) * (s1 - s0));
    for (int i = 0; i < num_plants; ++i) {
      const double s = Draw(s0, s1);
      const double e = garden_ + Draw(0.3, 0.9) * depth;
      AddPlant(s, e, side, depth > 2.5 ? 0.25 : 0.0);
    }
  }

  // Fills the gap between two houses.
  void AddGap(double s0, double s1, double setback, int side) {
    const double middle = (s0 + s1) / 2.0;
    const double e = setback + Draw(0.3, 5.0);
    const double kind = random_.Uniform();
    if (kind < 0.25 && s1 - s0 > 2.5) {
      AddShed(Facing(middle, e, side), random_, scene_);
    } else if (kind < 0.65) {
      AddBorder(DrawBorder(random_), s0, e, s1, e, side);
    }
    if (Chance(0.5)) AddPlant(middle, e + Draw(1.0, 8.0), side, 0.3);
  }

  void AddPark(double s0, double s1, int side) {
    AddBorder(DrawBorder(random_), s0, garden_, s1, garden_, side);
    for (double s = s0; s < s1; s += Draw(0.7, 2.0)) {
      AddPlant(s, garden_ + Draw(1.0, 16.0), side, 0.35);
    }
  }

  // A block from s to `end` without gaps.
  void AddBlock(double s, double end, int side) {
    const bool is_terrace = Chance(sides_.terrace);
    const double usual_setback =
        kerb_ + Draw(2.0, (is_terrace ? 6.0 : 7.5) + sides_.deeper);
    while (end - s > 7.0) {
      const double wish = is_terrace ? Draw(7.0, 13.0) : Draw(8.0, 14.0);
      const double width = std::min(wish, end - s);
      double gap = Draw(3.0, sides_.gap);
      if (is_terrace) gap = Chance(0.2) ? gap / 2.0 : 0.0;
      if (Chance(sides_.park)) {
        AddPark(s, s + width, side);
      } else {
        const double setback =
            std::min(usual_setback + Draw(-0.5, 1.0), 12.0 + sides_.deeper);
        const double depth = Draw(8.0, 12.0);
        AddHouse(Facing(s + width / 2.0, setback, side),
                 width,
                 depth,
                 random_,
                 scene_);
        AddFrontGarden(s, s + width, setback, side);
        AddGap(s + width, std::min(s + width + gap, end), setback, side);
      }
      s += width + gap;
    }
    if (end - s > 2.0) AddPark(s, end, side);
  }

  void AddLots(int side) {
    double s = 0.0;
    for (const SideStreet& street : road_.side_streets()) {
      if (street.side != side) continue;
      AddBlock(s, street.s - street.width / 2.0 - sides_.corner, side);
      s = street.s + street.width / 2.0 + sides_.corner;
    }
    AddBlock(s, length_, side);
  }

  void AddParkedCars(int side) {
    const double density = Draw(0.15, 0.6);
    double s = Draw(0.0, 8.0);
    while (s < length_) {
      const double length = Draw(3.6, 4.8);
      const double middle = s + length / 2.0;
      if (Chance(density) && !road_.IsInSideStreet(middle, side, 6.0)) {
        const double d = side * (kerb_ - Draw(0.75, 1.05));
        const double yaw = Draw(-0.03, 0.03) + (side > 0 ? M_PI : 0.0);
        AddCar(road_.WorldFromGround(middle, d, yaw), length, random_, scene_);
        s += length + Draw(0.6, 2.0);
      } else {
        s += Draw(4.0, 12.0);
      }
    }
  }

  void AddStreetFurniture(int side) {
    const double edge = kerb_ + 0.35;
    const auto is_taken = [&](double s) {
      return sides_.clear_mouths && road_.IsInSideStreet(s, side, 1.0);
    };
    for (double s = Draw(3.0, 25.0); s < length_; s += Draw(24.0, 34.0)) {
      if (is_taken(s)) continue;
      scene_.AddCylinder(Facing(s, edge, side), 0.08, -0.5, 7.0, 0.5f);
    }
    for (double s = Draw(3.0, 25.0); s < length_; s += Draw(12.0, 40.0)) {
      if (is_taken(s)) continue;
      const Rigid3 sign = Facing(s, edge, side) * Turned(M_PI / 2.0);
      scene_.AddCylinder(sign, 0.035, -0.5, 2.7, 0.6f);
      scene_.AddBox(sign, {-0.3, 0.03, 2.1}, {0.3, 0.05, 2.7}, 0.95f);
    }
    for (double s = Draw(3.0, 25.0); s < length_; s += Draw(20.0, 50.0)) {
      const double half = Draw(0.4, 1.2), height = Draw(0.9, 1.6);
      if (is_taken(s)) continue;
      scene_.AddBox(Facing(s, garden_ - 0.2, side),
                    {-half, -0.35, -0.5},
                    {half, 0.0, height},
                    0.4f);
    }
  }

  void AddStreetTrees(int side) {
    if (Chance(0.5)) return;
    for (double s = Draw(3.0, 15.0); s < length_; s += Draw(7.0, 16.0)) {
      if (road_.IsInSideStreet(s, side, 2.0)) continue;
      AddTree(Facing(s, kerb_ + 0.65, side), random_, scene_);
    }
  }

  void AddBackdrop(int side) {
    for (double s = 0.0; s < length_; s += Draw(1.0, 3.0)) {
      const double e = Draw(kerb_ + 16.0, sides_.reach - 4.0);
      const double yaw = Draw(-0.3, 0.3);
      const double kind = random_.Uniform();
      if (road_.IsInSideStreet(s, side, 4.0)) continue;
      if (kind < 0.85) {
        AddPlant(s, e, side, 0.4);
      } else if (kind < 0.93) {
        AddShed(Facing(s, e, side) * Turned(yaw), random_, scene_);
      } else if (!road_.IsInSideStreet(s, side, 12.0)) {
        const double width = Draw(8.0, 12.0);
        AddHouse(Facing(s, e, side) * Turned(yaw), width, 8.0, random_, scene_);
      }
    }
  }

  void AddSideStreet(const SideStreet& street) {
    for (const int edge : {1, -1}) {
      const double kerb = street.s + edge * street.width / 2.0;
      const double fence = kerb + edge * 1.7;
      AddBorder(DrawBorder(random_),
                fence,
                garden_ + 1.0,
                fence,
                kerb_ + 20.0,
                street.side);
      for (double e = kerb_ + 21.0; e < sides_.reach - 8.0;) {
        const double width = Draw(8.0, 13.0);
        const double setback = Draw(2.5, 5.0);
        AddHouse(road_.WorldFromUpright(kerb + edge * setback,
                                        street.side * (e + width / 2.0)) *
                     Turned(edge * M_PI / 2.0),
                 width,
                 8.0,
                 random_,
                 scene_);
        e += width + Draw(0.0, 5.0);
      }
      for (double e = kerb_ + 12.0; e < sides_.reach - 4.0;
           e += Draw(5.5, 14.0)) {
        const double length = Draw(3.6, 4.8);
        if (Chance(0.4)) continue;
        AddCar(road_.WorldFromGround(
                   kerb - edge, street.side * e, edge * M_PI / 2.0),
               length,
               random_,
               scene_);
      }
    }
    for (int i = 0; i < 8; ++i) {  // The end of the side street.
      const double s = street.s + Draw(-0.5, 0.5) * street.width;
      AddPlant(s, sides_.reach - Draw(1.0, 4.0), street.side, 0.2);
    }
  }

  const StreetAxis& road_;
  const StreetSides sides_;
  const double length_, kerb_;
  const double garden_;  // Distance at which gardens start [m].
  Random random_;
  Scene scene_;
};

}  // namespace

Scene MakeStreet(const Road& road) {
  return StreetBuilder(road, StreetSides(), road.options().seed).Build();
}

void AddStreetSides(const StreetAxis& street,
                    const StreetSides& sides,
                    uint64_t seed,
                    Scene& scene) {
  scene.Append(StreetBuilder(street, sides, seed).BuildSides(), Rigid3());
}

}  // namespace quatro
