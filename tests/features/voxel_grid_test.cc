// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/voxel_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "tests/support/random_problems.h"

namespace quatro::voxel_grid_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

// Fixed point truncates less than 2^-32 of a cell from each coordinate.
constexpr double kResolution = 0x1p-31;  // [cells]

Points Sample(const Points& points, double voxel_size) {
  std::string error;
  const std::optional<Points> samples =
      SampleVoxels(points, voxel_size, &error);
  EXPECT_TRUE(samples) << error;
  return samples.value_or(Points(3, 0));
}

std::string ErrorOf(const Points& points, double voxel_size) {
  std::string error;
  EXPECT_FALSE(SampleVoxels(points, voxel_size, &error));
  return error;
}

// A direct implementation of the header's definition. A map has the promised
// order.
Points BruteForceSample(const Points& points, double voxel_size) {
  struct Cell {
    Eigen::Matrix<long double, 3, 1> sum{0.0L, 0.0L, 0.0L};
    int count = 0;
  };
  std::map<std::array<double, 3>, Cell> cells;
  for (const auto point : points.colwise()) {
    Cell& cell = cells[{std::floor(point.x() / voxel_size),
                        std::floor(point.y() / voxel_size),
                        std::floor(point.z() / voxel_size)}];
    cell.sum += point.cast<long double>();
    ++cell.count;
  }
  Points samples(3, static_cast<Eigen::Index>(cells.size()));
  Eigen::Index i = 0;
  for (const auto& [index, cell] : cells) {
    samples.col(i++) = (cell.sum / cell.count).cast<double>();
  }
  return samples;
}

void ExpectSamples(const Points& samples,
                   const Points& expected,
                   double tolerance) {
  ASSERT_EQ(samples.cols(), expected.cols());
  if (samples.cols() == 0) return;
  EXPECT_LE((samples - expected).cwiseAbs().maxCoeff(), tolerance);
}

TEST(SampleVoxels, IsTheMeanOfEachOccupiedCell) {
  for (const double voxel_size : {0.1, 0.3, 1.0, 7.0, 100.0}) {
    SCOPED_TRACE(voxel_size);
    for (const std::uint64_t seed : {1, 2, 3}) {
      const Points points = RandomPoints(3000, 2.0, seed);
      ExpectSamples(Sample(points, voxel_size),
                    BruteForceSample(points, voxel_size),
                    voxel_size * kResolution);
    }
    const Points street = RandomStreet(3000, 0.02, 4);
    ExpectSamples(Sample(street, voxel_size),
                  BruteForceSample(street, voxel_size),
                  voxel_size * kResolution);
  }
}

TEST(SampleVoxels, OrderOfThePointsDoesNotMatterToTheLastBit) {
  const Points points = RandomPoints(5000, 2.0, 1);
  const Points samples = Sample(points, 1.0);
  ASSERT_GT(samples.cols(), 100);
  for (const std::uint64_t seed : {2, 3, 4}) {
    const Points shuffled = points(Eigen::all, RandomPermutation(5000, seed));
    EXPECT_EQ(Sample(shuffled, 1.0), samples) << "seed " << seed;
  }
}

TEST(SampleVoxels, CellsComeOutInOrderOfXThenYThenZ) {
  Points points{{0, 1, 0, -1, 0, 0}, {0, 0, 1, 5, 0, 0}, {0, 0, 0, 5, 1, -1}};
  points.array() += 0.5;
  const Points expected =
      points(Eigen::all, std::array<int, 6>{3, 5, 0, 4, 2, 1});
  EXPECT_EQ(Sample(points, 1.0), expected);
}

TEST(SampleVoxels, RepeatingEveryPointAlikeDoesNotMoveTheMeans) {
  const Points points = RandomPoints(1000, 2.0, 1);
  const Points samples = Sample(points, 1.0);
  EXPECT_EQ(Sample(points.replicate(1, 2), 1.0), samples);
  EXPECT_EQ(Sample(points.replicate(1, 8), 1.0), samples);
  ExpectSamples(Sample(points.replicate(1, 3), 1.0), samples, 1e-15);
}

TEST(SampleVoxels, SamplesAreTheirOwnSamples) {
  const Points samples = Sample(RandomPoints(5000, 5.0, 1), 0.7);
  ExpectSamples(Sample(samples, 0.7), samples, 0.7 * kResolution);
}

