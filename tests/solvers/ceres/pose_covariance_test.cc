// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/ceres/pose_covariance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "solvers/closed_form/rotation.h"
#include "solvers/closed_form/yaw_translation.h"
#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::pose_covariance_test {
namespace {

using ::testing::HasSubstr;

constexpr double kSigma = 0.1;  // [m]
constexpr Eigen::Index kNumMatches = 30;

Eigen::Matrix3d Exp(const Eigen::Vector3d& w) {
  return Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix();
}

Eigen::Vector3d Log(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

// Equation (2) of the header.
Vector6 Error(const Rigid3& truth, const Rigid3& estimate) {
  Vector6 error;
  error << Log(truth.rotation * estimate.rotation.transpose()),
      truth.translation - estimate.translation;
  return error;
}

// Equation (3) of the header.
Vector6 ErrorAtCenter(const Rigid3& truth,
                      const Rigid3& estimate,
                      const Eigen::Vector3d& center) {
  Vector6 error;
  error << Log(truth.rotation * estimate.rotation.transpose()),
      truth * (Inverse(estimate) * center) - center;
  return error;
}

// e^T C^-1 e, in units such that the diagonal of C is one.
double NormalizedSquare(const Eigen::VectorXd& error,
                        const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd units =
      covariance.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled =
      units.asDiagonal() * covariance * units.asDiagonal();
  const Eigen::VectorXd e = units.asDiagonal() * error;
  return e.dot(scaled.ldlt().solve(e));
}

// Statistics of numbers that should be chi-square distributed with this many
// degrees of freedom: their mean, and how many exceed the 95 % quantile. Bands
// are 3.3 standard deviations wide; one in a thousand runs would miss them.
void ExpectChiSquare(const std::vector<double>& numbers,
                     int degrees,
                     double quantile95) {
  const auto n = static_cast<double>(numbers.size());
  ASSERT_GE(numbers.size(), 100u);
  double sum = 0.0;
  double num_above = 0.0;
  for (const double number : numbers) {
    sum += number;
    num_above += number > quantile95;
  }
  EXPECT_NEAR(sum / n, degrees, 3.3 * std::sqrt(2.0 * degrees / n));
  EXPECT_NEAR(num_above / n, 0.05, 3.3 * std::sqrt(0.05 * 0.95 / n));
}

constexpr double kQuantile4 = 9.488;  // 95 % of chi-square.
constexpr double kQuantile6 = 12.592;

// A cloud that is longer than high and on a slope, so that yaw and tilt are
// correlated.
Points SlopedPoints(Eigen::Index n, std::uint64_t seed) {
  Random random(seed);
  Points points = RandomPointsInBox(n, {20.0, 8.0, 3.0}, &random);
  points.row(2) += 0.7 * points.row(0);
  return points;
}

class PoseCovarianceTest : public ::testing::Test {
 protected:
  PoseCovarianceTest() { options_.sigma = kSigma; }

  PoseCovariance Compute(const Points& source,
                         const Points& target,
                         const Rigid3& pose) const {
    return ComputePoseCovariance(source, target, pose, options_);
  }

  const Rigid3 pose_{RandomRotation(1), {3.0, -2.0, 1.0}};
  const Points source_ = SlopedPoints(kNumMatches, 1);
  const Points exact_ = pose_.Apply(source_);
  const Points target_ = exact_ + RandomPoints(kNumMatches, kSigma, 2);
  PoseCovarianceOptions options_;
};

// 500 problems with the source about `middle`. Errors are those at the center,
// or of the translation itself if `translations`.
void ExpectConsistent(const Eigen::Vector3d& middle, bool translations) {
  PoseCovarianceOptions options;
  options.sigma = kSigma;
  std::vector<double> at_center;
  std::vector<double> as_given;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const Points source = SlopedPoints(kNumMatches, seed).colwise() + middle;
    const Rigid3 truth{RandomRotation(seed), {10.0, 20.0, -5.0}};
    const Points target =
        truth.Apply(source) + RandomPoints(kNumMatches, kSigma, 1000 + seed);
    const auto estimate =
        EstimateRigid(source, target, Weights::Ones(kNumMatches));
    ASSERT_TRUE(estimate.has_value());
    const Rigid3& pose = estimate->target_from_source;
    const PoseCovariance result =
        ComputePoseCovariance(source, target, pose, options);
    ASSERT_TRUE(result.covariance.has_value()) << result.message;
    EXPECT_EQ(result.rank, 6);
    EXPECT_LT(result.offset, 1e-3);
    at_center.push_back(
        NormalizedSquare(ErrorAtCenter(truth, pose, result.center),
                         *result.covariance_at_center));
    as_given.push_back(
        NormalizedSquare(Error(truth, pose), *result.covariance));
  }
  ExpectChiSquare(at_center, 6, kQuantile6);
  if (translations) ExpectChiSquare(as_given, 6, kQuantile6);
}

TEST(PoseCovarianceMonteCarlo, ErrorsAreWithinTheChiSquareBand) {
  ExpectConsistent({5.0, -3.0, 1.0}, true);
}

TEST(PoseCovarianceMonteCarlo, AlsoFarFromTheOrigin) {
  ExpectConsistent({100.0, -70.0, 10.0}, true);
  ExpectConsistent({1e5, -2e5, 1e4}, false);
  ExpectConsistent({1e7, -2e7, 1e7}, false);
}

// The estimator does not estimate the tilt. Its effect on the yaw is in the
// covariance.
TEST(PoseCovarianceMonteCarlo, AssumedTiltIsAccountedFor) {
  for (const double tilt_std : {1e-9, 0.01}) {
    PoseCovarianceOptions options;
    options.sigma = kSigma;
    options.model = PoseModel::kYawTranslation;
    options.tilt_std = tilt_std;
    std::vector<double> all_six;
    std::vector<double> estimated;  // Yaw and translation.
    for (std::uint64_t seed = 1; seed <= 500; ++seed) {
      const Points source = SlopedPoints(kNumMatches, seed);
      Random random(seed);
      const Eigen::Vector3d tilt(tilt_std * RandomNormal(random),
                                 tilt_std * RandomNormal(random),
                                 0.0);
      const Rigid3 truth{
          Exp(tilt) * RotationZ(0.01 * static_cast<double>(seed)),
          {10.0, 20.0, -5.0}};
      const Points target =
          truth.Apply(source) + RandomPoints(kNumMatches, kSigma, 1000 + seed);
      const auto estimate =
          EstimateYawTranslation(source, target, Weights::Ones(kNumMatches));
      ASSERT_TRUE(estimate.has_value());
      const Rigid3& pose = estimate->target_from_source;
      const PoseCovariance result =
          ComputePoseCovariance(source, target, pose, options);
      ASSERT_TRUE(result.covariance.has_value()) << result.message;
      EXPECT_EQ(result.rank, 4);
      EXPECT_LT(result.offset, 1e-3);
      const Vector6 error = Error(truth, pose);
      all_six.push_back(NormalizedSquare(error, *result.covariance));
      estimated.push_back(NormalizedSquare(
          error.tail<4>(), result.covariance->bottomRightCorner<4, 4>()));
    }
    ExpectChiSquare(all_six, 6, kQuantile6);
    ExpectChiSquare(estimated, 4, kQuantile4);
  }
}

// Matches that constrain the tilt about as well as the INS does.
TEST(PoseCovarianceMonteCarlo, FusedWithAnIns) {
  constexpr double kAngleStd = 0.02;
  PoseCovarianceOptions options;
  options.sigma = kSigma;
  std::vector<double> numbers;
  double information_of_matches = 0.0;
  double information_of_all = 0.0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    const Points source = RandomPointsInBox(8, {3.0, 2.0, 1.0}, &random);
    const Rigid3 truth{RandomRotation(seed), {1.0, 2.0, -5.0}};
    const Points target =
        truth.Apply(source) + RandomPoints(8, kSigma, 1000 + seed);
    VerticalPrior prior;
    prior.angle_std = kAngleStd;
    const Eigen::Vector3d tilt = RandomPoints(1, kAngleStd, 2000 + seed).col(0);
    prior.up_in_target = Exp(tilt) * truth.rotation * prior.up_in_source;
    const auto fused = RefineWithIns(source, target, kSigma, truth, prior);
    ASSERT_TRUE(fused.has_value());
    const Rigid3& pose = fused->target_from_source;
    const auto without = ComputePoseCovariance(source, target, pose, options);
    PoseCovarianceOptions with_prior = options;
    with_prior.prior = prior;
    const auto result = ComputePoseCovariance(source, target, pose, with_prior);
    ASSERT_TRUE(result.covariance.has_value()) << result.message;
    EXPECT_LT(result.offset, 1e-3);
    numbers.push_back(NormalizedSquare(Error(truth, pose), *result.covariance));
    information_of_matches += without.covariance->inverse().norm();
    information_of_all += result.covariance->inverse().norm();
  }
  ExpectChiSquare(numbers, 6, kQuantile6);
  EXPECT_GT(information_of_all, 1.05 * information_of_matches);
}

