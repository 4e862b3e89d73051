// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Tests that ICP, G-ICP and VG-ICP share.

#include "solvers/local/local_alignment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "features/base/degree.h"
#include "solvers/local/gicp.h"
#include "solvers/local/icp.h"
#include "solvers/local/vgicp.h"
#include "tests/support/alignment_problems.h"
#include "tests/support/described_clouds.h"
#include "tests/support/random_problems.h"

namespace quatro::local_alignment_test {
namespace {

using ::testing::HasSubstr;

enum class Method { kIcp, kGicp, kVgicp };

VgicpOptions With(const LocalAlignmentOptions& options) {
  VgicpOptions vgicp;
  vgicp.alignment = options;
  return vgicp;
}

AlignmentSummary Solve(Method method,
                       const Points& source,
                       const Points& target,
                       const Rigid3& initial,
                       const LocalAlignmentOptions& options) {
  switch (method) {
    case Method::kIcp:
      return SolveIcp(source, target, initial, options);
    case Method::kGicp:
      return SolveGicp(source, target, initial, GicpOptions{options});
    case Method::kVgicp:
      break;
  }
  return SolveVgicp(source, target, initial, With(options));
}

// A cloud, its tree and its normals.
struct Prepared {
  explicit Prepared(const Points& points)
      : tree(points),
        normals(EstimateNearestNormals(tree, 20, 1)),
        described(MakeDescribedCloud(points, normals)) {}
  const DescribedCloud& cloud() const { return described; }

  KdTree tree;
  Points normals;
  DescribedCloud described;
};

std::unique_ptr<AlignmentTerms> MakeTerms(Method method,
                                          const Prepared& source,
                                          const Prepared& target,
                                          const LocalAlignmentOptions& o) {
  const double distance = o.max_correspondence_distance;
  switch (method) {
    case Method::kIcp:
      return MakeIcpTerms(source.tree.points(), target.tree, distance);
    case Method::kGicp:
      return MakeGicpTerms(source.cloud(), target.cloud(), distance, 1e-3);
    case Method::kVgicp:
      break;
  }
  return MakeVgicpTerms(source.cloud(), target.cloud(), With(o));
}

class LocalAlignmentTest : public ::testing::TestWithParam<Method> {
 protected:
  const Rigid3 truth_{
      RotationZ(0.4) *
          Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()).toRotationMatrix(),
      {2.0, -1.0, 0.3}};
  const Points target_ = RandomStreet(4000, 0.01, 2);
  const Points source_ = Inverse(truth_).Apply(RandomStreet(4000, 0.01, 1));
  LocalAlignmentOptions options_;

  // The guess is off by 3 deg about the middle of the street and by 0.5 m.
  Rigid3 Start(std::uint64_t seed) const {
    Vector6 delta;
    delta << 3.0 * kDegree * RandomDirection(seed),
        0.5 * RandomDirection(seed + 1000);
    const Rigid3 off = Perturbed({}, delta);
    return off * truth_;
  }

  AlignmentSummary Solve(const Points& source,
                         const Points& target,
                         const Rigid3& initial) const {
    return local_alignment_test::Solve(
        GetParam(), source, target, initial, options_);
  }

