// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Compares solvers/local/icp.h and gicp.h with Open3D's and PCL's, on the same
// points.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#if defined(QUATRO_WITH_OPEN3D) || defined(QUATRO_WITH_PCL)

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "experiments/programs/methods.h"
#include "experiments/simulator/lidar.h"
#include "experiments/simulator/road.h"
#include "experiments/simulator/street.h"
#include "features/voxel_grid.h"
#include "robust/registration/refinement.h"
#include "solvers/local/gicp.h"
#include "solvers/local/icp.h"
#include "tests/support/random_problems.h"
#ifdef QUATRO_WITH_OPEN3D
#include "experiments/peers/open3d_icp.h"
#endif
#ifdef QUATRO_WITH_PCL
#include "experiments/peers/pcl_icp.h"
#include "features/base/degree.h"
#endif

namespace quatro::peers_icp_test {
namespace {

struct Peer {
  const char* name;
  AlignmentSummary (*align)(const Points& source,
                            const Points& target,
                            const Rigid3& initial_target_from_source,
                            const RefinementOptions& options);
  double max_difference;  // From ours, at the source's center [m].
};

struct Pair {
  Points source;
  Points target;
  Rigid3 true_target_from_source;
};

// Voxel means of two scans of a simulated street, 0.8 m apart.
Pair MakePair(std::uint64_t seed) {
  RoadOptions options;
  options.seed = seed;
  const Road road(options);
  std::string error;
  const auto scene = LidarScene::Create(MakeStreet(road), &error);
  EXPECT_TRUE(scene) << error;
  LidarOptions lidar;
  lidar.num_columns = 1041;
  const Rigid3 poses[] = {road.WorldFromSensor(90.0, 0.0, 0.0),
                          road.WorldFromSensor(90.8, 0.0, 0.0)};
  Points voxels[2];
  for (const std::uint64_t i : {0u, 1u}) {
    const PointCloud scan = scene->Scan(poses[i], lidar, {seed, i}, 1);
    voxels[i] = *SampleVoxels(scan.points, 0.3, &error);
  }
  return {voxels[1], voxels[0], Inverse(poses[0]) * poses[1]};
}

// An error of 3 deg and 0.3 m.
Rigid3 OffBy(const Rigid3& truth, std::uint64_t seed) {
  const Eigen::Vector3d axis = RandomRotation(seed).col(0);
  return Rigid3{Eigen::AngleAxisd(3.0 * kDegree, axis).toRotationMatrix(),
                0.3 * RandomRotation(seed + 100).col(0)} *
         truth;
}

// Compares the minima and not the points where the iterations stop.
RefinementOptions Options(RefinementMethod method) {
  RefinementOptions options;
  options.method = method;
  options.alignment.translation_tolerance = 1e-5;
  options.alignment.rotation_tolerance = 1e-6;
  options.alignment.max_num_iterations = 500;
  return options;
}

AlignmentSummary AlignByOurs(const Pair& pair,
                             const Rigid3& guess,
                             const RefinementOptions& options) {
  if (options.method == RefinementMethod::kIcp) {
    return SolveIcp(pair.source, pair.target, guess, options.alignment);
  }
  GicpOptions gicp;
  gicp.alignment = options.alignment;
  gicp.epsilon = options.epsilon;
  return SolveGicp(pair.source, pair.target, guess, gicp);
}

class IcpPeerTest : public ::testing::TestWithParam<Peer> {
 protected:
  static AlignmentSummary Align(const Pair& pair,
                                const Rigid3& guess,
                                const RefinementOptions& options) {
    return GetParam().align(pair.source, pair.target, guess, options);
  }
};

TEST_P(IcpPeerTest, EndsWhereOursDoes) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u}) {
    const Pair pair = MakePair(seed);
    const Rigid3 guess = OffBy(pair.true_target_from_source, seed);
    const Eigen::Vector3d middle = pair.source.rowwise().mean();
    for (const RefinementMethod method :
         {RefinementMethod::kIcp, RefinementMethod::kGicp}) {
      SCOPED_TRACE(std::string(RefinementName(method)) + ", seed " +
                   std::to_string(seed));
      const AlignmentSummary ours = AlignByOurs(pair, guess, Options(method));
      const AlignmentSummary theirs = Align(pair, guess, Options(method));
      ASSERT_TRUE(ours.IsUsable()) << ours.message;
      ASSERT_TRUE(theirs.IsUsable()) << theirs.message;
      const Rigid3& a = *ours.target_from_source;
      const Rigid3& b = *theirs.target_from_source;
      EXPECT_LE((a * middle - b * middle).norm(), GetParam().max_difference);
      EXPECT_LE(AngleBetween(a.rotation, b.rotation), 0.005 * kDegree);
      EXPECT_NEAR(static_cast<double>(ours.num_inliers),
                  static_cast<double>(theirs.num_inliers),
                  5.0);
      // Both poses have moved.
      EXPECT_LE(AngleBetween(b.rotation, pair.true_target_from_source.rotation),
                0.3 * kDegree);
    }
  }
}