TEST_F(PoseCovarianceTest, IsTwiceTheInverseCurvatureOfTheClosedForm) {
  const PoseCovariance result = Compute(source_, exact_, pose_);
  const auto closed_form =
      EstimateRigid(source_, exact_, Weights::Ones(kNumMatches));
  const Matrix6 expected =
      2.0 * kSigma * kSigma * closed_form->curvature.inverse();
  ASSERT_TRUE(result.covariance_at_center.has_value());
  EXPECT_LT((*result.covariance_at_center - expected).norm(),
            1e-9 * expected.norm());
  EXPECT_TRUE(result.unobservable.empty()) << result.unobservable[0].Describe();
  EXPECT_EQ(result.message, "computed");
}

TEST_F(PoseCovarianceTest, OfManyMatchesIsTheSameWithoutCeres) {
  options_.prior.emplace();
  options_.prior->up_in_target = pose_.rotation.col(2);
  for (const PoseModel model :
       {PoseModel::kRigid, PoseModel::kYawTranslation}) {
    options_.model = model;
    options_.up_in_target = RandomDirection(5);
    options_.max_ceres_matches = kNumMatches;
    const PoseCovariance by_ceres = Compute(source_, target_, pose_);
    options_.max_ceres_matches = kNumMatches - 1;
    const PoseCovariance summed = Compute(source_, target_, pose_);
    EXPECT_LT((*by_ceres.covariance - *summed.covariance).norm(),
              1e-9 * summed.covariance->norm());
    EXPECT_EQ(by_ceres.rank, summed.rank);
    EXPECT_NEAR(by_ceres.offset, summed.offset, 1e-9);
  }
}