  bool IsIcp() const { return GetParam() == Method::kIcp; }
};

const char* NameOf(const ::testing::TestParamInfo<Method>& test) {
  if (test.param == Method::kIcp) return "Icp";
  return test.param == Method::kGicp ? "Gicp" : "Vgicp";
}

// Methods whose q and p can coincide: a voxel's mean never coincides with a
// point.
class PointwiseAlignmentTest : public LocalAlignmentTest {};

// Methods that use surfaces. In ICP, points of a plane resist sliding.
class SurfaceAlignmentTest : public LocalAlignmentTest {};

INSTANTIATE_TEST_SUITE_P(Methods,
                         LocalAlignmentTest,
                         ::testing::Values(Method::kIcp,
                                           Method::kGicp,
                                           Method::kVgicp),
                         NameOf);

INSTANTIATE_TEST_SUITE_P(Methods,
                         PointwiseAlignmentTest,
                         ::testing::Values(Method::kIcp, Method::kGicp),
                         NameOf);

INSTANTIATE_TEST_SUITE_P(Methods,
                         SurfaceAlignmentTest,
                         ::testing::Values(Method::kGicp, Method::kVgicp),
                         NameOf);

TEST_P(LocalAlignmentTest, ConvergesFromThreeDegreesAndHalfAMetre) {
  options_.max_num_iterations = 100;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const AlignmentSummary summary = Solve(source_, target_, Start(seed));
    ASSERT_EQ(summary.termination, AlignmentTermination::kConverged)
        << summary.message;
    EXPECT_LE((*summary.target_from_source * truth_.translation -
               truth_ * truth_.translation)
                  .norm(),
              IsIcp() ? 0.05 : 0.02)
        << seed;
    EXPECT_LE(
        AngleBetween(summary.target_from_source->rotation, truth_.rotation),
        0.3 * kDegree)
        << seed;
    EXPECT_GT(summary.num_inliers, 3000);
    EXPECT_LT(summary.cost, summary.iterations.front().cost);
  }
}

// Implements the definition of (1) independently of the solver.
TEST_P(LocalAlignmentTest, HessianIsThatOfFiniteDifferences) {
  for (const RobustKernelType type :
       {RobustKernelType::kNone, RobustKernelType::kCauchy}) {
    options_.kernel = {type, 0.5};
    const AlignmentSummary summary = Solve(source_, target_, Start(1));
    ASSERT_TRUE(summary.IsUsable()) << summary.message;
    const Rigid3& pose = *summary.target_from_source;
    const Prepared source(source_);
    const Prepared target(target_);
    const auto terms_at_pose =
        FixTerms(pose, MakeTerms(GetParam(), source, target, options_).get());
    EXPECT_EQ(static_cast<Eigen::Index>(terms_at_pose.size()),
              summary.num_inliers);
    EXPECT_NEAR(FixedCost(terms_at_pose, pose, options_.kernel),
                summary.cost,
                1e-9 * summary.cost);

    Matrix6 hessian = Matrix6::Zero();
    constexpr double kStep = 1e-5;
    for (const FixedTerm& one : terms_at_pose) {
      Eigen::Matrix<double, 3, 6> jacobian;
      for (int k = 0; k < 6; ++k) {
        const Vector6 delta = kStep * Vector6::Unit(k);
        jacobian.col(k) = -(Perturbed(pose, delta) * one.source -
                            Perturbed(pose, -delta) * one.source) /
                          (2.0 * kStep);
      }
      const Eigen::Vector3d e = one.term.target - pose * one.source;
      const double s = e.dot(one.term.information * e);
      hessian += options_.kernel.Weight(s) * jacobian.transpose() *
                 one.term.information * jacobian;
    }
    EXPECT_LE((hessian - summary.hessian).norm(), 1e-7 * hessian.norm());
    EXPECT_EQ(summary.hessian, summary.hessian.transpose());
  }
}

// Without residuals, the Gauss-Newton Hessian is the full second derivative.
TEST_P(PointwiseAlignmentTest, HessianIsTheSecondDifferenceOfThePerfectCost) {
  const Points target = truth_.Apply(source_);
  const AlignmentSummary summary = Solve(source_, target, truth_);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  const Rigid3& pose = *summary.target_from_source;
  const Prepared a(source_);
  const Prepared b(target);
  const auto terms_at_pose =
      FixTerms(pose, MakeTerms(GetParam(), a, b, options_).get());
  constexpr double kStep = 1e-3;
  Matrix6 second;
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < 6; ++k) {
      const auto cost = [&](double x, double y) {
        return FixedCost(
            terms_at_pose,
            Perturbed(pose,
                      kStep * (x * Vector6::Unit(i) + y * Vector6::Unit(k))));
      };
      second(i, k) = (cost(1, 1) - cost(1, -1) - cost(-1, 1) + cost(-1, -1)) /
                     (4.0 * kStep * kStep);
    }
  }
  EXPECT_LE((0.5 * second - summary.hessian).norm(),
            1e-4 * summary.hessian.norm());
}

