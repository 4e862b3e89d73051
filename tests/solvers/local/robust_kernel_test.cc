// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/local/robust_kernel.h"

#include <ceres/loss_function.h>
#include <gtest/gtest.h>

#include <cmath>

namespace quatro::robust_kernel_test {
namespace {

constexpr RobustKernelType kTypes[] = {RobustKernelType::kNone,
                                       RobustKernelType::kHuber,
                                       RobustKernelType::kCauchy,
                                       RobustKernelType::kGemanMcClure};

TEST(RobustKernel, WeightIsTheDerivative) {
  for (const RobustKernelType type : kTypes) {
    const RobustKernel kernel{type, 0.7};
    for (const double s : {0.01, 0.3, 0.48, 0.5, 2.0, 50.0}) {
      const double h = 1e-6;
      EXPECT_NEAR((kernel.Cost(s + h) - kernel.Cost(s - h)) / (2.0 * h),
                  kernel.Weight(s),
                  1e-8)
          << static_cast<int>(type) << " at " << s;
    }
  }
}

TEST(RobustKernel, IsTheSquareForSmallErrorsAndConcave) {
  for (const RobustKernelType type : kTypes) {
    const RobustKernel kernel{type, 2.0};
    EXPECT_EQ(kernel.Cost(0.0), 0.0);
    EXPECT_EQ(kernel.Weight(0.0), 1.0);
    EXPECT_NEAR(kernel.Cost(1e-4), 1e-4, 1e-8);
    double before = 1.0;
    for (double s = 0.0; s < 100.0; s += 0.5) {
      EXPECT_LE(kernel.Weight(s), before);
      before = kernel.Weight(s);
    }
    EXPECT_EQ(before < 1.0, type != RobustKernelType::kNone);
  }
}

TEST(RobustKernel, HuberAndCauchyAreThoseOfCeres) {
  for (const double width : {0.3, 2.0}) {
    const ceres::HuberLoss huber(width);
    const ceres::CauchyLoss cauchy(width);
    for (const double s : {0.0, 0.05, 1.0, 3.9, 4.1, 100.0}) {
      double expected[3];
      huber.Evaluate(s, expected);
      EXPECT_NEAR(RobustKernel({RobustKernelType::kHuber, width}).Cost(s),
                  expected[0],
                  1e-12);
      cauchy.Evaluate(s, expected);
      EXPECT_NEAR(RobustKernel({RobustKernelType::kCauchy, width}).Cost(s),
                  expected[0],
                  1e-12);
    }
  }
}

TEST(RobustKernel, GemanMcClureLevelsOffAtTheSquareOfItsWidth) {
  const RobustKernel kernel{RobustKernelType::kGemanMcClure, 3.0};
  EXPECT_DOUBLE_EQ(kernel.Cost(9.0), 4.5);
  EXPECT_NEAR(kernel.Cost(1e12), 9.0, 1e-9);
}

}  // namespace
}  // namespace quatro::robust_kernel_test