TEST(SampleVoxels, NegativeCoordinatesAreFlooredNotTruncated) {
  const Points points{{-0.25, 0.25, -1.0}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
  // -0.25 and -1 share the cell [-1, 0); 0.25 is not in it.
  const Points expected{{-0.625, 0.25}, {0.5, 0.5}, {0.5, 0.5}};
  EXPECT_EQ(Sample(points, 1.0), expected);
}

TEST(SampleVoxels, MovingByWholeCellsMovesTheSamples) {
  // Multiples of 2^-20 m, so that 1e7 m can be added without rounding.
  const Points points =
      (RandomPoints(3000, 3.0, 1).array() * 0x1p20).round() * 0x1p-20;
  const Points samples = Sample(points, 0.5);
  const Eigen::Vector3d offset(1e7, -2e7, 5e6);
  const Points moved = Sample(points.colwise() + offset, 0.5);
  ExpectSamples(moved.colwise() - offset, samples, 1e-8);
}

TEST(SampleVoxels, OnePointIsItsOwnSample) {
  const Eigen::Vector3d point(0.1, -3.7, 12.9);
  for (const double voxel_size : {1e-3, 0.3, 1e6}) {
    ExpectSamples(Sample(point, voxel_size), point, voxel_size * kResolution);
  }
}

TEST(SampleVoxels, EmptyCloudHasNoSamples) {
  EXPECT_EQ(Sample(Points(3, 0), 1.0).cols(), 0);
}

TEST(SampleVoxels, RefusesAVoxelSizeThatIsNotPositive) {
  const Points points = RandomPoints(10, 1.0, 1);
  for (const double voxel_size : {0.0, -0.0, -0.3, kNan, kInf, -kInf}) {
    EXPECT_THAT(ErrorOf(points, voxel_size), HasSubstr("voxel_size"))
        << voxel_size;
  }
  EXPECT_THAT(ErrorOf(points, -0.3), HasSubstr("-0.3"));
  EXPECT_THAT(ErrorOf(Points(3, 0), -0.3), HasSubstr("voxel_size"));
}

TEST(SampleVoxels, RefusesPointsThatAreNotFinite) {
  for (const double bad : {kNan, kInf, -kInf}) {
    for (const Eigen::Index i : {0, 1, 50, 98, 99}) {
      for (const Eigen::Index axis : {0, 1, 2}) {
        Points points = RandomPoints(100, 1.0, 1);
        points(axis, i) = bad;
        EXPECT_THAT(ErrorOf(points, 1.0),
                    AllOf(HasSubstr("not finite"),
                          HasSubstr(" " + std::to_string(i) + " ")))
            << bad << " on axis " << axis;
      }
    }
  }
}

TEST(SampleVoxels, RefusesAStrayPointAndNamesTheRemedy) {
  for (const Eigen::Index axis : {0, 1, 2}) {
    for (const double stray : {1e7, -1e7, 1e300}) {
      Points points = RandomPoints(100, 1.0, 1);
      points(axis, 50) = stray;
      EXPECT_THAT(ErrorOf(points, 0.3), HasSubstr("voxel_size"))
          << stray << " m on axis " << axis;
    }
  }
}

TEST(SampleVoxels, RefusesACloudWhoseDistancesCannotBeSquared) {
  const Points points = RandomPoints(100, 1.0, 1);
  EXPECT_THAT(ErrorOf(1e-300 * points, 0.3),
              HasSubstr("m wide, must be at least 1e-100 m"));
  std::string error;
  EXPECT_TRUE(SampleVoxels(1e-99 * points, 0.3, &error)) << error;
  // Copies of one point.
  EXPECT_TRUE(SampleVoxels(Points::Constant(3, 2, 1e-300), 0.3, &error))
      << error;
}

TEST(SampleVoxels, RefusesAVoxelSizeSoSmallThatCellsOverflow) {
  for (const Eigen::Index axis : {0, 1, 2}) {
    Points points = Points::Zero(3, 2);
    points.row(axis).setConstant(1e10);
    EXPECT_THAT(ErrorOf(points, 1e-300), HasSubstr("voxel_size"));
  }
}

TEST(SampleVoxels, HoldsExactlyTwoToThe21CellsPerAxis) {
  constexpr double kWidest = 1 << 21;
  for (const Eigen::Index axis : {0, 1, 2}) {
    for (const double first : {0.0, -3.0, -kWidest + 1.0, 1e7}) {
      Points points = Points::Constant(3, 2, 0.5);
      points(axis, 0) += first;
      points(axis, 1) += first + kWidest - 1.0;
      EXPECT_EQ(Sample(points, 1.0), points) << "axis " << axis;
      points(axis, 1) += 1.0;
      EXPECT_THAT(ErrorOf(points, 1.0), HasSubstr("voxel_size"));
    }
  }
}

}  // namespace
}  // namespace quatro::voxel_grid_test
