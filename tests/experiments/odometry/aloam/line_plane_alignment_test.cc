// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/aloam/line_plane_alignment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/odometry/aloam/line_plane_residuals.h"
#include "tests/support/random_problems.h"

namespace quatro::line_plane_alignment_test {
namespace {

Rigid3 RandomPose(std::uint64_t seed, double angle, double distance) {
  return {Eigen::AngleAxisd(angle, RandomDirection(seed)).toRotationMatrix(),
          distance * RandomDirection(seed + 1000)};
}

// n points that are on random lines (or planes) after `pose` is applied.
std::vector<SurfaceMatch> Matches(int n,
                                  const Rigid3& pose,
                                  bool are_lines,
                                  std::uint64_t seed) {
  const Points sources = RandomPoints(n, 8.0, seed);
  std::vector<SurfaceMatch> matches;
  for (int i = 0; i < n; ++i) {
    const auto s = seed * 7919 + static_cast<std::uint64_t>(i);
    const Eigen::Vector3d direction = RandomDirection(s);
    Eigen::Vector3d along = direction;
    if (!are_lines) along = direction.unitOrthogonal();
    const Eigen::Vector3d source = sources.col(i);
    matches.push_back({source, pose * source + 3.0 * along, direction});
  }
  return matches;
}

// For both residuals: the derivatives agree with central differences, taken
// independently in the four numbers of the quaternion.
template <typename Residual, int kSize>
void ExpectDerivativesAreThoseOfDifferences(std::uint64_t seed) {
  const SurfaceMatch match =
      Matches(1, RandomPose(seed, 1.0, 2.0), false, seed)[0];
  typename Residual::CostFunction cost(new Residual{match});
  const Eigen::Quaterniond q(RandomRotation(seed + 5));
  Eigen::Matrix<double, 7, 1> x;
  x << q.coeffs(), 4.0 * RandomDirection(seed + 6);
  const auto evaluate = [&](const Eigen::Matrix<double, 7, 1>& at,
                            double** jacobians) {
    const double* blocks[] = {at.data(), at.data() + 4};
    Eigen::Matrix<double, kSize, 1> residual;
    EXPECT_TRUE(cost.Evaluate(blocks, residual.data(), jacobians));
    return residual;
  };
  double of_turn[kSize * 4], of_translation[kSize * 3];
  double* jacobians[] = {of_turn, of_translation};
  evaluate(x, jacobians);
  constexpr double kStep = 1e-6;
  double largest = 0.0;
  for (int j = 0; j < 7; ++j) {
    Eigen::Matrix<double, 7, 1> above = x, below = x;
    above[j] += kStep;
    below[j] -= kStep;
    const Eigen::Matrix<double, kSize, 1> difference =
        (evaluate(above, nullptr) - evaluate(below, nullptr)) / (2.0 * kStep);
    for (int i = 0; i < kSize; ++i) {
      const double derivative =
          j < 4 ? of_turn[i * 4 + j] : of_translation[i * 3 + j - 4];
      EXPECT_NEAR(
          derivative, difference[i], 1e-6 * (1.0 + std::abs(derivative)));
      largest = std::max(largest, std::abs(derivative));
    }
  }
  EXPECT_GT(largest, 0.1);
}

TEST(LinePlaneResiduals, DerivativesAreThoseOfDifferences) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    ExpectDerivativesAreThoseOfDifferences<LineResidual, 3>(seed);
    ExpectDerivativesAreThoseOfDifferences<PlaneResidual, 1>(seed);
  }
}

TEST(LinePlaneResiduals, AreTheDistances) {
  const double turn[] = {0.0, 0.0, std::sin(M_PI / 4), std::cos(M_PI / 4)};
  const double translation[] = {1.0, 0.0, 2.0};
  // Rotated by a quarter turn about z and shifted by (1, 0, 2): (1, 3, 2). The
  // line along x through (5, 0, -2) is (3, 4) away in (y, z).
  const SurfaceMatch match{Eigen::Vector3d(3.0, 0.0, 0.0),
                           Eigen::Vector3d(5.0, 0.0, -2.0),
                           Eigen::Vector3d::UnitX()};
  double on_line[3], on_plane;
  LineResidual{match}(turn, translation, on_line);
  PlaneResidual{match}(turn, translation, &on_plane);
  EXPECT_NEAR(Eigen::Map<Eigen::Vector3d>(on_line).norm(), 5.0, 1e-12);
  EXPECT_NEAR(on_plane, -4.0, 1e-12);
}

TEST(AlignToLinesAndPlanes, FindsThePoseFromLinesPlanesOrBoth) {
  LinePlaneOptions options;
  options.huber_width = 10.0;
  options.max_num_iterations = 30;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Rigid3 pose = RandomPose(seed, 0.3, 2.0);
    const auto lines = Matches(40, pose, true, seed);
    const auto planes = Matches(60, pose, false, seed + 50);
    for (const auto& [l, p] :
         {std::pair(lines, planes), {lines, {}}, {{}, planes}}) {
      const auto summary = AlignToLinesAndPlanes(l, p, Rigid3{}, options);
      ASSERT_TRUE(summary.target_from_source) << summary.message;
      EXPECT_LT(
          AngleBetween(summary.target_from_source->rotation, pose.rotation),
          1e-6);
      EXPECT_LT(
          (summary.target_from_source->translation - pose.translation).norm(),
          1e-5);
    }
  }
}

