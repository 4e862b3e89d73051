// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/fpfh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "features/kd_tree.h"
#include "features/normals.h"
#include "tests/support/random_problems.h"

namespace quatro::fpfh_test {
namespace {

constexpr int kBins = kFpfhBinsPerPart;

// A cloud with normals. Coordinates are multiples of 2^-10 m, so neither moving
// the origin nor single precision rounds them.
struct OrientedCloud {
  Points points;
  Points normals;
};

OrientedCloud Street(Eigen::Index n, std::uint64_t seed) {
  const Points points =
      (RandomStreet(n, 0.03, seed).array() * 0x1p10).round() * 0x1p-10;
  return {points,
          EstimateNormals(points,
                          FindNeighborhoods(KdTree(points), 0.8, 1),
                          0.8,
                          Eigen::Vector3d::Zero(),
                          1)};
}

constexpr double kRadius = 1.2;  // [m]

Fpfh Describe(const OrientedCloud& cloud, int num_threads = 1) {
  return ComputeFpfh(cloud.points,
                     cloud.normals,
                     FindNeighborhoods(KdTree(cloud.points), kRadius, 1),
                     num_threads);
}

// A direct implementation of (1).
std::optional<Eigen::Vector3d> PairFeature(const Eigen::Vector3d& p1,
                                           const Eigen::Vector3d& n1,
                                           const Eigen::Vector3d& p2,
                                           const Eigen::Vector3d& n2) {
  const Eigen::Vector3d line = p2 - p1;
  if (line.isZero(0.0)) return std::nullopt;
  const double cos1 = n1.dot(line) / line.norm();
  const double cos2 = -n2.dot(line) / line.norm();
  const bool are_equally_close =
      std::abs(std::abs(cos1) - std::abs(cos2)) < 1e-5;
  const bool is_first =
      are_equally_close ? cos1 >= cos2 : std::abs(cos1) > std::abs(cos2);
  const Eigen::Vector3d p_s = is_first ? p1 : p2;
  const Eigen::Vector3d n_s = is_first ? n1 : n2;
  const Eigen::Vector3d p_t = is_first ? p2 : p1;
  const Eigen::Vector3d n_t = is_first ? n2 : n1;
  const Eigen::Vector3d d = (p_t - p_s) / (p_t - p_s).norm();
  if (d.cross(n_s).norm() < 1e-6) return std::nullopt;
  const Eigen::Vector3d v = d.cross(n_s).normalized();
  const Eigen::Vector3d w = n_s.cross(v);
  return Eigen::Vector3d(
      std::atan2(w.dot(n_t), n_s.dot(n_t)) / M_PI, v.dot(n_t), n_s.dot(d));
}

Eigen::MatrixXd WithPartsSummingTo(double sum, Eigen::MatrixXd histograms) {
  for (auto histogram : histograms.colwise()) {
    for (int part = 0; part < 3; ++part) {
      const double mass = histogram.segment(part * kBins, kBins).sum();
      if (mass > 0.0) histogram.segment(part * kBins, kBins) *= sum / mass;
    }
  }
  return histograms;
}

// A direct implementation of (2) over all pairs of the cloud.
Eigen::MatrixXd BruteForceFpfh(const OrientedCloud& cloud, double radius) {
  const auto& [p, normals] = cloud;
  const Eigen::Index n = p.cols();
  const auto takes_part = [&, &normals = normals](Eigen::Index i) {
    return normals.col(i).norm() > 0.0;
  };
  const auto are_neighbors = [&, &p = p](Eigen::Index i, Eigen::Index j) {
    return i != j && takes_part(i) && takes_part(j) &&
           (p.col(i) - p.col(j)).norm() <= radius;
  };
  Eigen::MatrixXd spfh = Eigen::MatrixXd::Zero(kFpfhSize, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      if (!are_neighbors(i, j)) continue;
      const auto feature =
          PairFeature(p.col(i), normals.col(i), p.col(j), normals.col(j));
      if (!feature) continue;
      for (int part = 0; part < 3; ++part) {
        const double bin = std::floor(kBins * ((*feature)[part] + 1.0) / 2.0);
        spfh(part * kBins + static_cast<int>(std::clamp(bin, 0.0, kBins - 1.0)),
             i) += 1.0;
      }
    }
  }
  spfh = WithPartsSummingTo(1.0, spfh);
  Eigen::MatrixXd fpfh = spfh;
  for (Eigen::Index i = 0; i < n; ++i) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(kFpfhSize);
    int k = 0;
    for (Eigen::Index j = 0; j < n; ++j) {
      // Coincident points have no weight in (2).
      if (!are_neighbors(i, j) || p.col(i) == p.col(j)) continue;
      sum += spfh.col(j) / (p.col(i) - p.col(j)).norm();
      ++k;
    }
    if (k > 0) fpfh.col(i) += sum / k;
  }
  return WithPartsSummingTo(100.0, fpfh);
}

