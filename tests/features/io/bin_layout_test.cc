// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/bin_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "features/base/file.h"
#include "features/io/cloud_fields.h"
#include "features/io/kitti_bin.h"

namespace quatro::bin_layout_test {
namespace {

using ::testing::HasSubstr;

using Row = std::vector<double>;

// A street from a scanner 1.7 m above it, its walls 7 m and 9 m away. Beams
// are in turn (0: ring by ring; otherwise all at once, as they fire).
std::vector<Row> Street(int num_points, bool by_ring, unsigned seed) {
  constexpr int kNumBeams = 16;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Row> rows;
  const int num_steps = num_points / kNumBeams;
  for (int i = 0; i < num_steps * kNumBeams; ++i) {
    const int beam = by_ring ? i / num_steps : (i * 9) % kNumBeams;
    const int step = by_ring ? i % num_steps : i / kNumBeams;
    const double azimuth = 2.0 * M_PI * step / num_steps;
    const double slope = std::tan((2.0 * beam - 15.0) * M_PI / 180.0);
    const double y = std::sin(azimuth);
    double range = std::min(60.0, (y > 0.0 ? 7.0 : 9.0) / std::abs(y));
    if (slope < 0.0) range = std::min(range, -1.7 / slope);
    range += 0.02 * uniform(random);
    rows.push_back({range * std::cos(azimuth),
                    range * y,
                    range * slope,
                    uniform(random),
                    static_cast<double>(beam),
                    0.1 * step / num_steps});
  }
  return rows;
}

std::string AsFloats(const std::vector<Row>& rows, std::size_t num_values) {
  std::string bytes;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < num_values; ++i) {
      AppendLittleEndian(static_cast<float>(row[i]), &bytes);
    }
  }
  return bytes;
}

std::string AsDoubles(const std::vector<Row>& rows, std::size_t num_values) {
  std::string bytes;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < num_values; ++i) {
      AppendLittleEndian(row[i], &bytes);
    }
  }
  return bytes;
}

void ExpectLayout(const std::string& bytes, int num_values, ScalarType type) {
  ASSERT_EQ(bytes.size() % 16, 0u);
  std::string error;
  const auto layout = FindBinLayout(bytes, 0, &error);
  ASSERT_TRUE(layout) << error;
  EXPECT_EQ(layout->num_values, num_values);
  EXPECT_EQ(layout->type, type);
}

std::string ErrorOf(const std::string& bytes, int num_values = 0) {
  std::string error;
  EXPECT_FALSE(FindBinLayout(bytes, num_values, &error));
  return error;
}

TEST(FindBinLayout, TellsEveryLayoutOfAStreet) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    for (const int num_points : {256, 1920, 32000}) {
      for (const bool by_ring : {false, true}) {
        SCOPED_TRACE(testing::Message()
                     << "seed " << seed << ", " << num_points << " points"
                     << (by_ring ? ", by ring" : ""));
        std::vector<Row> rows = Street(num_points, by_ring, seed);
        if (seed % 2 == 1) {  // As voxel filters leave them.
          std::shuffle(rows.begin(), rows.end(), std::mt19937(seed));
        }
        for (const std::size_t n : {3u, 4u, 5u, 6u}) {
          ExpectLayout(
              AsFloats(rows, n), static_cast<int>(n), ScalarType::kFloat32);
          ExpectLayout(
              AsDoubles(rows, n), static_cast<int>(n), ScalarType::kFloat64);
        }
      }
    }
  }
}

TEST(FindBinLayout, IntensityMayBeOfAnyScaleOrMissing) {
  for (const double scale : {0.0, 1.0, 255.0, 65535.0}) {
    std::vector<Row> rows = Street(3200, true, 1);
    for (Row& row : rows) row[3] = std::round(scale * row[3]);
    ExpectLayout(AsFloats(rows, 4), 4, ScalarType::kFloat32);
    ExpectLayout(AsFloats(rows, 5), 5, ScalarType::kFloat32);
  }
}

TEST(FindBinLayout, ColorsAreNoIntensityOfThreeFloats) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> color(0, 255);
  std::vector<Row> rows = Street(3200, false, 3);
  for (Row& row : rows) {
    for (std::size_t i = 3; i < 6; ++i) row[i] = color(random);
  }
  ExpectLayout(AsFloats(rows, 6), 6, ScalarType::kFloat32);
}