TEST(AlignToLinesAndPlanes, AFifthOfWrongMatchesDoesLittle) {
  LinePlaneOptions options;
  options.max_num_iterations = 30;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Rigid3 pose = RandomPose(seed, 0.02, 0.2);
    auto planes = Matches(200, pose, false, seed);
    for (std::size_t i = 0; i < 40; ++i) {
      planes[i].point += 2.0 * planes[i].direction;
    }
    const auto robust = AlignToLinesAndPlanes({}, planes, Rigid3{}, options);
    ASSERT_TRUE(robust.target_from_source) << robust.message;
    const double error =
        (robust.target_from_source->translation - pose.translation).norm();
    EXPECT_LT(error, 0.1);
    LinePlaneOptions squares = options;
    squares.huber_width = 100.0;
    const auto plain = AlignToLinesAndPlanes({}, planes, Rigid3{}, squares);
    ASSERT_TRUE(plain.target_from_source);
    EXPECT_GT((plain.target_from_source->translation - pose.translation).norm(),
              error);
  }
}

TEST(AlignToLinesAndPlanes, MovesWithTheTarget) {
  LinePlaneOptions options;
  options.max_num_iterations = 30;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Rigid3 pose = RandomPose(seed, 0.1, 0.5);
    const Rigid3 move = RandomPose(seed + 77, 1.0, 30.0);
    auto lines = Matches(30, pose, true, seed);
    auto planes = Matches(50, pose, false, seed + 50);
    for (auto* matches : {&lines, &planes}) {
      for (std::size_t i = 0; i < matches->size(); ++i) {
        (*matches)[i].point += 0.05 * RandomDirection(seed * 1000 + i);
      }
    }
    const auto one = AlignToLinesAndPlanes(lines, planes, Rigid3{}, options);
    for (auto* matches : {&lines, &planes}) {
      for (SurfaceMatch& match : *matches) {
        match.point = move * match.point;
        match.direction = move.rotation * match.direction;
      }
    }
    const auto other = AlignToLinesAndPlanes(lines, planes, move, options);
    ASSERT_TRUE(one.target_from_source && other.target_from_source);
    const Rigid3 expected = move * *one.target_from_source;
    EXPECT_LT(
        AngleBetween(other.target_from_source->rotation, expected.rotation),
        1e-4);
    EXPECT_LT(
        (other.target_from_source->translation - expected.translation).norm(),
        1e-3);
    EXPECT_NEAR(other.conditioning, one.conditioning, 0.1 * one.conditioning);
  }
}

// Planes whose normals are the axes in `axes`, up to a thousandth.
std::vector<SurfaceMatch> AxisPlanes(const std::vector<int>& axes) {
  const Points sources = RandomPoints(300, 10.0, 3);
  std::vector<SurfaceMatch> planes;
  for (Eigen::Index i = 0; i < sources.cols(); ++i) {
    const int axis = axes[static_cast<std::size_t>(i) % axes.size()];
    const Eigen::Vector3d p = sources.col(i);
    const Eigen::Vector3d askew =
        1e-3 * RandomDirection(static_cast<std::uint64_t>(i));
    planes.push_back(
        {p, p, (Eigen::Vector3d::Unit(axis) + askew).normalized()});
  }
  return planes;
}

TEST(AlignToLinesAndPlanes, GroundOrATunnelAloneHoldNoPose) {
  for (const auto& axes : {std::vector<int>{2}, std::vector<int>{1, 2}}) {
    const auto summary = AlignToLinesAndPlanes({}, AxisPlanes(axes), {}, {});
    EXPECT_FALSE(summary.target_from_source);
    EXPECT_THAT(summary.message,
                ::testing::HasSubstr("six degrees of freedom"));
  }
  const auto room = AlignToLinesAndPlanes({}, AxisPlanes({0, 1, 2}), {}, {});
  EXPECT_TRUE(room.target_from_source) << room.message;
}

TEST(AlignToLinesAndPlanes, TooFewOrOnePointAreNoAnswer) {
  EXPECT_FALSE(AlignToLinesAndPlanes({}, {}, {}, {}).target_from_source);
  const auto few = Matches(5, {}, false, 1);
  const auto summary = AlignToLinesAndPlanes({}, few, {}, {});
  EXPECT_FALSE(summary.target_from_source);
  EXPECT_THAT(summary.message, ::testing::HasSubstr("5 planes are too few"));
  auto same = Matches(50, {}, false, 1);
  for (SurfaceMatch& match : same) match.source = same[0].source;
  EXPECT_FALSE(AlignToLinesAndPlanes({}, same, {}, {}).target_from_source);
}

TEST(LinePlaneOptions, ErrorNamesTheField) {
  std::string error;
  LinePlaneOptions options;
  options.huber_width = 0.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("huber_width = 0"));
  options = {};
  options.max_num_iterations = 0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("max_num_iterations = 0"));
  options = {};
  options.min_conditioning = 1.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("min_conditioning = 1"));
}

}  // namespace
}  // namespace quatro::line_plane_alignment_test