// Descriptors are equal up to rounding. But a feature within single precision
// of a bin's edge may fall on either side, which moves a whole pair, and that
// is much if there are few pairs. So the test requires nearly all to be equal,
// to 1e-3 of 100.
void ExpectSameDescriptors(const Eigen::MatrixXd& fpfh,
                           const Eigen::MatrixXd& expected) {
  ASSERT_EQ(fpfh.cols(), expected.cols());
  const Eigen::RowVectorXd difference =
      (fpfh - expected).cwiseAbs().colwise().maxCoeff();
  const auto num_off = (difference.array() >= 1e-3).count();
  EXPECT_LE(num_off, fpfh.cols() / 100)
      << "largest difference " << difference.maxCoeff();
}

TEST(PairFeature, OfAHandComputedPair) {
  // The second normal leans toward the line, so its point is the source: d =
  // -x, v = y, w = (-0.8, 0, 0.6).
  const auto feature =
      ComputePairFeature({0, 0, 0}, {0, 0, 1}, {2, 0, 0}, {0.6f, 0.0f, 0.8f});
  ASSERT_TRUE(feature);
  EXPECT_NEAR((*feature)[0], std::atan2(0.6, 0.8) / M_PI, 1e-6);
  EXPECT_NEAR((*feature)[1], 0.0, 1e-6);
  EXPECT_NEAR((*feature)[2], -0.6, 1e-6);
}

// Two points with normals.
struct OrientedPair {
  Eigen::Vector3f p1, n1, p2, n2;
};

OrientedPair RandomPair(std::uint64_t seed) {
  const Eigen::Matrix3Xf p = RandomPoints(2, 1.0, seed).cast<float>();
  const Eigen::Matrix3Xf n =
      RandomSphere(2, 1.0, seed + 1000000).normals.cast<float>();
  return {p.col(0), n.col(0), p.col(1), n.col(1)};
}

TEST(PairFeature, IsEquationOne) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const auto [p1, n1, p2, n2] = RandomPair(seed);
    const auto feature = ComputePairFeature(p1, n1, p2, n2);
    const auto expected = PairFeature(p1.cast<double>(),
                                      n1.cast<double>(),
                                      p2.cast<double>(),
                                      n2.cast<double>());
    ASSERT_TRUE(feature && expected) << "seed " << seed;
    ASSERT_LT((feature->cast<double>() - *expected).cwiseAbs().maxCoeff(), 1e-4)
        << "seed " << seed << ": " << feature->transpose() << " instead of "
        << expected->transpose();
    ASSERT_LE(feature->cwiseAbs().maxCoeff(), 1.0f + 1e-6f) << "seed " << seed;
  }
}

TEST(PairFeature, DoesNotDependOnWhichPointComesFirst) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const auto [p1, n1, p2, n2] = RandomPair(seed);
    EXPECT_EQ(ComputePairFeature(p1, n1, p2, n2),
              ComputePairFeature(p2, n2, p1, n1))
        << "seed " << seed;
  }
}

