// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// features/fpfh.h against PCL's FPFH.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#ifdef QUATRO_WITH_PCL

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "experiments/peers/pcl.h"
#include "features/fpfh.h"
#include "features/kd_tree.h"
#include "features/normals.h"
#include "tests/support/random_problems.h"

namespace quatro {
namespace {

constexpr double kRadius = 1.5;

// Our pair features put together as PCL does: no histogram of the point's own,
// neighbours weighted by one over the squared distance.
Eigen::MatrixXf ComposeAsPclDoes(const Points& points,
                                 const Points& normals,
                                 const Neighborhoods& neighborhoods) {
  const Eigen::Index n = points.cols();
  const auto for_each_neighbor = [&](Eigen::Index i, const auto& visit) {
    const auto row = static_cast<std::size_t>(i);
    for (auto k = static_cast<std::size_t>(neighborhoods.row_begin[row]);
         k < static_cast<std::size_t>(neighborhoods.row_begin[row + 1]);
         ++k) {
      const Eigen::Index j = neighborhoods.index[k];
      if (j != i) visit(j, neighborhoods.squared_distance[k]);
    }
  };
  Eigen::MatrixXf spfh = Eigen::MatrixXf::Zero(33, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for_each_neighbor(i, [&](Eigen::Index j, float) {
      const auto feature = ComputePairFeature(points.col(i).cast<float>(),
                                              normals.col(i).cast<float>(),
                                              points.col(j).cast<float>(),
                                              normals.col(j).cast<float>());
      if (!feature) return;
      for (int part = 0; part < 3; ++part) {
        const int bin = static_cast<int>(((*feature)[part] + 1.0f) * 5.5f);
        spfh(11 * part + std::clamp(bin, 0, 10), i) += 1.0f;
      }
    });
    spfh.col(i) /= std::max(1.0f, spfh.col(i).head<11>().sum());
  }
  Eigen::MatrixXf fpfh = Eigen::MatrixXf::Zero(33, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for_each_neighbor(i, [&](Eigen::Index j, float squared_distance) {
      fpfh.col(i) += spfh.col(j) / squared_distance;
    });
    for (int part = 0; part < 3; ++part) {
      auto bins = fpfh.col(i).segment<11>(11 * part);
      if (bins.sum() > 0.0f) bins *= 100.0f / bins.sum();
    }
  }
  return fpfh;
}

TEST(PclPeer, FpfhIsOursButForItsWeights) {
  const Points points = RandomStreet(3000, 0.02, 1);
  const KdTree tree(points);
  const Neighborhoods neighborhoods = FindNeighborhoods(tree, kRadius, 1);
  const Points normals =
      EstimateNormals(points, neighborhoods, 0.9, Eigen::Vector3d::Zero(), 1);
  const Eigen::MatrixXf pcl = ComputeFpfhByPcl(points, normals, kRadius);
  const Eigen::MatrixXf composed =
      ComposeAsPclDoes(points, normals, neighborhoods);
  const Fpfh ours = ComputeFpfh(points, normals, neighborhoods, 1);

  std::vector<float> composed_difference;
  std::vector<float> our_difference;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (!pcl.col(i).allFinite() || normals.col(i).isZero(0.0)) continue;
    composed_difference.push_back(
        (pcl.col(i) - composed.col(i)).cwiseAbs().sum());
    our_difference.push_back((pcl.col(i) - ours.col(i)).cwiseAbs().sum());
  }
  ASSERT_GT(composed_difference.size(), 2500u);
  const auto quantile = [](std::vector<float> values, double share) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(
        share * static_cast<double>(values.size() - 1))];
  };
  // Of 300. A feature on the edge of a bin may fall on either side.
  EXPECT_LE(quantile(composed_difference, 0.5), 0.5f);
  EXPECT_LE(quantile(composed_difference, 0.95), 5.0f);
  // The documented difference: visible, and no other descriptor.
  EXPECT_GE(quantile(our_difference, 0.5), 2.0f);
  EXPECT_LE(quantile(our_difference, 0.5), 60.0f);
}

}  // namespace
}  // namespace quatro

#else

TEST(PclPeer, FpfhIsOursButForItsWeights) {
  GTEST_SKIP() << "needs a build with -DQUATRO_WITH_PCL=ON";
}

#endif
