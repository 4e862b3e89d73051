// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/ceres/manifolds.h"

#include <ceres/manifold.h>
#include <ceres/manifold_test_utils.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "features/base/rigid3.h"
#include "solvers/ceres/ceres_residuals.h"
#include "tests/support/random_problems.h"

namespace quatro::manifolds_test {
namespace {

Eigen::VectorXd OnCircle(double angle) {
  return Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

TEST(UnitCircleManifold, InvariantsHold) {
  using namespace ceres;  // Ceres 2.1's macro names its matchers unqualified.
  const UnitCircleManifold manifold;
  for (const double angle : {-3.1, -1.0, 0.0, 0.4, 2.5, M_PI}) {
    const Vector x = OnCircle(angle);
    const Vector y = OnCircle(angle + 2.0);
    const Vector delta = Vector::Constant(1, 0.9);
    EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-9);
  }
}

TEST(UnitCircleManifold, IsSmoothWhereAnAngleWouldJump) {
  const UnitCircleManifold manifold;
  const Eigen::VectorXd below = OnCircle(M_PI - 0.01);
  const Eigen::VectorXd above = OnCircle(-M_PI + 0.01);
  double delta = 0.0;
  ASSERT_TRUE(manifold.Minus(above.data(), below.data(), &delta));
  EXPECT_NEAR(delta, 0.02, 1e-12);
}

// Compares Perturb() of a group with exp in double. Perturb() is accurate to
// second order, so the error of a step h is of third order.
TEST(Groups, PerturbIsTheExponentialToSecondOrder) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Eigen::Quaterniond q(RandomRotation(seed));
    const Eigen::Vector3d axis = RandomDirection(seed + 100);
    double error[2] = {};
    const double steps[2] = {2e-2, 1e-2};
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector3d delta = steps[k] * axis;
      Eigen::Quaterniond perturbed;
      Turn::Perturb(q.coeffs().data(), delta.data(), perturbed.coeffs().data());
      const Eigen::Quaterniond expected(
          Eigen::AngleAxisd(steps[k], axis).toRotationMatrix() *
          q.toRotationMatrix());
      error[k] = std::min((perturbed.coeffs() - expected.coeffs()).norm(),
                          (perturbed.coeffs() + expected.coeffs()).norm());
    }
    EXPECT_NEAR(error[0] / error[1], 8.0, 0.1) << "seed " << seed;
  }
}

TEST(Groups, RotateAsTheirMatrixDoes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Eigen::Vector3d p = 10.0 * RandomDirection(seed);
    const Eigen::Matrix3d R = RandomRotation(seed);
    const Eigen::Quaterniond q(R);
    EXPECT_LT((Turn::Rotate(q.coeffs().data(), p) - R * p).norm(),
              1e-14 * 10.0);

    const double yaw = Yaw(R);
    const Eigen::VectorXd circle = OnCircle(yaw);
    EXPECT_LT(
        (TurnAboutZ::Rotate(circle.data(), p) - RotationZ(yaw) * p).norm(),
        1e-14 * 10.0);
  }
}

}  // namespace
}  // namespace quatro::manifolds_test