TEST(PairFeature, DoesNotDependOnWhichPointComesFirstForParallelNormals) {
  // Both normals are equally close to the line, as on two steps of a stair.
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const auto [p1, n1, p2, n2] = RandomPair(seed);
    for (const Eigen::Vector3f& n : {n1, Eigen::Vector3f(-n1)}) {
      const auto forward = ComputePairFeature(p1, n1, p2, n);
      const auto backward = ComputePairFeature(p2, n, p1, n1);
      ASSERT_TRUE(forward && backward);
      ASSERT_LT((forward->tail<2>() - backward->tail<2>()).norm(), 1e-5f)
          << "seed " << seed << ": " << forward->transpose() << " and "
          << backward->transpose();
      // Half a rotation either way is the same angle.
      ASSERT_NEAR(
          std::remainder((*forward)[0] - (*backward)[0], 2.0f), 0.0f, 1e-5f);
    }
  }
}

TEST(PairFeature, DoesNotChangeUnderRigidMotion) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const auto [p1, n1, p2, n2] = RandomPair(seed);
    const Eigen::Matrix3f rotation = RandomRotation(seed).cast<float>();
    const Eigen::Vector3f shift = RandomPoints(1, 3.0, seed).cast<float>();
    const auto feature = ComputePairFeature(p1, n1, p2, n2);
    const auto moved = ComputePairFeature(rotation * p1 + shift,
                                          rotation * n1,
                                          rotation * p2 + shift,
                                          rotation * n2);
    ASSERT_TRUE(feature && moved) << "seed " << seed;
    ASSERT_LT((*feature - *moved).cwiseAbs().maxCoeff(), 2e-4f)
        << "seed " << seed << ": " << feature->transpose() << " and "
        << moved->transpose();
  }
}

TEST(PairFeature, DoesNotExistForCoincidentPointsAndLinesAlongTheNormal) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const auto [p1, n1, p2, n2] = RandomPair(seed);
    EXPECT_FALSE(ComputePairFeature(p1, n1, p1, n2)) << "seed " << seed;
    const Eigen::Vector3f above = p1 + 2.0f * n1;
    for (const Eigen::Vector3f& n : {n1, n2, Eigen::Vector3f(-n1)}) {
      EXPECT_FALSE(ComputePairFeature(p1, n1, above, n)) << "seed " << seed;
      EXPECT_FALSE(ComputePairFeature(above, n, p1, n1)) << "seed " << seed;
    }
  }
}

TEST(ComputeFpfh, IsEquationTwo) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE(seed);
    const OrientedCloud cloud = Street(700, seed);
    ExpectSameDescriptors(Describe(cloud).cast<double>(),
                          BruteForceFpfh(cloud, kRadius));
  }
}

TEST(ComputeFpfh, IsEquationTwoWithCopiesOfPoints) {
  const OrientedCloud cloud = Street(400, 1);
  OrientedCloud copied{cloud.points.replicate(1, 2),
                       cloud.normals.replicate(1, 2)};
  ExpectSameDescriptors(Describe(copied).cast<double>(),
                        BruteForceFpfh(copied, kRadius));
}

TEST(ComputeFpfh, OfTwoPointsHasOneBinAPart) {
  const OrientedCloud pair{Points{{0, 1}, {0, 0}, {0, 0}},
                           Points{{0, 0.6}, {0, 0}, {1, 0.8}}};
  // The hand-computed pair above: (0.2, 0, -0.6).
  Eigen::VectorXf expected = Eigen::VectorXf::Zero(kFpfhSize);
  expected[6] = expected[kBins + 5] = expected[2 * kBins + 2] = 100.0f;
  const Fpfh fpfh = Describe(pair);
  EXPECT_EQ(fpfh.col(0), expected) << fpfh.transpose();
  EXPECT_EQ(fpfh.col(1), expected) << fpfh.transpose();
}