Matrix6 Blocks(const Eigen::Matrix3d& diagonal,
               const Eigen::Matrix3d& below = Eigen::Matrix3d::Zero()) {
  Matrix6 matrix = Matrix6::Zero();
  matrix.topLeftCorner<3, 3>() = diagonal;
  matrix.bottomRightCorner<3, 3>() = diagonal;
  matrix.bottomLeftCorner<3, 3>() = below;
  return matrix;
}

Eigen::Matrix3d Cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d cross;
  cross << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return cross;
}

TEST_F(PoseCovarianceTest, MovesWithTheTargetFrame) {
  const Rigid3 moved_from_target{RandomRotation(7), {5.0, 6.0, -7.0}};
  for (const PoseModel model :
       {PoseModel::kRigid, PoseModel::kYawTranslation}) {
    options_.model = model;
    options_.up_in_target = RandomDirection(6);
    const PoseCovariance before = Compute(source_, target_, pose_);
    options_.up_in_target = moved_from_target.rotation * options_.up_in_target;
    const PoseCovariance after = Compute(
        source_, moved_from_target.Apply(target_), moved_from_target * pose_);
    const Matrix6 J = Blocks(moved_from_target.rotation);
    const Matrix6 expected = J * *before.covariance * J.transpose();
    EXPECT_LT((*after.covariance - expected).norm(), 1e-9 * expected.norm());
    EXPECT_LT((after.center - moved_from_target * before.center).norm(), 1e-9);
    EXPECT_NEAR(after.offset, before.offset, 1e-6);
  }
}

