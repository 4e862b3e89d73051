// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/gnc.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "robust/surrogate.h"
#include "solvers/yaw.h"
#include "tests/support/matchers.h"

namespace quatro {
namespace {

struct YawSubproblem {
  using Estimate = YawEstimate;
  Eigen::Index NumMeasurements() const { return source.cols(); }
  std::optional<YawEstimate> Solve(const WeightsRef& weights) const {
    return EstimateYaw(source, target, weights);
  }
  Eigen::VectorXd SquaredResiduals(const YawEstimate& yaw) const {
    const Eigen::Matrix2d R =
        Eigen::Rotation2Dd(yaw.target_from_source).toRotationMatrix();
    return (target.topRows<2>() - R * source.topRows<2>())
               .colwise()
               .squaredNorm()
               .transpose() /
           (noise_bound * noise_bound);
  }
  Points source, target;
  double noise_bound;
};

template <typename Surrogate>
class GncTest : public ::testing::Test {};
using Surrogates = ::testing::Types<TruncatedLeastSquares, GemanMcClure>;
TYPED_TEST_SUITE(GncTest, Surrogates);

TYPED_TEST(GncTest, FindsTheYawUnderSeventyPercentOutliers) {
  std::mt19937 rng(1);
  std::normal_distribution<double> n(0.0, 1.0);
  YawSubproblem p;
  p.noise_bound = 0.3;
  const int N = 200, outliers = 140;
  p.source = Points::NullaryExpr(3, N, [&] { return 10.0 * n(rng); });
  p.target =
      Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
          p.source +
      Points::NullaryExpr(3, N, [&] { return 0.05 * n(rng); });
  p.target.leftCols(outliers) =
      Points::NullaryExpr(3, outliers, [&] { return 10.0 * n(rng); });
  const auto summary = SolveGnc<TypeParam>(p, GncOptions{});
  ASSERT_TRUE(summary.IsUsable());
  EXPECT_THAT(summary.estimate->target_from_source, IsAngleNear(2.0, 2e-3));
  std::cout << summary.iterations.size() << " " << int(summary.termination)
            << " sumw " << summary.weights.sum() << "\n";
}

TYPED_TEST(GncTest, LeavesCleanDataToThePlainFit) {
  YawSubproblem p;
  p.noise_bound = 0.3;
  p.source = Points::Random(3, 10);
  p.target = p.source;
  const auto s = SolveGnc<TypeParam>(p, GncOptions{});
  EXPECT_EQ(s.termination, GncTermination::kAllInliers);
  EXPECT_TRUE(s.iterations.empty());
}

TYPED_TEST(GncTest, RefusesInvalidOptionsAndSaysWhich) {
  GncOptions o;
  o.mu_step = 1.0;
  const auto s =
      SolveGnc<TypeParam>(YawSubproblem{Points(3, 0), Points(3, 0), 1}, o);
  EXPECT_EQ(s.termination, GncTermination::kInvalidOptions);
  EXPECT_THAT(s.message, ::testing::HasSubstr("mu_step"));
}

}  // namespace
}  // namespace quatro