TEST(FindBinLayout, DoublesThatWereFloatsOrWholeNumbersAreTold) {
  std::vector<Row> rows = Street(3200, true, 1);
  for (Row& row : rows) {
    for (double& value : row) value = static_cast<float>(value);
  }
  ExpectLayout(AsDoubles(rows, 4), 4, ScalarType::kFloat64);
  for (Row& row : rows) {
    for (double& value : row) value = std::round(value);
  }
  ExpectLayout(AsDoubles(rows, 3), 3, ScalarType::kFloat64);
}

// A raw Livox scan has them where nothing came back.
TEST(FindBinLayout, PointsAtTheOriginAndNansTellNothing) {
  for (const double filler : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    for (const unsigned share : {2u, 10u}) {
      for (const std::size_t n : {3u, 4u, 5u}) {
        std::mt19937 random(7);
        std::vector<Row> rows = Street(32000, true, 7);
        for (Row& row : rows) {
          if (random() % share != 0) std::fill(row.begin(), row.end(), filler);
        }
        SCOPED_TRACE(testing::Message() << filler << ", 1 of " << share
                                        << " left, " << n << " floats");
        ExpectLayout(
            AsFloats(rows, n), static_cast<int>(n), ScalarType::kFloat32);
      }
    }
  }
}

TEST(FindBinLayout, LastColumnsMayBeZero) {
  std::vector<Row> rows = Street(3200, true, 1);
  for (Row& row : rows) row.resize(3);
  for (const std::size_t num_values : {6u, 8u, 9u, 16u}) {
    for (Row& row : rows) row.resize(num_values, 0.0);
    for (const std::size_t num_points : {400u, 3200u}) {
      const std::vector<Row> some(
          rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(num_points));
      if (num_values == 6) {
        ExpectLayout(AsFloats(some, 6), 6, ScalarType::kFloat32);
        continue;
      }
      EXPECT_THAT(ErrorOf(AsFloats(some, num_values)),
                  HasSubstr("a point seems to have " +
                            std::to_string(num_values) + " numbers"));
    }
  }
}

// x, y, z and the intensity, of 8 float32.
TEST(FindBinLayout, HalfOfThePointMayBeZero) {
  std::vector<Row> rows = Street(3200, true, 1);
  for (Row& row : rows) {
    row.resize(4);
    row.resize(8, 0.0);
  }
  EXPECT_THAT(ErrorOf(AsFloats(rows, 8)), HasSubstr("set point_floats=8"));
  // One further value that is not zero makes it four numbers a point again.
  std::string bytes = AsFloats(rows, 8);
  bytes.replace(20, 4, AsFloats({{1.0}}, 1));
  ExpectLayout(bytes, 4, ScalarType::kFloat32);
}

TEST(FindBinLayout, StrayPointsDoNotMatter) {
  std::vector<Row> rows = Street(3200, true, 1);
  rows[100] = {3e38, 1e20, 0.0, 0.5, 1.0, 0.0};
  ExpectLayout(AsFloats(rows, 4), 4, ScalarType::kFloat32);
  ExpectLayout(AsFloats(rows, 5), 5, ScalarType::kFloat32);
}

TEST(FindBinLayout, RefusesColumnsThatAreAlike) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<Row> rows(4096, Row(3));
  for (Row& row : rows) {
    for (double& value : row) value = normal(random);
  }
  const std::string bytes = AsFloats(rows, 3);
  EXPECT_EQ(ErrorOf(bytes),
            "cannot tell how many numbers a point has; if x, y, z and "
            "intensity as float32, set point_floats=4");
  std::string error;
  EXPECT_EQ(FindBinLayout(bytes, 3, &error)->num_values, 3);
  EXPECT_EQ(FindBinLayout(bytes, 4, &error)->num_values, 4);
}

TEST(FindBinLayout, RefusesNoiseByItsCoordinates) {
  std::mt19937 random(5);
  std::string bytes(16000, '\0');
  for (char& c : bytes) c = static_cast<char>(random());
  EXPECT_THAT(ErrorOf(bytes),
              HasSubstr("m. The file is probably not float32 x, y, z, "
                        "intensity; set point_floats or convert it"));
}

