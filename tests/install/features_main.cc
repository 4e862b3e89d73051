// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A program of somebody else's that takes one part of the library: every voxel
// of a lattice has its mean, and every mean finds itself in the tree.

#include <quatro/features/kd_tree.h>
#include <quatro/version.h>

#include <iostream>
#include <string>

#include "features/voxel_grid.h"

int main() {
  quatro::Points points(3, 1000);
  for (int i = 0; i < 1000; ++i) {
    points.col(i) << i % 10 + 0.5, i / 10 % 10 + 0.5, i / 100 + 0.5;
  }
  std::string error;
  const auto voxels = quatro::SampleVoxels(points, 2.0, &error);
  if (!voxels || voxels->cols() != 125) {
    std::cout << "voxels: " << (voxels ? voxels->cols() : 0) << error << "\n";
    return 1;
  }
  const quatro::KdTree tree(*voxels);
  for (Eigen::Index i = 0; i < voxels->cols(); ++i) {
    if (tree.Nearest(voxels->col(i), 1).at(0).index != i) return 1;
  }
  std::cout << "quatro " QUATRO_VERSION ": " << voxels->cols() << " voxels\n";
  return 0;
}