TEST(ComputeFpfh, EachPartSumsToOneHundred) {
  const OrientedCloud cloud = Street(2000, 1);
  const Fpfh fpfh = Describe(cloud);
  EXPECT_TRUE(fpfh.allFinite());
  EXPECT_GE(fpfh.minCoeff(), 0.0f);
  int num_described = 0;
  for (const auto descriptor : fpfh.colwise()) {
    if (descriptor.isZero(0.0f)) continue;
    for (int part = 0; part < 3; ++part) {
      ASSERT_NEAR(descriptor.segment(part * kBins, kBins).sum(), 100.0, 1e-3);
    }
    ++num_described;
  }
  EXPECT_GT(num_described, 1900);
}

TEST(ComputeFpfh, IsTheSameForTheMovedCloud) {
  const OrientedCloud cloud = Street(2000, 1);
  const Fpfh fpfh = Describe(cloud);
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE(seed);
    const Eigen::Matrix3d rotation = RandomRotation(seed);
    const Eigen::Vector3d translation = RandomPoints(1, 50.0, seed);
    const OrientedCloud moved{(rotation * cloud.points).colwise() + translation,
                              rotation * cloud.normals};
    ExpectSameDescriptors(Describe(moved).cast<double>(), fpfh.cast<double>());
  }
}

TEST(ComputeFpfh, FarFromTheOriginIsTheSameToTheLastBit) {
  OrientedCloud cloud = Street(1000, 1);
  const Fpfh fpfh = Describe(cloud);
  cloud.points.colwise() += Eigen::Vector3d(1e7, -1e7, 1e7);
  EXPECT_EQ(Describe(cloud), fpfh);
}

TEST(ComputeFpfh, PointsWithoutNormalAreZeroAndTakeNoPart) {
  OrientedCloud cloud = Street(1000, 1);
  std::vector<Eigen::Index> kept;
  Random random(2);
  for (Eigen::Index i = 0; i < cloud.points.cols(); ++i) {
    if (random.Below(4) == 0) cloud.normals.col(i).setZero();
    if (!cloud.normals.col(i).isZero(0.0)) kept.push_back(i);
  }
  const Fpfh fpfh = Describe(cloud);
  int num_without_normal = 0;
  for (Eigen::Index i = 0; i < cloud.points.cols(); ++i) {
    if (!cloud.normals.col(i).isZero(0.0)) continue;
    ++num_without_normal;
    ASSERT_TRUE(fpfh.col(i).isZero(0.0f)) << "point " << i;
  }
  EXPECT_GT(num_without_normal, 200);
  const Fpfh without = Describe(
      {cloud.points(Eigen::all, kept), cloud.normals(Eigen::all, kept)});
  EXPECT_EQ(Fpfh(fpfh(Eigen::all, kept)), without);
  EXPECT_FALSE(without.isZero(0.0f));
}

TEST(ComputeFpfh, IsZeroWithoutANeighbor) {
  const OrientedCloud apart{Points{{0, 10}, {0, 0}, {0, 0}},
                            Points{{0, 0}, {0, 0}, {1, 1}}};
  EXPECT_TRUE(Describe(apart).isZero(0.0f));
  const OrientedCloud together{Points::Zero(3, 5),
                               RandomSphere(5, 1.0, 1).normals};
  EXPECT_TRUE(Describe(together).isZero(0.0f));
  EXPECT_EQ(Describe({Points(3, 0), Points(3, 0)}).cols(), 0);
}

TEST(ComputeFpfh, DoesNotDependOnTheNumberOfThreads) {
  const OrientedCloud cloud = Street(3000, 1);
  const Fpfh one = Describe(cloud, 1);
  for (const int num_threads : {0, 2, 3}) {
    EXPECT_EQ(Describe(cloud, num_threads), one) << num_threads << " threads";
  }
}

}  // namespace
}  // namespace quatro::fpfh_test