TEST_P(IcpPeerTest, FarFromTheOriginIsAsGood) {
  const Pair pair = MakePair(1);
  const Eigen::Vector3d far(1e5, -2e5, 50.0);
  const Pair moved{
      pair.source.colwise() + far, pair.target.colwise() + far, {}};
  for (const RefinementMethod method :
       {RefinementMethod::kIcp, RefinementMethod::kGicp}) {
    const AlignmentSummary near = Align(pair, {}, Options(method));
    const AlignmentSummary away = Align(moved, {}, Options(method));
    ASSERT_TRUE(near.IsUsable() && away.IsUsable()) << away.message;
    const Eigen::Vector3d middle = pair.source.rowwise().mean();
    EXPECT_LE((*away.target_from_source * (middle + far) - far -
               *near.target_from_source * middle)
                  .norm(),
              0.01)
        << RefinementName(method);
  }
}

TEST_P(IcpPeerTest, BadInputIsNoAnswer) {
  const Pair pair = MakePair(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const RefinementMethod method :
       {RefinementMethod::kIcp, RefinementMethod::kGicp}) {
    const RefinementOptions options = Options(method);
    for (const Eigen::Index n : {0, 1, 2}) {
      const Pair few{pair.source.leftCols(n), pair.target, {}};
      const AlignmentSummary summary = Align(few, {}, options);
      EXPECT_FALSE(summary.IsUsable()) << n;
      EXPECT_EQ(summary.termination, AlignmentTermination::kInsufficient);
      EXPECT_NE(summary.message, "the alignment was not run");
    }
    Pair broken = pair;
    broken.source(1, 5) = nan;
    EXPECT_EQ(Align(broken, {}, options).termination,
              AlignmentTermination::kInvalidInput);
    // There are no correspondences.
    const Rigid3 away{Eigen::Matrix3d::Identity(), {0.0, 0.0, 500.0}};
    const AlignmentSummary far = Align(pair, away, options);
    EXPECT_FALSE(far.IsUsable());
    EXPECT_EQ(far.termination, AlignmentTermination::kInsufficient)
        << far.message;
  }
  EXPECT_FALSE(Align(pair, {}, Options(RefinementMethod::kVgicp)).IsUsable());
}

TEST_P(IcpPeerTest, IsInTheRegistry) {
  const std::string name = GetParam().name;
  EXPECT_THAT(ExperimentMethodNames(MethodInput::kClouds),
              ::testing::IsSupersetOf({name + "_icp", name + "_gicp"}));
  const Pair pair = MakePair(1);
  for (const RefinementMethod method :
       {RefinementMethod::kIcp, RefinementMethod::kGicp}) {
    PointCloud source;
    PointCloud target;
    source.points = pair.source;
    target.points = pair.target;
    std::string error;
    const PairSolver solve =
        FindPairSolver(name + "_" + RefinementName(method), {}, &error);
    ASSERT_TRUE(solve) << error;
    const RegistrationSummary summary =
        solve(source, target, /*matched=*/nullptr, {});
    ASSERT_TRUE(summary.target_from_source()) << summary.solution.message;
    EXPECT_EQ(summary.verdict.status, Status::kAmbiguous);
    RefinementOptions options;
    options.method = method;
    const AlignmentSummary direct =
        GetParam().align(*SampleVoxels(source.points, 0.3, &error),
                         *SampleVoxels(target.points, 0.3, &error),
                         {},
                         options);
    EXPECT_LT((summary.target_from_source()->translation -
               direct.target_from_source->translation)
                  .norm(),
              1e-6);
  }
}

// The minimizer of PCL's G-ICP stops early.
constexpr Peer kPeers[] = {
#ifdef QUATRO_WITH_OPEN3D
    {"open3d", AlignByOpen3d, 1e-3},
#endif
#ifdef QUATRO_WITH_PCL
    {"pcl", AlignByPcl, 5e-3},
#endif
};

INSTANTIATE_TEST_SUITE_P(All,
                         IcpPeerTest,
                         ::testing::ValuesIn(kPeers),
                         [](const auto& test) {
                           return std::string(test.param.name);
                         });

}  // namespace
}  // namespace quatro::peers_icp_test

#else

TEST(IcpPeer, EndsWhereOursDoes) {
  GTEST_SKIP() << "needs a build with -DQUATRO_WITH_OPEN3D=ON or "
                  "-DQUATRO_WITH_PCL=ON";
}

#endif