// The d of the new pose is the motion of the source's new origin.
TEST_F(PoseCovarianceTest, MovesWithTheSourceFrame) {
  const Rigid3 moved_from_source{RandomRotation(8), {50.0, 6.0, -7.0}};
  const PoseCovariance before = Compute(source_, target_, pose_);
  const Rigid3 after_pose = pose_ * Inverse(moved_from_source);
  const PoseCovariance after =
      Compute(moved_from_source.Apply(source_), target_, after_pose);
  const Matrix6 J = Blocks(Eigen::Matrix3d::Identity(),
                           -Cross(after_pose.translation - pose_.translation));
  const Matrix6 expected = J * *before.covariance * J.transpose();
  EXPECT_GT((expected - *before.covariance).norm(), before.covariance->norm());
  EXPECT_LT((*after.covariance - expected).norm(), 1e-9 * expected.norm());
}

TEST_F(PoseCovarianceTest, SwappingSourceAndTargetIsTheInversesCovariance) {
  const PoseCovariance forward = Compute(source_, exact_, pose_);
  const PoseCovariance backward = Compute(exact_, source_, Inverse(pose_));
  const Eigen::Matrix3d source_from_target = pose_.rotation.transpose();
  const Matrix6 J = Blocks(-source_from_target,
                           -source_from_target * Cross(pose_.translation));
  const Matrix6 expected = J * *forward.covariance * J.transpose();
  EXPECT_LT((*backward.covariance - expected).norm(), 1e-9 * expected.norm());
}

TEST_F(PoseCovarianceTest, FourCopiesAreTwiceAsCertain) {
  Points source(3, 4 * kNumMatches);
  source << source_, source_, source_, source_;
  Points target(3, 4 * kNumMatches);
  target << target_, target_, target_, target_;
  const Matrix6 once = *Compute(source_, target_, pose_).covariance;
  const Matrix6 copies = *Compute(source, target, pose_).covariance;
  EXPECT_LT((once - 4.0 * copies).norm(), 1e-9 * once.norm());
}

TEST_F(PoseCovarianceTest, OffsetIsTheDistanceFromTheMinimum) {
  const auto best = EstimateRigid(source_, target_, Weights::Ones(kNumMatches));
  const Rigid3& pose = best->target_from_source;
  const PoseCovariance at_best = Compute(source_, target_, pose);
  EXPECT_LT(at_best.offset, 1e-6);
  Rigid3 off = pose;
  off.rotation = Exp(Eigen::Vector3d(1e-3, -2e-3, 5e-4)) * off.rotation;
  off.translation += Eigen::Vector3d(0.01, 0.02, 0.0);
  EXPECT_NEAR(
      Compute(source_, target_, off).offset,
      std::sqrt(NormalizedSquare(Error(pose, off), *at_best.covariance)),
      0.05);
}

TEST_F(PoseCovarianceTest, SigmaCanBeTheResiduals) {
  const Points target = exact_ + RandomPoints(kNumMatches, 0.5, 3);
  const auto best = EstimateRigid(source_, target, Weights::Ones(kNumMatches));
  const Rigid3& pose = best->target_from_source;
  const PoseCovariance assumed = Compute(source_, target, pose);
  EXPECT_EQ(assumed.sigma, kSigma);
  EXPECT_NEAR(*assumed.estimated_sigma, 0.5, 0.15);
  options_.sigma_from_residuals = true;
  const PoseCovariance measured = Compute(source_, target, pose);
  EXPECT_EQ(measured.sigma, *assumed.estimated_sigma);
  const double ratio = measured.sigma / kSigma;
  EXPECT_LT((*measured.covariance - ratio * ratio * *assumed.covariance).norm(),
            1e-9 * measured.covariance->norm());
  // Zero residuals do not mean certainty.
  EXPECT_EQ(Compute(source_, exact_, pose_).sigma, kSigma / 3.0);
}

