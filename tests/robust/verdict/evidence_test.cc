// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/evidence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/described_clouds.h"
#include "tests/support/random_problems.h"

namespace quatro::evidence_test {
namespace {

using ::testing::HasSubstr;

// A wall of a scene in the world frame, from corner to corner.
struct Wall {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

std::vector<Wall> Box(double x, double y, double length, double width) {
  const Eigen::Vector2d a(x - length / 2, y - width / 2);
  const Eigen::Vector2d b(x + length / 2, y - width / 2);
  const Eigen::Vector2d c(x + length / 2, y + width / 2);
  const Eigen::Vector2d d(x - length / 2, y + width / 2);
  return {{a, b}, {b, c}, {c, d}, {d, a}};
}

std::vector<Wall> Join(std::vector<Wall> a, const std::vector<Wall>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

using Scan = DescribedCloud;

constexpr double kVoxelSize = 0.3;  // [m]

// Points within max_range of the sensor, 12 per square meter of walls 3 m high,
// in the frame of the sensor, which is rotated by `yaw`.
Scan MakeScan(const std::vector<Wall>& walls,
              const Eigen::Vector3d& place,
              double yaw,
              double max_range,
              std::uint64_t seed) {
  Random random(seed);
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;
  const Rigid3 sensor_from_world = Inverse(Rigid3{RotationZ(yaw), place});
  for (const Wall& wall : walls) {
    const Eigen::Vector2d along = wall.to - wall.from;
    const Eigen::Vector3d normal =
        Eigen::Vector3d(-along.y(), along.x(), 0.0).normalized();
    const int num = static_cast<int>(12.0 * 3.0 * along.norm());
    for (int i = 0; i < num; ++i) {
      Eigen::Vector3d point;
      point << wall.from + random.Uniform() * along, 3.0 * random.Uniform();
      point += 0.02 * RandomNormal(random) * normal;
      if ((point - place).norm() > max_range) continue;
      points.push_back(sensor_from_world * point);
      normals.push_back(sensor_from_world.rotation * normal);
    }
  }
  Points all(3, static_cast<Eigen::Index>(points.size()));
  Points all_normals(3, all.cols());
  for (std::size_t i = 0; i < points.size(); ++i) {
    all.col(static_cast<Eigen::Index>(i)) = points[i];
    all_normals.col(static_cast<Eigen::Index>(i)) = normals[i];
  }
  return MakeDescribedCloud(all, all_normals);
}

// Two scans from different places.
struct ScanPair {
  explicit ScanPair(const std::vector<Wall>& walls, double max_range = 25.0)
      : ScanPair(walls, walls, max_range) {}
  ScanPair(const std::vector<Wall>& source_walls,
           const std::vector<Wall>& target_walls,
           double max_range = 25.0)
      : source(MakeScan(source_walls,
                        world_from_source.translation,
                        0.4,
                        max_range,
                        /*seed=*/1)),
        target(MakeScan(target_walls,
                        world_from_target.translation,
                        0.0,
                        max_range,
                        /*seed=*/2)) {}

  Rigid3 world_from_source{RotationZ(0.4), {1.5, 0.5, 1.6}};
  Rigid3 world_from_target{RotationZ(0.0), {-0.5, -0.3, 1.5}};
  Rigid3 target_from_source = Inverse(world_from_target) * world_from_source;
  Scan source;
  Scan target;
};

std::optional<GeometricEvidence> MeasureWith(const EvidenceOptions& options,
                                             const DescribedCloud& source,
                                             const DescribedCloud& target,
                                             const Rigid3& target_from_source,
                                             int num_threads = 1) {
  const MutualContacts contacts =
      FindMutualContacts(source,
                         target,
                         target_from_source,
                         options.MaxDistance(kVoxelSize),
                         num_threads);
  return MeasureGeometricEvidence(source,
                                  target,
                                  target_from_source,
                                  contacts,
                                  kVoxelSize,
                                  options,
                                  num_threads);
}

GeometricEvidence Measure(const DescribedCloud& source,
                          const DescribedCloud& target,
                          const Rigid3& target_from_source,
                          int num_threads = 1) {
  const auto evidence = MeasureWith(
      EvidenceOptions(), source, target, target_from_source, num_threads);
  EXPECT_TRUE(evidence.has_value());
  return evidence.value_or(GeometricEvidence());
}

GeometricEvidence Measure(const ScanPair& pair) {
  return Measure(pair.source, pair.target, pair.target_from_source);
}

Rigid3 Shift(double x, double y) {
  return {Eigen::Matrix3d::Identity(), {x, y, 0.0}};
}

// A room without rotational symmetry.
std::vector<Wall> FurnishedRoom() {
  return Join(Join(Box(0, 0, 20, 12), Box(6, 3, 1.5, 1.0)),
              Join(Box(-7, -2, 1, 3), Box(2, -4, 3, 1)));
}

std::vector<Wall> Corridor() {
  return {{{-60, -2}, {60, -2}}, {{-60, 2}, {60, 2}}};
}

TEST(GeometricEvidence, OfARightPoseSpeaksForIt) {
  const ScanPair pair(FurnishedRoom());
  const GeometricEvidence evidence = Measure(pair);
  EXPECT_GT(evidence.structure_overlap, 0.9);
  EXPECT_LT(evidence.median_residual, 0.2);
  ASSERT_TRUE(evidence.free_space.ContradictedShare().has_value());
  EXPECT_LT(*evidence.free_space.ContradictedShare(), 0.02);
  EXPECT_GT(evidence.free_space.num_overlapping, 1000);
  EXPECT_GT(evidence.weakest_share, 0.2);
  EXPECT_GT(evidence.Distinctness(), 0.2);
  EXPECT_NEAR(evidence.rival.overlap, evidence.structure_overlap, 0.1);
}

TEST(GeometricEvidence, MedianResidualIsThatOfAShiftAlongTheNormals) {
  const ScanPair pair(Corridor());
  // A shift by 0.15 m across the corridor is half a voxel.
  const GeometricEvidence evidence = Measure(
      pair.source, pair.target, Shift(0.0, 0.15) * pair.target_from_source);
  EXPECT_NEAR(evidence.median_residual, 0.5, 0.05);
}

TEST(GeometricEvidence, OfAWrongPoseSpeaksAgainstIt) {
  const ScanPair pair(FurnishedRoom());
  const GeometricEvidence right = Measure(pair);
  const std::vector<Rigid3> errors = {
      Shift(0.0, 3.0),
      Shift(-4.0, 0.0),
      {RotationZ(0.5), Eigen::Vector3d::Zero()},
      {RotationZ(M_PI / 2), Eigen::Vector3d::Zero()}};
  for (const Rigid3& error : errors) {
    const GeometricEvidence wrong =
        Measure(pair.source, pair.target, error * pair.target_from_source);
    SCOPED_TRACE(error.ToMatrix());
    EXPECT_LT(wrong.structure_overlap, 0.6);
    EXPECT_GT(wrong.median_residual, right.median_residual);
    ASSERT_TRUE(wrong.free_space.ContradictedShare().has_value());
    EXPECT_GT(*wrong.free_space.ContradictedShare(), 0.1);
    EXPECT_LT(wrong.Distinctness(), 0.1);
  }
}

// The rival of a shifted pose is the correct pose.
TEST(GeometricEvidence, RivalIsBetterThanAWrongPose) {
  const ScanPair pair(FurnishedRoom());
  const GeometricEvidence wrong = Measure(
      pair.source, pair.target, Shift(4.0, -3.0) * pair.target_from_source);
  EXPECT_LT(wrong.Distinctness(), -0.3);
  EXPECT_LT((wrong.rival.shift - Eigen::Vector3d(-4.0, 3.0, 0.0)).norm(), 0.5);
  EXPECT_LT((wrong.rival.rival_target_from_source.translation -
             pair.target_from_source.translation)
                .norm(),
            0.6);
}

TEST(GeometricEvidence, CorridorCanBeSlidAlongItsAxis) {
  for (const double axis : {0.0, 0.7, 2.0}) {
    std::vector<Wall> walls = Corridor();
    const Eigen::Matrix2d turn = RotationZ(axis).topLeftCorner<2, 2>();
    for (Wall& wall : walls) wall = {turn * wall.from, turn * wall.to};
    const GeometricEvidence evidence = Measure(ScanPair(walls));
    EXPECT_GT(evidence.structure_overlap, 0.9);
    EXPECT_LT(evidence.weakest_share, 0.01);
    const Eigen::Vector3d direction(std::cos(axis), std::sin(axis), 0.0);
    EXPECT_NEAR(std::abs(evidence.weakest_direction.dot(direction)), 1.0, 1e-3);
    EXPECT_LT(evidence.Distinctness(), 0.05);
    EXPECT_LT(*evidence.free_space.ContradictedShare(), 0.02);
  }
}

// Poses closer than min_shift are not rivals.
TEST(GeometricEvidence, RivalIsDisplaced) {
  const ScanPair pair(Corridor());
  EvidenceOptions options;
  options.rival.min_shift = 5.0 / kVoxelSize;
  const auto evidence =
      MeasureWith(options, pair.source, pair.target, pair.target_from_source);
  ASSERT_TRUE(evidence.has_value());
  if (std::abs(evidence->rival.yaw) < 10.0 * M_PI / 180.0) {
    EXPECT_GT(evidence->rival.shift.head<2>().norm(), 5.0);
  }
}

TEST(GeometricEvidence, PillarsCanBeSlidByTheirDistance) {
  std::vector<Wall> pillars;
  for (int i = -20; i <= 20; ++i) {
    pillars = Join(pillars, Box(3.5 * i, -4.0, 0.8, 0.8));
    pillars = Join(pillars, Box(3.5 * i, 4.0, 0.8, 0.8));
  }
  // Only for shifts: a rotation by 180 deg is another symmetry.
  EvidenceOptions options;
  const ScanPair pair(pillars);
  const auto evidence =
      MeasureWith(options, pair.source, pair.target, pair.target_from_source);
  ASSERT_TRUE(evidence.has_value());
  EXPECT_LT(evidence->Distinctness(), 0.1);
  EXPECT_GT(evidence->structure_overlap, 0.8);
  const double periods = evidence->rival.shift.x() / 3.5;
  if (evidence->rival.yaw == 0.0) {
    EXPECT_NEAR(periods, std::round(periods), 0.15);
    EXPECT_GE(std::abs(periods), 0.85);
  }
}

TEST(GeometricEvidence, EmptyRoomCanBeTurnedByHalf) {
  const GeometricEvidence evidence = Measure(ScanPair(Box(0, 0, 20, 12)));
  EXPECT_LT(std::abs(evidence.Distinctness()), 0.05);
  EXPECT_NEAR(std::abs(evidence.rival.yaw), M_PI, 0.05);
  // Shifts and rotations by 90 deg are no symmetries of this room.
  EXPECT_GT(evidence.weakest_share, 0.2);
}

// A pillar at one end adds few points to the overlap, but at its place after a
// rotation by 180 deg the sensors saw the wall behind.
TEST(GeometricEvidence, RivalCanBeContradicted) {
  const auto room = Box(0, 0, 20, 12);
  const GeometricEvidence empty = Measure(ScanPair(room));
  EXPECT_LT(*empty.rival_free_space.ContradictedShare(), 0.01);
  const GeometricEvidence evidence =
      Measure(ScanPair(Join(room, Box(5, 3, 0.8, 0.8))));
  EXPECT_NEAR(std::abs(evidence.rival.yaw), M_PI, 0.05);
  EXPECT_LT(*evidence.free_space.ContradictedShare(), 0.01);
  EXPECT_GT(*evidence.rival_free_space.ContradictedShare(), 0.02);
}

TEST(GeometricEvidence, SquareRoomCanBeTurnedByAQuarter) {
  // Rotations by 90 and 180 deg are both symmetries of this room.
  const GeometricEvidence evidence = Measure(ScanPair(Box(0, 0, 14, 14)));
  EXPECT_LT(std::abs(evidence.Distinctness()), 0.05);
  const double quarters = evidence.rival.yaw / (M_PI / 2);
  EXPECT_NEAR(quarters, std::round(quarters), 0.05);
  EXPECT_GE(std::abs(quarters), 0.95);
}

TEST(GeometricEvidence, WallInFreeSpaceIsContradicted) {
  const auto room = FurnishedRoom();
  const auto across = Join(room, {{{-4, -5}, {-4, 5}}});
  const ScanPair pair(across, room);
  const GeometricEvidence evidence = Measure(pair);
  const GeometricEvidence without = Measure(ScanPair(room));
  EXPECT_GT(evidence.free_space.num_contradicted,
            without.free_space.num_contradicted + 100);
  EXPECT_GT(*evidence.free_space.ContradictedShare(),
            *without.free_space.ContradictedShare() + 0.03);
  EXPECT_GT(evidence.structure_overlap, 0.7);
}

// A wall behind another is hidden and contradicts nothing.
TEST(GeometricEvidence, WallBehindAWallIsNotContradicted) {
  const auto corridor = Corridor();
  const auto double_walled = Join(corridor, {{{-20, 4}, {20, 4}}});
  const GeometricEvidence evidence = Measure(ScanPair(double_walled, corridor));
  const GeometricEvidence without = Measure(ScanPair(corridor));
  EXPECT_LT(evidence.structure_overlap, without.structure_overlap - 0.1);
  EXPECT_LE(evidence.free_space.num_contradicted,
            without.free_space.num_contradicted + 5);
}

// The overlap is the smaller share, whichever scan has more structure.
TEST(GeometricEvidence, CoarseOverlapIsTheSmallerOfBothWays) {
  const auto corridor = Corridor();
  const auto double_walled = Join(corridor, {{{-20, 4}, {20, 4}}});
  const ScanPair more_in_source(double_walled, corridor);
  const ScanPair more_in_target(corridor, double_walled);
  for (const ScanPair* pair : {&more_in_source, &more_in_target}) {
    const GeometricEvidence evidence = Measure(*pair);
    EXPECT_LT(evidence.structure_overlap, 0.85);
    EXPECT_NEAR(evidence.rival.overlap, evidence.structure_overlap, 0.08);
  }
}

TEST(GeometricEvidence, FreeSpaceIsUnknownIfNeitherIsAScan) {
  ScanPair pair(FurnishedRoom());
  pair.source.is_scan = false;
  const GeometricEvidence one = Measure(pair);
  EXPECT_TRUE(one.free_space.ContradictedShare().has_value());
  pair.target.is_scan = false;
  const GeometricEvidence none = Measure(pair);
  EXPECT_FALSE(none.free_space.ContradictedShare().has_value());
  EXPECT_EQ(none.free_space.num_contradicted, 0);
  EXPECT_EQ(none.free_space.num_overlapping, 0);
  EXPECT_EQ(none.structure_overlap, one.structure_overlap);
}

TEST(GeometricEvidence, OverlapIsTheSmallerShare) {
  const ScanPair pair(FurnishedRoom());
  const auto share = [](const Scan& a, const Scan& b, const Rigid3& b_from_a) {
    return *OverlapShare(FindStructure(a, b, b_from_a, 0.5, 1));
  };
  EXPECT_EQ(
      Measure(pair).structure_overlap,
      std::min(
          share(pair.source, pair.target, pair.target_from_source),
          share(pair.target, pair.source, Inverse(pair.target_from_source))));
}

TEST(GeometricEvidence, SwappingSourceAndTargetKeepsIt) {
  const ScanPair pair(FurnishedRoom());
  for (const Rigid3& error : {Shift(0.0, 0.0), Shift(3.0, 1.0)}) {
    const Rigid3 pose = error * pair.target_from_source;
    const GeometricEvidence forth = Measure(pair.source, pair.target, pose);
    const GeometricEvidence back =
        Measure(pair.target, pair.source, Inverse(pose));
    // Rounding may move one or two points across a limit.
    EXPECT_NEAR(back.structure_overlap, forth.structure_overlap, 2e-3);
    EXPECT_NEAR(back.median_residual, forth.median_residual, 2e-3);
    EXPECT_NEAR(*back.free_space.ContradictedShare(),
                *forth.free_space.ContradictedShare(),
                2e-3);
    EXPECT_NEAR(back.weakest_share, forth.weakest_share, 2e-3);
    EXPECT_NEAR(std::abs((pose.rotation * back.weakest_direction)
                             .dot(forth.weakest_direction)),
                1.0,
                1e-3);
    // The grid's cells and the refinement's steps differ.
    EXPECT_NEAR(back.rival.overlap, forth.rival.overlap, 0.03);
    EXPECT_NEAR(back.rival.rival_overlap, forth.rival.rival_overlap, 0.05);
  }
}

// A rotated cloud with its sensor, in another frame.
TEST(GeometricEvidence, FrameOfACloudDoesNotMatter) {
  const ScanPair pair(FurnishedRoom());
  const GeometricEvidence expected = Measure(pair);
  for (const double yaw : {0.3, 2.0, -2.5}) {
    const Rigid3 motion{RotationZ(yaw), {300.0, -70.0, 20.0}};
    const Scan moved = MakeDescribedCloud(motion.Apply(pair.source.points()),
                                          motion.rotation * pair.source.normals,
                                          motion * pair.source.sensor);
    const GeometricEvidence evidence =
        Measure(moved, pair.target, pair.target_from_source * Inverse(motion));
    EXPECT_NEAR(evidence.structure_overlap, expected.structure_overlap, 2e-3);
    EXPECT_NEAR(evidence.median_residual, expected.median_residual, 2e-3);
    EXPECT_NEAR(*evidence.free_space.ContradictedShare(),
                *expected.free_space.ContradictedShare(),
                0.01);
    EXPECT_NEAR(evidence.weakest_share, expected.weakest_share, 2e-3);
    EXPECT_NEAR(
        evidence.rival.rival_overlap, expected.rival.rival_overlap, 0.05);
  }
}

TEST(GeometricEvidence, NumberOfThreadsDoesNotMatterBitForBit) {
  const ScanPair pair(FurnishedRoom());
  const GeometricEvidence one = Measure(pair);
  for (const int num_threads : {0, 2, 3}) {
    const GeometricEvidence many =
        Measure(pair.source, pair.target, pair.target_from_source, num_threads);
    EXPECT_EQ(many.structure_overlap, one.structure_overlap);
    EXPECT_EQ(many.median_residual, one.median_residual);
    EXPECT_EQ(many.free_space.ContradictedShare(),
              one.free_space.ContradictedShare());
    EXPECT_EQ(many.weakest_direction, one.weakest_direction);
    EXPECT_EQ(many.weakest_share, one.weakest_share);
    EXPECT_EQ(many.rival.overlap, one.rival.overlap);
    EXPECT_EQ(many.rival.rival_target_from_source.ToMatrix(),
              one.rival.rival_target_from_source.ToMatrix());
  }
}

TEST(GeometricEvidence, OfNothingIsNone) {
  const ScanPair pair(FurnishedRoom());
  const Scan empty = MakeDescribedCloud(Points(3, 0), Points(3, 0));
  const Scan tiny = MakeScan({{{1, 0}, {2, 0}}}, {0, 0, 1}, 0.0, 25.0, 1);
  ASSERT_GT(tiny.points().cols(), 0);
  const auto expect_none = [](const DescribedCloud& a,
                              const DescribedCloud& b) {
    EXPECT_FALSE(MeasureWith(EvidenceOptions(), a, b, Rigid3()));
    EXPECT_FALSE(MeasureWith(EvidenceOptions(), b, a, Rigid3()));
  };
  expect_none(empty, empty);
  expect_none(empty, pair.target);
  expect_none(tiny, pair.target);
  // No overlap if the scans share no space.
  EXPECT_FALSE(MeasureWith(
      EvidenceOptions(), pair.source, pair.target, Shift(1e4, 0.0)));
}

TEST(GeometricEvidence, OfExtremeCloudsIsFinite) {
  const auto expect_finite = [](const DescribedCloud& cloud) {
    const GeometricEvidence evidence = Measure(cloud, cloud, Rigid3());
    EXPECT_EQ(evidence.structure_overlap, 1.0);
    EXPECT_TRUE(std::isfinite(evidence.median_residual));
    EXPECT_TRUE(evidence.weakest_direction.allFinite());
    EXPECT_NEAR(evidence.weakest_direction.norm(), 1.0, 1e-12);
    EXPECT_TRUE(std::isfinite(evidence.Distinctness()));
    EXPECT_TRUE(evidence.rival.rival_target_from_source.ToMatrix().allFinite());
  };
  const Points upright = Eigen::Vector3d::UnitX().replicate(1, 100);
  // One point repeated a hundred times, at the sensor and elsewhere.
  for (const double x : {0.0, 5.0}) {
    expect_finite(MakeDescribedCloud(Eigen::Vector3d(x, 0, 0).replicate(1, 100),
                                     upright));
  }
  // A wide cloud far from the origin.
  const Points normal = RandomPoints(100, 1.0, /*seed=*/3);
  expect_finite(
      MakeDescribedCloud(normal.colwise() + Eigen::Vector3d(1e7, 1e7, 0.0),
                         upright,
                         {1e7, 1e7, 0.0}));
  expect_finite(MakeDescribedCloud(1e7 * normal, upright));
}

TEST(EvidenceOptions, ErrorNamesTheField) {
  std::string error;
  EXPECT_TRUE(EvidenceOptions().IsValid(&error)) << error;
  const auto expect_error = [&](const auto& change, const char* field) {
    EvidenceOptions options;
    change(&options);
    EXPECT_FALSE(options.IsValid(&error)) << field;
    EXPECT_THAT(error, HasSubstr(field));
  };
  using Options = EvidenceOptions*;
  expect_error([](Options o) { o->max_distance_in_voxels = NAN; },
               "max_distance_in_voxels = nan");
  expect_error([](Options o) { o->rival.min_shift = 0.0; }, "min_shift = 0");
  expect_error([](Options o) { o->rival.max_shift = 1.0; }, "max_shift = 1");
  expect_error([](Options o) { o->rival.max_turned_shift = -1.0; },
               "max_turned_shift = -1");
  expect_error([](Options o) { o->rival.num_search_points = 0; },
               "num_search_points = 0");
  expect_error([](Options o) { o->rival.num_compared_points = 0; },
               "num_compared_points = 0");
}

}  // namespace
}  // namespace quatro::evidence_test