TEST_P(LocalAlignmentTest, ConvergesWhereCeresDoes) {
  options_.translation_tolerance = 1e-9;
  options_.rotation_tolerance = 1e-9;
  options_.max_num_iterations = 300;
  const Prepared source(source_);
  const Prepared target(target_);
  for (const RobustKernelType type : {RobustKernelType::kNone,
                                      RobustKernelType::kHuber,
                                      RobustKernelType::kCauchy,
                                      RobustKernelType::kGemanMcClure}) {
    SCOPED_TRACE(static_cast<int>(type));
    options_.kernel = {type, IsIcp() ? 0.3 : 1.0};
    const AlignmentSummary summary = Solve(source_, target_, Start(2));
    ASSERT_EQ(summary.termination, AlignmentTermination::kConverged)
        << summary.message;
    const Rigid3& pose = *summary.target_from_source;
    const auto terms_at_pose =
        FixTerms(pose, MakeTerms(GetParam(), source, target, options_).get());
    const Rigid3 by_ceres =
        SolveFixedByCeres(terms_at_pose, pose, options_.kernel);
    EXPECT_LE((by_ceres.translation - pose.translation).norm(), 1e-6);
    EXPECT_LE(AngleBetween(by_ceres.rotation, pose.rotation), 1e-6);

    // Ceres returns from another start, so the results do not agree merely
    // because Ceres took no step.
    Vector6 delta;
    delta << 1e-3, -1e-3, 1e-3, 0.01, 0.01, -0.01;
    const Rigid3 again = SolveFixedByCeres(
        terms_at_pose, Perturbed(pose, delta), options_.kernel);
    EXPECT_LE((again.translation - pose.translation).norm(), 1e-5);
    EXPECT_LE(AngleBetween(again.rotation, pose.rotation), 1e-5);
  }
}

TEST_P(LocalAlignmentTest, StopsOnceAStepIsWithinBothTolerances) {
  const auto expect_stop = [&] {
    const AlignmentSummary summary = Solve(source_, target_, Start(3));
    ASSERT_EQ(summary.termination, AlignmentTermination::kConverged)
        << summary.message;
    const auto is_within = [&](const AlignmentIteration& iteration) {
      return iteration.translation_step <= options_.translation_tolerance &&
             iteration.rotation_step <= options_.rotation_tolerance;
    };
    for (std::size_t i = 0; i < summary.iterations.size(); ++i) {
      EXPECT_EQ(is_within(summary.iterations[i]),
                i + 1 == summary.iterations.size())
          << i;
    }
  };
  options_.max_num_iterations = 300;
  options_.translation_tolerance = 1e-5;
  options_.rotation_tolerance = 1.0;
  expect_stop();
  options_.translation_tolerance = 1.0;
  options_.rotation_tolerance = 1e-6;
  expect_stop();
}

TEST_P(LocalAlignmentTest, SaysSoIfIterationsRunOut) {
  options_.max_num_iterations = 1;
  const AlignmentSummary summary = Solve(source_, target_, Start(4));
  EXPECT_EQ(summary.termination, AlignmentTermination::kNotConverged);
  EXPECT_THAT(summary.message, HasSubstr("after 1 iterations"));
  EXPECT_EQ(summary.iterations.size(), 1u);
  EXPECT_TRUE(summary.IsUsable());
}

