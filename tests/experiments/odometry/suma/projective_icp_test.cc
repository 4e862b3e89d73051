// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/suma/projective_icp.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "tests/support/random_problems.h"

namespace quatro::projective_icp_test {
namespace {

SphericalImage Image() {
  SphericalImage image;
  image.width = 360;
  image.top = 0.3;
  image.bottom = -0.5;
  return image;
}

// A scan of a room of 20 x 14 m, with the floor 2 m below the sensor, the
// ceiling 3 m above it and normal noise of `sigma` [m].
VertexMap SeeRoom(const Rigid3& room_from_sensor, double sigma) {
  const SphericalImage image = Image();
  const Eigen::Vector3d low(-10.0, -7.0, -2.0), high(10.0, 7.0, 3.0);
  Points points(3, image.size());
  const Eigen::Vector3d from = room_from_sensor.translation;
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const Eigen::Vector3d ray = image.Ray(u, v);
      const Eigen::Vector3d in_room = room_from_sensor.rotation * ray;
      double range = std::numeric_limits<double>::infinity();
      for (int i = 0; i < 3; ++i) {
        const double wall = in_room[i] > 0.0 ? high[i] : low[i];
        range = std::min(range, (wall - from[i]) / in_room[i]);
      }
      points.col(Eigen::Index{v} * image.width + u) = range * ray;
    }
  }
  return MakeVertexMap(
      points + RandomPoints(points.cols(), sigma, 9), image, 0.5, 1);
}

Rigid3 Move(std::uint64_t seed) {
  Eigen::Vector3d translation = 0.4 * RandomDirection(seed);
  translation.z() *= 0.2;
  return {Eigen::AngleAxisd(0.05, RandomDirection(seed + 1)).toRotationMatrix(),
          translation};
}

TEST(AlignProjectively, FindsWhereTheSensorIsInARoom) {
  const VertexMap model = SeeRoom({}, 0.0);
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Rigid3 truth = Move(seed);
    const auto summary = AlignProjectively(SeeRoom(truth, 0.01), model, {}, {});
    ASSERT_TRUE(summary.model_from_scan) << summary.message;
    EXPECT_EQ(summary.message, "converged");
    EXPECT_LT(AngleBetween(summary.model_from_scan->rotation, truth.rotation),
              1e-3);
    EXPECT_LT((summary.model_from_scan->translation - truth.translation).norm(),
              0.01);
    EXPECT_LT(summary.rms, 0.05);
    EXPECT_GT(summary.num_matches, 10000);
  }
}

TEST(AlignProjectively, OntoItselfIsTheIdentity) {
  const VertexMap model = SeeRoom({}, 0.02);
  const auto summary = AlignProjectively(model, model, {}, {});
  ASSERT_TRUE(summary.model_from_scan);
  EXPECT_LT(summary.model_from_scan->translation.norm(), 1e-9);
  EXPECT_EQ(summary.num_iterations, 1);
}

TEST(AlignProjectively, FloorAloneHoldsNoPose) {
  VertexMap floor = SeeRoom({}, 0.0);
  for (Eigen::Index i = 0; i < floor.image.size(); ++i) {
    if (floor.normals(2, i) < 0.999) floor.normals.col(i).setZero();
  }
  const auto summary = AlignProjectively(floor, floor, {}, {});
  EXPECT_FALSE(summary.model_from_scan);
  EXPECT_THAT(summary.message, ::testing::HasSubstr("six degrees of freedom"));
}

TEST(AlignProjectively, FarPartnersAndTurnedNormalsAreNone) {
  const VertexMap model = SeeRoom({}, 0.0);
  ProjectiveIcpOptions options;
  const auto far = AlignProjectively(
      model, model, {Eigen::Matrix3d::Identity(), {0.0, 0.0, 500.0}}, options);
  EXPECT_FALSE(far.model_from_scan);
  EXPECT_THAT(far.message, ::testing::HasSubstr("points have a match"));
  VertexMap inside_out = model;
  inside_out.normals *= -1.0;
  EXPECT_EQ(AlignProjectively(inside_out, model, {}, options).num_matches, 0);
}

TEST(AlignProjectively, OfNothingIsNoAnswer) {
  const VertexMap model = SeeRoom({}, 0.0);
  const VertexMap nothing = MakeVertexMap(Points(3, 0), Image(), 0.5, 1);
  EXPECT_FALSE(AlignProjectively(nothing, model, {}, {}).model_from_scan);
  EXPECT_FALSE(AlignProjectively(model, nothing, {}, {}).model_from_scan);
}

TEST(ProjectiveIcpOptions, ErrorNamesTheField) {
  const auto error_of = [](auto change) {
    ProjectiveIcpOptions options;
    change(&options);
    std::string error;
    EXPECT_FALSE(options.IsValid(&error));
    return error;
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(error_of([](auto* o) { o->max_distance = -1.0; }),
              HasSubstr("max_distance = -1"));
  EXPECT_THAT(error_of([](auto* o) { o->max_angle = 4.0; }),
              HasSubstr("max_angle = 4"));
  EXPECT_THAT(error_of([](auto* o) { o->huber_width = 0.0; }),
              HasSubstr("huber_width = 0"));
  EXPECT_THAT(error_of([](auto* o) { o->max_num_iterations = 0; }),
              HasSubstr("max_num_iterations = 0"));
  EXPECT_THAT(error_of([](auto* o) { o->min_num_matches = 2; }),
              HasSubstr("min_num_matches = 2"));
  EXPECT_THAT(error_of([](auto* o) { o->min_conditioning = 0.0; }),
              HasSubstr("min_conditioning = 0"));
  EXPECT_THAT(error_of([](auto* o) { o->rotation_tolerance = -1.0; }),
              HasSubstr("rotation_tolerance = -1"));
}

}  // namespace
}  // namespace quatro::projective_icp_test