// The rotations of `result` that nothing constrains.
std::vector<UnobservableDirection> Unobservable(const PoseCovariance& result,
                                                Freedom freedom,
                                                UnobservableReason reason) {
  std::vector<UnobservableDirection> directions;
  for (const UnobservableDirection& direction : result.unobservable) {
    if (direction.freedom == freedom && direction.reason == reason) {
      directions.push_back(direction);
    }
  }
  return directions;
}

void ExpectNoCovariance(const PoseCovariance& result) {
  EXPECT_FALSE(result.covariance.has_value());
  EXPECT_FALSE(result.covariance_at_center.has_value());
  EXPECT_FALSE(result.unobservable.empty());
  EXPECT_THAT(result.message, HasSubstr("matches constrain"));
  EXPECT_THAT(result.message, HasSubstr(result.unobservable[0].Describe()));
}

TEST_F(PoseCovarianceTest, NoMatchesHoldNothing) {
  const PoseCovariance result = Compute(Points(3, 0), Points(3, 0), pose_);
  ExpectNoCovariance(result);
  EXPECT_EQ(result.rank, 0);
  EXPECT_EQ(result.unobservable.size(), 6u);
  EXPECT_FALSE(result.estimated_sigma.has_value());
}

TEST_F(PoseCovarianceTest, OneMatchHoldsAPositionAndNoTurnAboutIt) {
  const PoseCovariance result =
      Compute(source_.leftCols(1), target_.leftCols(1), pose_);
  ExpectNoCovariance(result);
  EXPECT_EQ(result.rank, 3);
  EXPECT_EQ(result.unobservable.size(), 3u);
  for (const auto& direction :
       Unobservable(result, Freedom::kRotation, UnobservableReason::kNoData)) {
    EXPECT_LT((direction.point - exact_.col(0)).norm(), 1e-9);
    EXPECT_FALSE(direction.standard_deviation.has_value());
  }
  options_.model = PoseModel::kYawTranslation;
  const PoseCovariance yaw =
      Compute(source_.leftCols(1), target_.leftCols(1), pose_);
  ExpectNoCovariance(yaw);
  EXPECT_EQ(yaw.rank, 3);
  const auto turns =
      Unobservable(yaw, Freedom::kRotation, UnobservableReason::kNoData);
  ASSERT_EQ(turns.size(), 1u);
  EXPECT_EQ(turns[0].axis, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(Unobservable(yaw, Freedom::kRotation, UnobservableReason::kAssumed)
                .size(),
            2u);
}

TEST_F(PoseCovarianceTest, IdenticalMatchesAreOne) {
  const Points source = source_.col(0).replicate(1, 20);
  const PoseCovariance result = Compute(source, pose_.Apply(source), pose_);
  ExpectNoCovariance(result);
  EXPECT_EQ(result.rank, 3);
  EXPECT_EQ(
      Unobservable(result, Freedom::kRotation, UnobservableReason::kNoData)
          .size(),
      3u);
}

TEST_F(PoseCovarianceTest, TwoMatchesHoldAYawButNoTurnAboutTheirLine) {
  const PoseCovariance result =
      Compute(source_.leftCols(2), exact_.leftCols(2), pose_);
  ExpectNoCovariance(result);
  EXPECT_EQ(result.rank, 5);
  ASSERT_EQ(result.unobservable.size(), 1u);
  const Eigen::Vector3d line = (exact_.col(1) - exact_.col(0)).normalized();
  EXPECT_NEAR(std::abs(result.unobservable[0].axis.dot(line)), 1.0, 1e-9);

  options_.model = PoseModel::kYawTranslation;
  const PoseCovariance yaw =
      Compute(source_.leftCols(2), exact_.leftCols(2), pose_);
  EXPECT_EQ(yaw.rank, 4);
  EXPECT_TRUE(yaw.covariance.has_value()) << yaw.message;
}

// A line far from the origin, where rounding moves its points off the line.
TEST_F(PoseCovarianceTest, MatchesOnALineHoldNoTurnAboutIt) {
  for (const double far : {0.0, 1e5, 1e7}) {
    const Eigen::Vector3d line = RandomDirection(9);
    Points source(3, 20);
    for (int i = 0; i < 20; ++i) {
      source.col(i) =
          Eigen::Vector3d(far, -far, far) + 0.5 * static_cast<double>(i) * line;
    }
    const PoseCovariance result = Compute(source, pose_.Apply(source), pose_);
    ExpectNoCovariance(result);
    ASSERT_EQ(result.unobservable.size(), 1u) << far << ": " << result.message;
    EXPECT_EQ(result.unobservable[0].freedom, Freedom::kRotation);
    EXPECT_EQ(result.unobservable[0].reason, UnobservableReason::kNoData);
    EXPECT_NEAR(
        std::abs(result.unobservable[0].axis.dot(pose_.rotation * line)),
        1.0,
        1e-9)
        << far;
  }
}

// Noise alone would give 1 / sqrt(2 n) rad, which is false certainty.
TEST_F(PoseCovarianceTest, APoleHoldsNoTurnAboutItHoweverManyItsMatches) {
  Points source = Points::Zero(3, 2000);
  source.row(2).setLinSpaced(0.0, 6.0);
  const Points target =
      pose_.Apply(source) + RandomPoints(2000, kSigma / std::sqrt(2.0), 4);
  source += RandomPoints(2000, kSigma / std::sqrt(2.0), 5);
  const PoseCovariance rigid = Compute(source, target, pose_);
  ExpectNoCovariance(rigid);
  EXPECT_EQ(rigid.rank, 6);  // Numerically.
  ASSERT_EQ(rigid.unobservable.size(), 1u);
  EXPECT_EQ(rigid.unobservable[0].reason, UnobservableReason::kWithinNoise);
  EXPECT_GT(std::abs(rigid.unobservable[0].axis.dot(pose_.rotation.col(2))),
            0.999);

  options_.model = PoseModel::kYawTranslation;
  options_.up_in_target = pose_.rotation.col(2);
  const PoseCovariance yaw = Compute(source, target, pose_);
  ExpectNoCovariance(yaw);
  EXPECT_EQ(yaw.unobservable[0].reason, UnobservableReason::kWithinNoise);

  // With an INS the tilt is constrained, but the yaw still is not.
  options_.model = PoseModel::kRigid;
  options_.prior.emplace();
  options_.prior->up_in_target = pose_.rotation.col(2);
  const PoseCovariance fused = Compute(source, target, pose_);
  ExpectNoCovariance(fused);
  ASSERT_EQ(fused.unobservable.size(), 1u);
  EXPECT_EQ(fused.unobservable[0].reason, UnobservableReason::kWithinNoise);
}

TEST_F(PoseCovarianceTest, AnInsHoldsTheTiltThatALevelLineDoesNot) {
  Points source = Points::Zero(3, 20);
  source.row(0).setLinSpaced(-10.0, 10.0);
  EXPECT_FALSE(Compute(source, pose_.Apply(source), pose_).covariance);
  options_.prior.emplace();
  options_.prior->up_in_target = pose_.rotation.col(2);
  const PoseCovariance result = Compute(source, pose_.Apply(source), pose_);
  ASSERT_TRUE(result.covariance.has_value()) << result.message;
  const Eigen::Vector3d line = pose_.rotation.col(0);
  EXPECT_NEAR(
      std::sqrt(line.dot(result.covariance->topLeftCorner<3, 3>() * line)),
      options_.prior->angle_std,
      1e-6);
}

TEST_F(PoseCovarianceTest, WhatIsUncertainIsNamedWithItsDeviation) {
  options_.max_rotation_std = 1e-9;
  options_.max_translation_std = 1e-9;
  const PoseCovariance result = Compute(source_, target_, pose_);
  ASSERT_TRUE(result.covariance.has_value());
  EXPECT_EQ(result.unobservable.size(), 6u);
  const auto positions = Unobservable(
      result, Freedom::kTranslation, UnobservableReason::kUncertain);
  ASSERT_EQ(positions.size(), 3u);
  for (const UnobservableDirection& direction : positions) {
    EXPECT_NEAR(*direction.standard_deviation,
                kSigma / std::sqrt(static_cast<double>(kNumMatches)),
                1e-9);
  }
}

TEST_F(PoseCovarianceTest, RollAndPitchThatWereAssumedAreNotCertain) {
  options_.model = PoseModel::kYawTranslation;
  options_.tilt_std = 0.02;
  options_.up_in_target = RandomDirection(3);
  const PoseCovariance result = Compute(source_, target_, pose_);
  const auto assumed =
      Unobservable(result, Freedom::kRotation, UnobservableReason::kAssumed);
  ASSERT_EQ(assumed.size(), 2u);
  for (const UnobservableDirection& direction : assumed) {
    EXPECT_NEAR(direction.axis.dot(options_.up_in_target), 0.0, 1e-12);
    EXPECT_EQ(direction.standard_deviation, 0.02);
    const Eigen::Vector3d& w = direction.axis;
    EXPECT_NEAR(w.dot(result.covariance->topLeftCorner<3, 3>() * w),
                0.02 * 0.02,
                1e-12);
  }
  EXPECT_GT(result.covariance->diagonal().minCoeff(), 0.0);
}

TEST_F(PoseCovarianceTest, WhatIsNotFiniteIsRefused) {
  Points broken = source_;
  broken(1, 3) = std::numeric_limits<double>::quiet_NaN();
  Rigid3 nowhere = pose_;
  nowhere.translation.x() = std::numeric_limits<double>::infinity();
  for (const PoseCovariance& result : {Compute(broken, target_, pose_),
                                       Compute(source_, broken, pose_),
                                       Compute(source_, target_, nowhere)}) {
    EXPECT_FALSE(result.covariance.has_value());
    EXPECT_THAT(result.message, HasSubstr("not finite"));
  }
}

TEST_F(PoseCovarianceTest, SizesThatDifferAreRefused) {
  const auto result = Compute(source_, target_.leftCols(2), pose_);
  EXPECT_FALSE(result.covariance.has_value());
  EXPECT_THAT(result.message, HasSubstr("but 2 target points"));
}

TEST_F(PoseCovarianceTest, OptionsOutOfRangeAreNamedAndNothingIsTried) {
  const auto expect_error = [&](const auto& change, const char* field) {
    PoseCovarianceOptions options;
    change(&options);
    std::string error;
    EXPECT_FALSE(options.IsValid(&error)) << field;
    EXPECT_THAT(error, HasSubstr(field));
    const auto result = ComputePoseCovariance(source_, target_, pose_, options);
    EXPECT_EQ(result.message, error);
    EXPECT_FALSE(result.covariance.has_value());
  };
  using Options = PoseCovarianceOptions*;
  expect_error([](Options o) { o->sigma = 0.0; }, "sigma = 0");
  expect_error([](Options o) { o->tilt_std = 0.0; }, "tilt_std = 0");
  expect_error([](Options o) { o->max_rotation_std = -1.0; },
               "max_rotation_std = -1");
  expect_error([](Options o) { o->max_translation_std = NAN; },
               "max_translation_std = nan");
  expect_error([](Options o) { o->min_lever = -1.0; }, "min_lever = -1");
  expect_error([](Options o) { o->max_ceres_matches = -1; },
               "max_ceres_matches = -1");
  expect_error([](Options o) { o->up_in_target *= 2.0; }, "up_in_target");
  expect_error([](Options o) { o->prior.emplace().angle_std = 0.0; },
               "angle_std = 0");
}

}  // namespace
}  // namespace quatro::pose_covariance_test