TEST_P(LocalAlignmentTest, NumberOfThreadsDoesNotMatterBitForBit) {
  const AlignmentSummary one = Solve(source_, target_, Start(5));
  ASSERT_TRUE(one.IsUsable()) << one.message;
  for (const int num_threads : {2, 3, 0}) {
    options_.num_threads = num_threads;
    const AlignmentSummary many = Solve(source_, target_, Start(5));
    ASSERT_TRUE(many.IsUsable()) << many.message;
    EXPECT_EQ(many.target_from_source->ToMatrix(),
              one.target_from_source->ToMatrix());
    EXPECT_EQ(many.hessian, one.hessian);
    EXPECT_EQ(many.cost, one.cost);
  }
}

TEST_P(LocalAlignmentTest, MovesWithItsClouds) {
  options_.translation_tolerance = 1e-8;
  options_.rotation_tolerance = 1e-8;
  options_.max_num_iterations = 300;
  const AlignmentSummary here = Solve(source_, target_, Start(6));
  ASSERT_TRUE(here.IsUsable()) << here.message;
  const Rigid3 elsewhere_from_source{RandomRotation(1), {5.0, -8.0, 1.0}};
  // A translation by whole voxels without a rotation: VG-ICP's grid does not
  // move.
  const Rigid3 elsewhere_from_target{
      IsIcp() ? RandomRotation(2) : Eigen::Matrix3d::Identity(),
      {20.0, 30.0, -4.0}};
  const AlignmentSummary there =
      Solve(elsewhere_from_source.Apply(source_),
            elsewhere_from_target.Apply(target_),
            elsewhere_from_target * Start(6) * Inverse(elsewhere_from_source));
  ASSERT_TRUE(there.IsUsable()) << there.message;
  const Rigid3 back = Inverse(elsewhere_from_target) *
                      *there.target_from_source * elsewhere_from_source;
  EXPECT_LE((back.translation - here.target_from_source->translation).norm(),
            1e-6);
  EXPECT_LE(AngleBetween(back.rotation, here.target_from_source->rotation),
            1e-6);
}

TEST_P(LocalAlignmentTest, LargeCoordinatesLoseNothing) {
  const AlignmentSummary here = Solve(source_, target_, Start(7));
  ASSERT_TRUE(here.IsUsable()) << here.message;
  const Rigid3 far{Eigen::Matrix3d::Identity(), {1e7, -1e7, 1e3}};
  const AlignmentSummary there = Solve(
      far.Apply(source_), far.Apply(target_), far * Start(7) * Inverse(far));
  ASSERT_EQ(there.termination, here.termination) << there.message;
  EXPECT_EQ(there.iterations.size(), here.iterations.size());
  EXPECT_EQ(there.num_inliers, here.num_inliers);
  const Points moved = here.target_from_source->Apply(source_);
  const Points moved_there =
      there.target_from_source->Apply(far.Apply(source_)).colwise() -
      far.translation;
  EXPECT_LE((moved - moved_there).colwise().norm().maxCoeff(), 1e-5);
}

TEST_P(LocalAlignmentTest, KernelTakesWeightFromWhatMovedByItself) {
  // A quarter of the ground is 0.3 m higher.
  Points moved = truth_.Apply(source_);
  for (auto point : moved.colwise()) {
    if (point.x() < -4.0 && point.z() < -1.9) point.z() += 0.3;
  }
  const Points source = Inverse(truth_).Apply(moved);
  const auto error = [&](RobustKernelType type, double width) {
    options_.kernel = {type, width};
    options_.max_num_iterations = 200;
    const AlignmentSummary summary = Solve(source, target_, truth_);
    EXPECT_TRUE(summary.IsUsable()) << summary.message;
    return (summary.target_from_source->Apply(source_) - truth_.Apply(source_))
        .colwise()
        .norm()
        .mean();
  };
  const double plain = error(RobustKernelType::kNone, 1.0);
  EXPECT_GT(plain, 0.02);
  EXPECT_LT(error(RobustKernelType::kGemanMcClure, IsIcp() ? 0.2 : 1.0),
            0.8 * plain);
}

// Cases without a pose

