// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Compares features/fpfh.h with Open3D's and PCL's FPFH.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#if defined(QUATRO_WITH_OPEN3D) || defined(QUATRO_WITH_PCL)

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "experiments/programs/methods.h"
#include "features/fpfh.h"
#include "features/kd_tree.h"
#include "features/normals.h"
#include "robust/registration/presets.h"
#include "robust/registration/registration.h"
#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"
#ifdef QUATRO_WITH_OPEN3D
#include "experiments/peers/open3d_fpfh.h"
#endif
#ifdef QUATRO_WITH_PCL
#include "experiments/peers/pcl_fpfh.h"
#endif

namespace quatro::peers_fpfh_test {
namespace {

constexpr double kRadius = 1.5;

struct Peer {
  const char* name;
  Fpfh (*compute)(const Points& points, const Points& normals, double radius);
  bool adds_own;  // The histogram of the point itself.
};

constexpr Peer kPeers[] = {
#ifdef QUATRO_WITH_OPEN3D
    {"Open3D", ComputeFpfhByOpen3d, true},
#endif
#ifdef QUATRO_WITH_PCL
    {"PCL", ComputeFpfhByPcl, false},
#endif
};

// Our pair features combined like those of the peers: neighbors weighted by one
// over the squared distance, each part of their sum scaled to 100.
Fpfh ComposeAsPeersDo(const Points& points,
                      const Points& normals,
                      const Neighborhoods& neighborhoods,
                      bool adds_own) {
  const Eigen::Index n = points.cols();
  const auto for_each_neighbor = [&](Eigen::Index i, const auto& visit) {
    const Neighborhoods::Row& row = neighborhoods.row(i);
    for (std::size_t k = 0; k < row.size(); ++k) {
      const Eigen::Index j = row.index[k];
      if (j != i) visit(j, row.squared_distance[k]);
    }
  };
  Fpfh spfh = Fpfh::Zero(kFpfhSize, n);
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
  Fpfh fpfh = Fpfh::Zero(kFpfhSize, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for_each_neighbor(i, [&](Eigen::Index j, float squared_distance) {
      fpfh.col(i) += spfh.col(j) / squared_distance;
    });
    for (int part = 0; part < 3; ++part) {
      auto bins = fpfh.col(i).segment<11>(11 * part);
      if (bins.sum() > 0.0f) bins *= 100.0f / bins.sum();
    }
    if (adds_own) fpfh.col(i) += 100.0f * spfh.col(i);
  }
  return fpfh;
}

class FpfhPeer : public ::testing::Test {
 protected:
  const Points points_ = RandomStreet(3000, 0.02, 1);
  const KdTree tree_{points_};
  const Neighborhoods neighborhoods_ = FindNeighborhoods(tree_, kRadius, 1);
  Points normals_ =
      EstimateNormals(points_, neighborhoods_, 0.9, Eigen::Vector3d::Zero(), 1);
};

float Quantile(std::vector<float> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(
      share * static_cast<double>(values.size() - 1))];
}

TEST_F(FpfhPeer, IsOursButForItsWeights) {
  const Fpfh ours = ComputeFpfh(points_, normals_, neighborhoods_, 1);
  for (const Peer& peer : kPeers) {
    SCOPED_TRACE(peer.name);
    const Fpfh theirs = peer.compute(points_, normals_, kRadius);
    const Fpfh composed =
        ComposeAsPeersDo(points_, normals_, neighborhoods_, peer.adds_own);
    std::vector<float> composed_difference;
    std::vector<float> our_difference;
    for (Eigen::Index i = 0; i < points_.cols(); ++i) {
      if (theirs.col(i).isZero(0.0)) continue;
      // Relative to a sum of 300.
      const float scale = 300.0f / theirs.col(i).sum();
      composed_difference.push_back(
          scale * (theirs.col(i) - composed.col(i)).cwiseAbs().sum());
      our_difference.push_back(
          (scale * theirs.col(i) - 300.0f / ours.col(i).sum() * ours.col(i))
              .cwiseAbs()
              .sum());
    }
    ASSERT_GT(composed_difference.size(), 2500u);
    // A feature on the edge of a bin may fall on either side.
    EXPECT_LE(Quantile(composed_difference, 0.5), 0.5f);
    EXPECT_LE(Quantile(composed_difference, 0.95), 5.0f);
    // The documented difference is visible, but the descriptors are similar.
    EXPECT_GE(Quantile(our_difference, 0.5), 2.0f);
    EXPECT_LE(Quantile(our_difference, 0.5), 60.0f);
  }
}

TEST_F(FpfhPeer, HasNoneWhereThereIsNoNormal) {
  normals_.leftCols(10).setZero();
  for (const Peer& peer : kPeers) {
    const Fpfh theirs = peer.compute(points_, normals_, kRadius);
    ASSERT_EQ(theirs.cols(), points_.cols()) << peer.name;
    EXPECT_TRUE(theirs.leftCols(10).isZero(0.0)) << peer.name;
    EXPECT_TRUE(theirs.allFinite()) << peer.name;
    EXPECT_EQ(peer.compute(Points(3, 0), Points(3, 0), kRadius).cols(), 0);
  }
}

// A location far from the origin costs PCL no digits.
TEST_F(FpfhPeer, DoesNotDependOnThePlace) {
  const Points moved = points_.colwise() + Eigen::Vector3d(5e5, -3e5, 100.0);
  for (const Peer& peer : kPeers) {
    const Fpfh here = peer.compute(points_, normals_, kRadius);
    const Fpfh there = peer.compute(moved, normals_, kRadius);
    std::vector<float> difference;
    for (Eigen::Index i = 0; i < points_.cols(); ++i) {
      difference.push_back((here.col(i) - there.col(i)).cwiseAbs().sum());
    }
    EXPECT_LE(Quantile(difference, 0.95), 1.0f) << peer.name;
  }
}

// On clouds, with the names in --list_methods.
TEST_F(FpfhPeer, QuatroOnItsMatchesIsInTheRegistry) {
  const Rigid3 true_target_from_source{RotationZ(0.7), {1.0, -0.8, 0.1}};
  PointCloud source;
  PointCloud target;
  source.points = Inverse(true_target_from_source)
                      .Apply(RandomStreet(12000, 0.01, /*seed=*/1));
  target.points = RandomStreet(12000, 0.01, /*seed=*/2);
  const RegistrationOptions options = *MakePreset("kitti");
  const RegistrationSummary ours = Register(source, target, options);
  for (const char* name : {
#ifdef QUATRO_WITH_OPEN3D
           "open3d_fpfh",
#endif
#ifdef QUATRO_WITH_PCL
           "pcl_fpfh",
#endif
       }) {
    std::string error;
    const PairSolver solve = FindPairSolver(name, {}, &error);
    ASSERT_TRUE(solve) << error;
    const RegistrationSummary theirs =
        solve(source, target, /*matched=*/nullptr, options);
    ASSERT_TRUE(theirs.target_from_source()) << name;
    EXPECT_LE(LargestDisplacement(*theirs.target_from_source(),
                                  true_target_from_source,
                                  source.points),
              0.3)
        << name;
    EXPECT_NE(theirs.num_mutual_matches, ours.num_mutual_matches) << name;
  }
}

}  // namespace
}  // namespace quatro::peers_fpfh_test

#else

TEST(FpfhPeer, IsOursButForItsWeights) {
  GTEST_SKIP() << "needs -DQUATRO_WITH_OPEN3D=ON or -DQUATRO_WITH_PCL=ON";
}

#endif
