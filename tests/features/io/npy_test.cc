// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/npy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "features/io/cloud_fields.h"

namespace quatro::npy_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr std::size_t kNumRows = 5;

double At(std::size_t row, std::size_t column) {
  return 1.0 + 0.1 * static_cast<double>(10 * row + column);
}

// As numpy.save() writes it, in version 1, 2 or 3 of the format.
std::string Npy(char version,
                const std::string& dictionary,
                const std::string& numbers) {
  std::string header = dictionary;
  const std::size_t start = version == 1 ? 10 : 12;
  while ((start + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += version;
  bytes += '\0';
  for (std::size_t i = 0; i < start - 8; ++i) {
    bytes += static_cast<char>((header.size() >> (8 * i)) & 0xff);
  }
  return bytes + header + numbers;
}

std::string Dictionary(const std::string& descr,
                       const std::string& fortran_order,
                       const std::string& shape) {
  return "{'descr': '" + descr + "', 'fortran_order': " + fortran_order +
         ", 'shape': " + shape + ", }";
}

template <typename Number>
std::string Numbers(std::size_t num_columns, bool is_fortran) {
  std::string bytes;
  for (std::size_t k = 0; k < kNumRows * num_columns; ++k) {
    const double value = is_fortran ? At(k % kNumRows, k / kNumRows)
                                    : At(k / num_columns, k % num_columns);
    AppendLittleEndian(static_cast<Number>(value), &bytes);
  }
  return bytes;
}

std::string ShapeOf(std::size_t num_columns) {
  return "(" + std::to_string(kNumRows) + ", " + std::to_string(num_columns) +
         ")";
}

std::string ErrorOf(const std::string& bytes) {
  std::string error;
  EXPECT_FALSE(ParseNpy(bytes, &error));
  EXPECT_EQ(error.find('\n'), std::string::npos);
  return error;
}

// A C array of N x 3 float64 with another header.
std::string ErrorOf(const std::string& descr,
                    const std::string& fortran_order,
                    const std::string& shape) {
  return ErrorOf(Npy(
      1, Dictionary(descr, fortran_order, shape), Numbers<double>(3, false)));
}

TEST(ParseNpy, ReadsBothTypesOrdersAndAllVersions) {
  int num_read = 0;
  for (const char version : {'\1', '\2', '\3'}) {
    for (const bool is_fortran : {false, true}) {
      for (const bool is_double : {false, true}) {
        for (const std::size_t num_columns : {3u, 4u, 5u, 6u, 64u}) {
          std::string error;
          const auto cloud =
              ParseNpy(Npy(version,
                           Dictionary(is_double ? "<f8" : "<f4",
                                      is_fortran ? "True" : "False",
                                      ShapeOf(num_columns)),
                           is_double ? Numbers<double>(num_columns, is_fortran)
                                     : Numbers<float>(num_columns, is_fortran)),
                       &error);
          ASSERT_TRUE(cloud) << error;
          ASSERT_EQ(cloud->points.cols(), static_cast<int>(kNumRows));
          for (std::size_t row = 0; row < kNumRows; ++row) {
            for (std::size_t k = 0; k < 3; ++k) {
              EXPECT_NEAR(cloud->points(static_cast<Eigen::Index>(k),
                                        static_cast<Eigen::Index>(row)),
                          At(row, k),
                          is_double ? 0.0 : 1e-6);
            }
          }
          const bool has_intensity = num_columns == 4 || num_columns == 5;
          ASSERT_EQ(cloud->intensity.size(),
                    has_intensity ? static_cast<int>(kNumRows) : 0);
          if (has_intensity) {
            EXPECT_EQ(cloud->intensity[2], static_cast<float>(At(2, 3)));
          }
          ++num_read;
        }
      }
    }
  }
  EXPECT_EQ(num_read, 60);
}

TEST(ParseNpy, TheHeadersKeysMayBeInAnyOrder) {
  std::string error;
  const auto cloud = ParseNpy(
      Npy(1,
          "{\"shape\": (5,3),\"fortran_order\":False,\"descr\":\"<f8\"}",
          Numbers<double>(3, false)),
      &error);
  ASSERT_TRUE(cloud) << error;
  EXPECT_EQ(cloud->points(2, 4), At(4, 2));
}

TEST(ParseNpy, DropsAndCountsZerosAndNans) {
  std::string numbers;
  for (const double value : {0.0,
                             0.0,
                             0.0,
                             1.0,
                             2.0,
                             3.0,
                             std::numeric_limits<double>::quiet_NaN(),
                             5.0,
                             6.0}) {
    AppendLittleEndian(value, &numbers);
  }
  std::string error;
  const auto cloud =
      ParseNpy(Npy(1, Dictionary("<f8", "False", "(3, 3)"), numbers), &error);
  ASSERT_TRUE(cloud) << error;
  EXPECT_EQ(cloud->num_dropped, 2);
  EXPECT_EQ(cloud->points.col(0), Eigen::Vector3d(1.0, 2.0, 3.0));
}

TEST(ParseNpy, RefusesOtherTypes) {
  for (const std::string type : {">f4", ">f8", "<i4", "<f2", "|u1", "|O"}) {
    EXPECT_EQ(ErrorOf(type, "False", "(5, 3)"),
              "dtype '" + type +
                  "': must be '<f4' or '<f8'; save array.astype('<f4')");
  }
  EXPECT_EQ(ErrorOf(Npy(1,
                        "{'descr': [('x', '<f4'), ('y', '<f4')], "
                        "'fortran_order': False, 'shape': (5,), }",
                        "")),
            "is a structured array; save x, y and z as columns of one float32 "
            "or float64 array");
}

TEST(ParseNpy, RefusesOtherShapes) {
  const std::string must_be =
      ": must be (N, 3) to (N, 64), a point in each row";
  EXPECT_EQ(ErrorOf("<f8", "False", "(15,)"), "shape '(15,)'" + must_be);
  EXPECT_EQ(ErrorOf("<f8", "False", "()"), "shape '()'" + must_be);
  EXPECT_EQ(ErrorOf("<f8", "False", "(5, 2)"), "shape '(5, 2)'" + must_be);
  EXPECT_EQ(ErrorOf("<f8", "False", "(5, -3)"), "shape '(5, -3)'" + must_be);
  EXPECT_EQ(ErrorOf("<f8", "False", "(3, 500)"),
            "shape '(3, 500)'" + must_be + "; save array.T");
  EXPECT_EQ(ErrorOf("<f8", "False", "(64, 1024, 4)"),
            "shape '(64, 1024, 4)'" + must_be + "; save array.reshape(-1, 4)");
}

TEST(ParseNpy, RefusesFilesThatAreCutOffOrTooLong) {
  const std::string whole =
      Npy(1, Dictionary("<f8", "False", "(5, 3)"), Numbers<double>(3, false));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THAT(ErrorOf(whole.substr(0, size)), Not(IsEmpty()));
  }
  EXPECT_EQ(ErrorOf(whole.substr(0, whole.size() - 24)),
            "96 bytes of numbers, must be 5 x 3 of 8 bytes as the header says; "
            "is the file truncated?");
  EXPECT_THAT(ErrorOf(whole + std::string(24, 'a')), HasSubstr("144 bytes"));
  // A product beyond 64 bits.
  EXPECT_THAT(
      ErrorOf("<f8", "False", "(768614336404564656, 3)"),
      HasSubstr("120 bytes of numbers, must be 768614336404564656 x 3"));
  EXPECT_THAT(ErrorOf("<f8", "Maybe", "(5, 3)"),
              HasSubstr("fortran_order 'Maybe': must be True or False"));
  EXPECT_EQ(ErrorOf("1 2 3\n4 5 6\n"),
            "is not a NumPy array; it must start with \\x93NUMPY");
}

}  // namespace
}  // namespace quatro::npy_test