TEST_P(LocalAlignmentTest, FewerThanThreePointsAreInsufficient) {
  for (const Eigen::Index n : {0, 1, 2}) {
    const Points few = target_.leftCols(n);
    for (const bool is_source : {true, false}) {
      const AlignmentSummary summary =
          Solve(is_source ? few : target_, is_source ? target_ : few, {});
      EXPECT_EQ(summary.termination, AlignmentTermination::kInsufficient);
      EXPECT_FALSE(summary.IsUsable());
      EXPECT_THAT(summary.message,
                  HasSubstr(std::string(is_source ? "source" : "target") +
                            " has " + std::to_string(n)));
    }
  }
}

TEST_P(LocalAlignmentTest, NothingWithinReachIsInsufficient) {
  const AlignmentSummary summary = Solve(
      source_, target_, Rigid3{Eigen::Matrix3d::Identity(), {500.0, 0.0, 0.0}});
  EXPECT_EQ(summary.termination, AlignmentTermination::kInsufficient);
  EXPECT_FALSE(summary.IsUsable());
  EXPECT_THAT(summary.message, HasSubstr("only 0 points"));
}

TEST_P(LocalAlignmentTest, PointsAtOnePlaceAreDegenerate) {
  const Points same = Points::Ones(3, 50);
  const AlignmentSummary summary = Solve(same, same, {});
  EXPECT_EQ(summary.termination, AlignmentTermination::kDegenerate)
      << summary.message;
  EXPECT_FALSE(summary.IsUsable());
  EXPECT_EQ(summary.unobservable.cols(), 3);
}

TEST_P(LocalAlignmentTest, PointsOnALineAreDegenerateAboutIt) {
  const Eigen::Vector3d line = Eigen::Vector3d(1.0, 2.0, 2.0) / 3.0;
  const Points source = line * Eigen::RowVectorXd::LinSpaced(60, -9.0, 9.0);
  const AlignmentSummary summary =
      Solve(source, source.colwise() + 0.1 * line, {});
  EXPECT_EQ(summary.termination, AlignmentTermination::kDegenerate);
  EXPECT_FALSE(summary.IsUsable());
  EXPECT_THAT(summary.message,
              HasSubstr("a rotation about (0.33, 0.67, 0.67)"));
}

TEST_P(SurfaceAlignmentTest, CorridorIsDegenerateAlongIt) {
  const auto corridor = [](std::uint64_t seed) {
    Points points = RandomPoints(6000, 0.01, seed);
    Random random(seed + 50);
    for (auto point : points.colwise()) {
      point.y() += 40.0 * random.Uniform() - 20.0;
      const double u = random.Uniform();
      switch (random.Below(3)) {
        case 0:
          point.x() += 4.0 * u - 2.0;
          break;
        case 1:
          point.x() += 2.0;
          point.z() += 3.0 * u;
          break;
        default:
          point.x() -= 2.0;
          point.z() += 3.0 * u;
      }
    }
    return points;
  };
  const AlignmentSummary summary = Solve(corridor(1), corridor(2), {});
  EXPECT_EQ(summary.termination, AlignmentTermination::kDegenerate)
      << summary.conditioning;
  EXPECT_FALSE(summary.IsUsable());
  EXPECT_THAT(summary.message, HasSubstr("a translation along ("));
  ASSERT_EQ(summary.unobservable.cols(), 1);
  EXPECT_GT(std::abs(summary.unobservable(4, 0)), 0.99);
}

TEST_P(SurfaceAlignmentTest, PlaneIsDegenerateInThreeDirections) {
  const Points a =
      RandomPlane(3000, 20.0, 1).points + RandomPoints(3000, 0.01, 3);
  const Points b =
      RandomPlane(3000, 20.0, 2).points + RandomPoints(3000, 0.01, 4);
  const AlignmentSummary summary = Solve(a, b, {});
  EXPECT_EQ(summary.termination, AlignmentTermination::kDegenerate)
      << summary.conditioning;
  ASSERT_EQ(summary.unobservable.cols(), 3);
  // Rotations about z and translations in the plane.
  EXPECT_LT(summary.unobservable.topRows(2).norm(), 0.1);
  EXPECT_LT(summary.unobservable.row(5).norm(), 0.1);

  options_.min_conditioning = 0.0;
  EXPECT_TRUE(Solve(a, b, {}).IsUsable());
}

