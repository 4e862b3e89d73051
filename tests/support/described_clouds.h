// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Described clouds of given points and normals.

#ifndef QUATRO_TESTS_SUPPORT_DESCRIBED_CLOUDS_H_
#define QUATRO_TESTS_SUPPORT_DESCRIBED_CLOUDS_H_

#include <Eigen/Core>
#include <memory>

#include "features/base/types.h"
#include "features/described_cloud.h"
#include "features/kd_tree.h"

namespace quatro {

inline DescribedCloud MakeDescribedCloud(
    const Points& points,
    const Points& normals,
    const Eigen::Vector3d& sensor = Eigen::Vector3d::Zero(),
    bool is_scan = true) {
  return {std::make_shared<const KdTree>(points),
          normals,
          /*descriptors=*/nullptr,
          sensor,
          is_scan};
}

}  // namespace quatro

#endif  // QUATRO_TESTS_SUPPORT_DESCRIBED_CLOUDS_H_