TEST(FindBinLayout, RefusesWiderPointsAndHalfPoints) {
  std::vector<Row> rows = Street(3200, true, 1);
  for (Row& row : rows) row.insert(row.end(), {1000.0, 2000.0});
  EXPECT_THAT(ErrorOf(AsFloats(rows, 8)), HasSubstr("set point_floats=8"));
  std::string error;
  EXPECT_EQ(FindBinLayout(AsFloats(rows, 8), 8, &error)->PointSize(), 32u);
  const std::string five = AsFloats(rows, 5);
  EXPECT_THAT(
      ErrorOf(five.substr(0, five.size() - 16)),
      HasSubstr("is not a multiple of 20 (5 numbers a point as float32)"));
  EXPECT_THAT(ErrorOf(five.substr(0, five.size() - 3)),
              HasSubstr("is not a multiple of 16"));
  EXPECT_THAT(ErrorOf(five, 3), HasSubstr("is not a multiple of 12"));
}

// The size of 48 points of 3 floats is that of 36 points of 4.
TEST(FindBinLayout, FewPointsOfAnotherLayoutAreNotReadAsKittis) {
  const std::vector<Row> street = Street(3200, false, 1);
  const auto some = [&](std::ptrdiff_t num_points) {
    return std::vector<Row>(street.begin(), street.begin() + num_points);
  };
  const std::string too_few =
      "has too few points to tell the layout; set point_floats";
  EXPECT_EQ(ErrorOf(AsFloats(some(48), 3)), too_few);
  EXPECT_EQ(ErrorOf(AsFloats(some(40), 5)), too_few);
  EXPECT_EQ(ErrorOf(AsFloats(some(40), 6)), too_few);
  std::string error;
  EXPECT_EQ(FindBinLayout(AsFloats(some(48), 3), 3, &error)->num_values, 3);
  for (const std::ptrdiff_t num_points : {15, 30, 48, 60}) {
    ExpectLayout(AsFloats(some(num_points), 4), 4, ScalarType::kFloat32);
  }
  EXPECT_THAT(ErrorOf(AsDoubles(some(24), 3)),
              HasSubstr("The file is probably not float32"));
}

// Negative int32 are NaNs as float32, and positive ones are tiny.
TEST(FindBinLayout, IntegersAreNotFloat32) {
  for (const int num_points : {16, 48, 3200}) {
    std::string bytes;
    for (const Row& row : Street(num_points, true, 1)) {
      for (std::size_t i = 0; i < 4; ++i) {
        const auto millimeters = static_cast<std::int32_t>(1000.0 * row[i]);
        AppendLittleEndian(std::bit_cast<float>(millimeters), &bytes);
      }
    }
    for (const int num_values : {0, 4}) {
      EXPECT_THAT(ErrorOf(bytes, num_values), HasSubstr("is not float32"));
    }
  }
  // Integers behind the coordinates do not matter if the layout is given.
  std::vector<Row> rows = Street(3200, true, 1);
  for (Row& row : rows) row.resize(9, 1e-42);
  std::string error;
  EXPECT_TRUE(FindBinLayout(AsFloats(rows, 9), 9, &error)) << error;
}

TEST(ParseKittiBin, ReadsTheFirstFourNumbers) {
  const std::vector<Row> rows = Street(320, true, 1);
  std::string error;
  for (const std::size_t n : {3u, 4u, 5u, 6u}) {
    for (const std::string& bytes : {AsFloats(rows, n), AsDoubles(rows, n)}) {
      const auto cloud = ParseKittiBin(bytes, 0, &error);
      ASSERT_TRUE(cloud) << error;
      ASSERT_EQ(cloud->points.cols(), 320);
      EXPECT_NEAR(cloud->points(2, 300), rows[300][2], 1e-5);
      ASSERT_EQ(cloud->intensity.size(), n == 3 ? 0 : 320);
      if (n > 3) {
        EXPECT_NEAR(cloud->intensity[300], rows[300][3], 1e-6);
      }
    }
  }
}

TEST(RealBins, AreOfFourFloats) {
  std::error_code code;
  std::filesystem::recursive_directory_iterator entry(QUATRO_DATA, code);
  int num_files = 0;
  for (; !code && entry != std::filesystem::recursive_directory_iterator();
       entry.increment(code)) {
    if (entry->path().extension() != ".bin") continue;
    std::string error;
    const auto bytes = ReadWholeFile(entry->path().string(), &error);
    ASSERT_TRUE(bytes) << error;
    SCOPED_TRACE(entry->path().string());
    ExpectLayout(*bytes, 4, ScalarType::kFloat32);
    ++num_files;
  }
  if (num_files == 0) GTEST_SKIP() << "needs .bin files in " << QUATRO_DATA;
}

}  // namespace
}  // namespace quatro::bin_layout_test
