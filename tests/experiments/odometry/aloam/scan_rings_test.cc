// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/aloam/scan_rings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/simulator/lidar.h"
#include "experiments/simulator/simulator.h"
#include "features/base/degree.h"
#include "features/io/cloud_io.h"
#include "tests/support/random_problems.h"

namespace quatro::scan_rings_test {
namespace {

std::vector<double> EvenElevations(int n, double top_deg, double bottom_deg) {
  std::vector<double> elevations;
  for (int i = 0; i < n; ++i) {
    elevations.push_back(kDegree *
                         (top_deg - (top_deg - bottom_deg) * i / (n - 1)));
  }
  return elevations;
}

struct Sensor {
  const char* name;
  std::vector<double> elevations;  // Top to bottom.
};

std::vector<Sensor> Sensors() {
  return {{"HDL-64E", Hdl64Elevations()},
          {"VLP-16", EvenElevations(16, 15.0, -15.0)},
          {"OS1-64", EvenElevations(64, 16.6, -16.6)}};
}

// Points in the order of the beams.
Points Simulate(const Sensor& sensor) {
  SimulatePairOptions options;
  options.lidar.elevations = sensor.elevations;
  std::string error;
  const auto pair = SimulatePair(options, &error);
  EXPECT_TRUE(pair.has_value()) << error;
  return pair ? pair->source.points : Points(3, 0);
}

double Elevation(const Eigen::Vector3d& p) {
  return std::atan2(p.z(), std::hypot(p.x(), p.y()));
}

// Every ring is one of the sensor's beams, complete except for its ends, and
// has one direction.
void ExpectRingsOf(const Sensor& sensor,
                   const Points& points,
                   const ScanRings& scan) {
  SCOPED_TRACE(sensor.name);
  // Beams that only see the sky have no ring.
  std::vector<std::size_t> of_beam(sensor.elevations.size(), 0);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double e = Elevation(points.col(i));
    std::size_t beam = 0;
    for (std::size_t b = 1; b < of_beam.size(); ++b) {
      if (std::abs(e - sensor.elevations[b]) <
          std::abs(e - sensor.elevations[beam])) {
        beam = b;
      }
    }
    ++of_beam[beam];
  }
  std::vector<double> seen;
  std::size_t num_points = 0;
  for (std::size_t b = 0; b < of_beam.size(); ++b) {
    if (of_beam[b] < 2 * kMinRingSize) continue;
    seen.push_back(sensor.elevations[b]);
    num_points += of_beam[b];
  }
  ASSERT_EQ(scan.rings.size(), seen.size());
  ASSERT_GT(seen.size(), 10u);
  std::size_t num_in_rings = 0;
  for (std::size_t r = 0; r < seen.size(); ++r) {
    EXPECT_NEAR(scan.elevations[r], seen[r], 1e-4);
    int num_back[2] = {0, 0};
    for (std::size_t i = 0; i < scan.rings[r].size(); ++i) {
      const Eigen::Vector3d p = points.col(scan.rings[r][i]);
      ASSERT_NEAR(Elevation(p), seen[r], 1e-4);
      if (i == 0) continue;
      const Eigen::Vector3d before = points.col(scan.rings[r][i - 1]);
      const double step =
          std::atan2(p.y(), p.x()) - std::atan2(before.y(), before.x());
      ++num_back[step > 0.0];
    }
    // One direction, except where the azimuth jumps by a full revolution.
    EXPECT_LE(std::min(num_back[0], num_back[1]), 1);
    num_in_rings += scan.rings[r].size();
  }
  EXPECT_EQ(num_in_rings, num_points);
}

TEST(EstimateScanRings, AreTheBeamsInTheOrderOfTheFile) {
  for (const Sensor& sensor : Sensors()) {
    const Points points = Simulate(sensor);
    const ScanRings scan = EstimateScanRings(points);
    EXPECT_EQ(scan.source, RingSource::kOrder);
    ExpectRingsOf(sensor, points, scan);
  }
}

TEST(EstimateScanRings, AreTheBeamsInAnyOrder) {
  for (const Sensor& sensor : Sensors()) {
    const Points ordered = Simulate(sensor);
    const Points points =
        ordered(Eigen::all, RandomPermutation(ordered.cols(), 3));
    const ScanRings scan = EstimateScanRings(points);
    EXPECT_EQ(scan.source, RingSource::kElevation);
    ExpectRingsOf(sensor, points, scan);
  }
}

// A mirrored scan rotates in the other direction.
TEST(EstimateScanRings, DoNotDependOnTheSenseOfTheTurn) {
  const Sensor sensor = Sensors()[0];
  Points points = Simulate(sensor);
  const ScanRings one = EstimateScanRings(points);
  points.row(1) *= -1.0;
  const ScanRings other = EstimateScanRings(points);
  EXPECT_EQ(other.source, RingSource::kOrder);
  EXPECT_EQ(one.rings, other.rings);
}

TEST(EstimateScanRings, AreNotToldWhereThereAreNone) {
  EXPECT_EQ(EstimateScanRings(Points(3, 0)).source, RingSource::kNone);
  EXPECT_EQ(EstimateScanRings(Points::Ones(3, 1)).source, RingSource::kNone);
  EXPECT_EQ(EstimateScanRings(Points::Ones(3, 5000)).source, RingSource::kNone);
  EXPECT_EQ(EstimateScanRings(Points::Zero(3, 5000)).source, RingSource::kNone);
  EXPECT_EQ(EstimateScanRings(RandomPoints(5000, 10.0, 1)).source,
            RingSource::kNone);
}

// The correction for the car's motion exceeds the distance between beams.
TEST(EstimateScanRings, OfKittiAre64) {
  for (const char* name : {"kitti_00/000000.bin",
                           "kitti_00/000020.bin",
                           "kitti_raw_2011_09_26_drive_0005/0000000030.bin"}) {
    const std::string path = std::string(QUATRO_DATA) + "/" + name;
    if (!std::filesystem::exists(path)) {
      GTEST_SKIP() << "there is no " << name << " in " << QUATRO_DATA;
    }
    std::string error;
    const auto cloud = ReadCloud(path, &error);
    ASSERT_TRUE(cloud) << error;
    const ScanRings scan = EstimateScanRings(cloud->points);
    EXPECT_EQ(scan.source, RingSource::kOrder) << name;
    EXPECT_EQ(scan.rings.size(), 64u) << name;
    for (std::size_t r = 1; r < scan.elevations.size(); ++r) {
      EXPECT_GT(scan.elevations[r - 1] - scan.elevations[r], 0.15 * kDegree)
          << name << ", ring " << r;
    }
  }
}

}  // namespace
}  // namespace quatro::scan_rings_test