TEST_P(LocalAlignmentTest, WhatIsNotFiniteIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Points bad = source_;
  bad(1, 7) = nan;
  EXPECT_THAT(Solve(bad, target_, {}).message, HasSubstr("source"));
  EXPECT_THAT(Solve(target_, bad, {}).message, HasSubstr("target"));
  Rigid3 pose;
  pose.translation.x() = nan;
  for (const AlignmentSummary& summary : {Solve(bad, target_, {}),
                                          Solve(target_, bad, {}),
                                          Solve(source_, target_, pose)}) {
    EXPECT_EQ(summary.termination, AlignmentTermination::kInvalidInput);
    EXPECT_FALSE(summary.IsUsable());
    EXPECT_THAT(summary.message, HasSubstr("not finite"));
  }
}

TEST_P(LocalAlignmentTest, OptionsOutOfRangeAreNamedAndNothingIsTried) {
  const auto expect_error = [&](const auto& change, const char* field) {
    options_ = {};
    change(&options_);
    std::string error;
    EXPECT_FALSE(options_.IsValid(&error)) << field;
    EXPECT_THAT(error, HasSubstr(field));
    const AlignmentSummary summary = Solve(source_, target_, truth_);
    EXPECT_EQ(summary.termination, AlignmentTermination::kInvalidInput);
    EXPECT_THAT(summary.message, HasSubstr(field));
    EXPECT_TRUE(summary.iterations.empty());
  };
  using Options = LocalAlignmentOptions*;
  expect_error([](Options o) { o->max_correspondence_distance = 0.0; },
               "max_correspondence_distance = 0");
  expect_error([](Options o) { o->kernel.width = -1.0; }, "kernel.width = -1");
  expect_error([](Options o) { o->translation_tolerance = 0.0; },
               "translation_tolerance = 0");
  expect_error([](Options o) { o->rotation_tolerance = NAN; },
               "rotation_tolerance = nan");
  expect_error([](Options o) { o->max_num_iterations = 0; },
               "max_num_iterations = 0");
  expect_error([](Options o) { o->min_conditioning = 1.0; },
               "min_conditioning = 1");
  expect_error([](Options o) { o->num_threads = -1; }, "num_threads = -1");
}

// The terms of each method in (1)

TEST(GicpTerms, AreThoseOfTheDefinition) {
  const Prepared source(RandomStreet(500, 0.02, 1));
  Prepared target(RandomStreet(500, 0.02, 2));
  target.normals.col(3).setZero();  // No plane.
  const Rigid3 pose{RandomRotation(5), {0.1, 0.0, 0.2}};
  const auto terms = MakeGicpTerms(source.cloud(), target.cloud(), 5.0, 0.01);
  int num_found = 0;
  for (Eigen::Index i = 0; i < 500; ++i) {
    AlignmentTerm term;
    if (!terms->Find(i, pose, &term)) continue;
    ++num_found;
    const Eigen::Vector3d p = source.tree.points().col(i);
    const auto j = target.tree.Nearest(pose * p, 1).front().index;
    EXPECT_EQ(term.target, target.tree.points().col(j));
    const Eigen::Vector3d n = source.normals.col(i);
    const Eigen::Vector3d m = target.normals.col(j);
    const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d expected =
        ((I - 0.99 * m * m.transpose()) + pose.rotation *
                                              (I - 0.99 * n * n.transpose()) *
                                              pose.rotation.transpose())
            .inverse();
    EXPECT_LE((term.information - expected).norm(), 1e-10 * expected.norm());
  }
  EXPECT_GT(num_found, 100);
}

