// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A sampled cloud, with the normal of the surface and the descriptor at each of
// its points.

#ifndef QUATRO_FEATURES_DESCRIBED_CLOUD_H_
#define QUATRO_FEATURES_DESCRIBED_CLOUD_H_

#include <Eigen/Core>
#include <memory>

#include "features/base/types.h"
#include "features/fpfh.h"
#include "features/kd_tree.h"

namespace quatro {

// Points in a tree, which copies of the cloud share, and a normal per point.
struct DescribedCloud {
  std::shared_ptr<const KdTree> tree;
  Points normals;  // Unit vectors; zero where the normal is unknown.

  // One column per point, zero if a point has none. Copies of the cloud share
  // them. Null if they were not computed.
  std::shared_ptr<const Fpfh> descriptors;

  // The position of the sensor in the frame of the points [m].
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();

  // Whether the sensor saw all points from that position, so that the space
  // between is free. False for a cloud in the coordinates of a map, whose
  // sensor is assumed to be above the middle of the cloud.
  bool is_scan = true;

  // The points of the tree [m].
  const Points& points() const { return tree->points(); }
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_DESCRIBED_CLOUD_H_
