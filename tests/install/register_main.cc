// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A program of somebody else's: two generated scans of one place, the second
// from elsewhere. Ends with 0 if the pose between them is found.

#include <quatro/quatro.h>

#include <cmath>
#include <iostream>
#include <random>

#include "features/base/rigid3.h"
#include "features/io/point_cloud.h"  // The form the library's own headers use.

namespace {

// Points on the ground and on the walls of upright boxes.
quatro::PointCloud MakeScan(unsigned seed_of_place, unsigned seed_of_scan) {
  std::mt19937 place(seed_of_place);
  std::mt19937 scan(seed_of_scan);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  constexpr int kBoxes = 40;
  constexpr int kPerBox = 500;
  constexpr int kGround = 6000;
  quatro::PointCloud cloud;
  cloud.points.resize(3, kBoxes * kPerBox + kGround);
  Eigen::Index column = 0;
  for (int box = 0; box < kBoxes; ++box) {
    const double x = 60.0 * uniform(place) - 30.0;
    const double y = 60.0 * uniform(place) - 30.0;
    const double turn = M_PI * uniform(place);
    const double length = 1.0 + 4.0 * uniform(place);
    const double width = 1.0 + 2.0 * uniform(place);
    const double height = 1.0 + 3.0 * uniform(place);
    for (int i = 0; i < kPerBox; ++i) {
      const bool along = uniform(scan) < length / (length + width);
      const double side = uniform(scan) < 0.5 ? -0.5 : 0.5;
      const double place_on_side = uniform(scan) - 0.5;
      const double u = length * (along ? place_on_side : side);
      const double v = width * (along ? side : place_on_side);
      cloud.points.col(column++) << x + u * std::cos(turn) - v * std::sin(turn),
          y + u * std::sin(turn) + v * std::cos(turn),
          height * uniform(scan) - 1.5;
    }
  }
  for (int i = 0; i < kGround; ++i) {
    cloud.points.col(column++) << 60.0 * uniform(scan) - 30.0,
        60.0 * uniform(scan) - 30.0, -1.5;
  }
  return cloud;
}

}  // namespace

int main() {
  const quatro::Rigid3 truth{quatro::RotationZ(2.0), {3.0, -4.0, 0.2}};
  const quatro::PointCloud source = MakeScan(1, 2);
  quatro::PointCloud target = MakeScan(1, 3);
  target.points = truth.Apply(target.points);
  const quatro::RegistrationSummary summary =
      quatro::Register(source, target, *quatro::MakePreset("kitti"));
  std::cout << "quatro " QUATRO_VERSION ": "
            << quatro::StatusName(summary.verdict.status) << ", "
            << summary.verdict.reason << "\n";
  if (!summary.verdict.IsRegistered()) return 1;
  const quatro::Rigid3 error =
      quatro::Inverse(truth) * *summary.target_from_source();
  const double angle =
      quatro::AngleBetween(error.rotation, Eigen::Matrix3d::Identity());
  std::cout << error.translation.norm() << " m and " << angle << " rad off\n";
  return error.translation.norm() < 0.2 && angle < 0.02 ? 0 : 1;
}