TEST(VgicpTerms, AreThoseOfTheDefinition) {
  const Prepared source(RandomStreet(300, 0.02, 1));
  const Prepared target(RandomStreet(800, 0.02, 2));
  const Rigid3 pose{RotationZ(0.1), {0.1, 0.0, 0.2}};
  VgicpOptions options;
  options.voxel_size = 1.5;
  options.epsilon = 0.01;
  const auto terms = MakeVgicpTerms(source.cloud(), target.cloud(), options);
  const auto cell = [](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return (x / 1.5).array().floor();
  };
  int num_found = 0;
  for (Eigen::Index i = 0; i < 300; ++i) {
    const Eigen::Vector3d p = source.tree.points().col(i);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    double count = 0.0;
    for (Eigen::Index j = 0; j < 800; ++j) {
      const Eigen::Vector3d q = target.tree.points().col(j);
      if (cell(q) != cell(pose * p)) continue;
      mean += q;
      covariance += SurfaceCovariance(target.normals.col(j), 0.01);
      count += 1.0;
    }
    mean /= count;
    AlignmentTerm term;
    const bool is_found = terms->Find(i, pose, &term);
    ASSERT_EQ(is_found, count > 0.0 && (mean - pose * p).norm() <= 1.0);
    if (!is_found) continue;
    ++num_found;
    EXPECT_LE((term.target - mean).norm(), 1e-12);
    const Eigen::Matrix3d expected =
        count *
        (covariance / count +
         pose.rotation * SurfaceCovariance(source.normals.col(i), 0.01) *
             pose.rotation.transpose())
            .inverse();
    EXPECT_LE((term.information - expected).norm(), 1e-10 * expected.norm());
  }
  EXPECT_GT(num_found, 50);
}

TEST(LocalAlignment, TreesAndNormalsAtHandGiveTheSameBits) {
  const Points a = RandomStreet(2000, 0.01, 1);
  const Points b = RandomStreet(2000, 0.01, 2);
  const Prepared source(a);
  const Prepared target(b);
  const auto expect_same = [](const AlignmentSummary& x,
                              const AlignmentSummary& y) {
    ASSERT_TRUE(x.IsUsable()) << x.message;
    ASSERT_TRUE(y.IsUsable()) << y.message;
    EXPECT_EQ(x.target_from_source->ToMatrix(),
              y.target_from_source->ToMatrix());
  };
  expect_same(SolveIcp(a, target.tree, {}, {}), SolveIcp(a, b, {}, {}));
  expect_same(SolveGicp(source.cloud(), target.cloud(), {}, {}),
              SolveGicp(a, b, {}, {}));
  expect_same(SolveVgicp(source.cloud(), target.cloud(), {}, {}),
              SolveVgicp(a, b, {}, {}));
}

TEST(LocalAlignment, OptionsOfTheMethodsAreNamed) {
  std::string error;
  GicpOptions gicp;
  EXPECT_TRUE(gicp.IsValid(&error)) << error;
  gicp.epsilon = 0.0;
  EXPECT_FALSE(gicp.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("epsilon = 0"));
  gicp = {};
  gicp.num_neighbors = 2;
  EXPECT_FALSE(gicp.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("num_neighbors = 2"));
  VgicpOptions vgicp;
  vgicp.voxel_size = 0.0;
  EXPECT_FALSE(vgicp.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("voxel_size = 0"));
  EXPECT_THAT(
      SolveVgicp(Points::Ones(3, 5), Points::Ones(3, 5), {}, vgicp).message,
      HasSubstr("voxel_size = 0"));
}

TEST(Vgicp, TargetOfTooManyVoxelsIsRefused) {
  Points wide = RandomStreet(200, 0.01, 1);
  wide(0, 0) = 1e9;
  const AlignmentSummary summary =
      SolveVgicp(RandomStreet(200, 0.01, 2), wide, {}, {});
  EXPECT_EQ(summary.termination, AlignmentTermination::kInvalidInput);
  EXPECT_THAT(summary.message, HasSubstr("voxels wide"));
}

}  // namespace
}  // namespace quatro::local_alignment_test
