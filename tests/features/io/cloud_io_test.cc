// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/cloud_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <liblzf/lzf.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <clocale>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "features/base/file.h"
#include "features/io/kitti_bin.h"
#include "features/io/pcd.h"
#include "features/io/ply.h"

namespace quatro::cloud_io_test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

// The bytes of `values`. This machine is little-endian.
template <typename T>
std::string Little(std::initializer_list<T> values) {
  std::string bytes;
  for (const T value : values) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes.append(raw, sizeof(T));
  }
  return bytes;
}

template <typename T>
std::string Big(std::initializer_list<T> values) {
  std::string bytes;
  for (const T value : values) {
    std::string raw = Little({value});
    std::reverse(raw.begin(), raw.end());
    bytes += raw;
  }
  return bytes;
}

std::string Ply(const std::string& format,
                const std::string& elements,
                const std::string& body) {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n" + body;
}

constexpr char kXyz[] =
    "property float x\nproperty float y\nproperty float z\n";

std::string AsciiPly(const std::string& num_points, const std::string& body) {
  return Ply("ascii", "element vertex " + num_points + "\n" + kXyz, body);
}

// A PCD header with fields float x y z.
std::string PcdXyz(const std::string& num_points, const std::string& data) {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"
         "COUNT 1 1 1\nWIDTH " +
         num_points + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
         num_points + "\nDATA " + data + "\n";
}

// The sizes and the data of binary_compressed.
std::string Compressed(const std::string& data) {
  std::string compressed(2 * data.size() + 64, '\0');
  compressed.resize(lzf_compress(data.data(),
                                 static_cast<unsigned int>(data.size()),
                                 compressed.data(),
                                 static_cast<unsigned int>(compressed.size())));
  return Little({static_cast<std::uint32_t>(compressed.size()),
                 static_cast<std::uint32_t>(data.size())}) +
         compressed;
}

// The points 1 2 3 and 4 5 6, field by field.
const std::string kTwoByField = Little({1.0f, 4.0f, 2.0f, 5.0f, 3.0f, 6.0f});

PointCloud RandomCloud(Eigen::Index num_points, bool has_intensity) {
  std::mt19937 rng(20220523);
  std::normal_distribution<double> normal(0.0, 30.0);
  PointCloud cloud;
  cloud.points =
      Points::NullaryExpr(3, num_points, [&] { return normal(rng); });
  if (has_intensity) {
    cloud.intensity = Eigen::VectorXf::NullaryExpr(
        num_points, [&] { return static_cast<float>(normal(rng)); });
  }
  return cloud;
}

// Drops root's rights for a while, because root may read and write everything.
class WithoutRoot {
 public:
  WithoutRoot() {
    if (is_root_) {
      EXPECT_EQ(seteuid(65534), 0);
    }
  }
  ~WithoutRoot() {
    if (is_root_) {
      EXPECT_EQ(seteuid(0), 0);
    }
  }

 private:
  const bool is_root_ = geteuid() == 0;
};

// A temporary directory, removed afterwards.
class CloudIoTest : public ::testing::Test {
 protected:
  CloudIoTest() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    directory_ = ::testing::TempDir() + "cloud_io_test_" + test->name() + "_" +
                 std::to_string(getpid());
    std::filesystem::remove_all(directory_);
    std::filesystem::create_directories(directory_);
  }
  ~CloudIoTest() override { std::filesystem::remove_all(directory_); }

  std::string PathOf(const std::string& name) const {
    return directory_ + "/" + name;
  }

  std::string Write(const std::string& name, const std::string& bytes) const {
    std::ofstream(PathOf(name), std::ios::binary) << bytes;
    return PathOf(name);
  }

  // Reads a file that must be readable.
  PointCloud Read(const std::string& name, const std::string& bytes) const {
    std::string error;
    const auto cloud = ReadCloud(Write(name, bytes), &error);
    EXPECT_TRUE(cloud.has_value()) << error;
    return cloud.value_or(PointCloud());
  }

  // The reason why a file is rejected, without its path.
  std::string ErrorOf(const std::string& name, const std::string& bytes) const {
    return ErrorAt(Write(name, bytes));
  }

  static std::string ErrorAt(const std::string& path) {
    std::string error;
    EXPECT_FALSE(ReadCloud(path, &error).has_value());
    EXPECT_THAT(error, StartsWith(path + ": "));
    EXPECT_THAT(error, Not(HasSubstr("\n")));
    return error.substr(std::min(error.size(), path.size() + 2));
  }

  std::size_t NumFiles() const {
    std::size_t num_files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(directory_)) {
      static_cast<void>(entry);
      ++num_files;
    }
    return num_files;
  }

  std::string directory_;
};

// `text` with other line ends.
std::string WithEnds(const std::string& end, const std::string& text) {
  std::string changed;
  for (const char c : text) changed += c == '\n' ? end : std::string(1, c);
  return changed;
}

// The two points of most samples below.
void ExpectTwoPoints(const PointCloud& cloud) {
  Points expected(3, 2);
  expected << 1, 4, 2, 5, 3, 6;
  ASSERT_EQ(cloud.points.cols(), 2);
  EXPECT_EQ(cloud.points, expected);
  EXPECT_EQ(cloud.num_dropped, 0);
}

// An error starts with path and place, followed by the reason.

TEST_F(CloudIoTest, RefusesAMissingFile) {
  EXPECT_THAT(ErrorAt(PathOf("none.ply")),
              HasSubstr("No such file or directory"));
}

TEST_F(CloudIoTest, SaysThatTheShellDidNotExpandATilde) {
  EXPECT_THAT(ErrorAt("~/quatro.ply"),
              HasSubstr("the shell left ~ as it is, write $HOME"));
}

TEST_F(CloudIoTest, RefusesADirectory) {
  std::filesystem::create_directory(PathOf("directory.bin"));
  EXPECT_EQ(ErrorAt(PathOf("directory.bin")), "is a directory, not a file");
  EXPECT_EQ(ErrorAt(directory_), "is a directory, not a file");
}

TEST_F(CloudIoTest, RefusesAPipeWithoutWaitingForItsWriter) {
  ASSERT_EQ(mkfifo(PathOf("pipe.pcd").c_str(), 0600), 0);
  EXPECT_EQ(ErrorAt(PathOf("pipe.pcd")), "is not a regular file");
}

TEST_F(CloudIoTest, RefusesAnUnreadableFile) {
  const std::string path = Write("secret.bin", std::string(16, '\0'));
  ASSERT_EQ(chmod(path.c_str(), 0), 0);
  const WithoutRoot without_root;
  EXPECT_THAT(ErrorAt(path), HasSubstr("Permission denied"));
}

TEST_F(CloudIoTest, RefusesAnEmptyFile) {
  for (const char* name : {"a.bin", "a.ply", "a.pcd"}) {
    EXPECT_EQ(ErrorOf(name, ""), "is empty");
  }
}

TEST_F(CloudIoTest, RefusesAnUnknownEnding) {
  const std::string must_be =
      ": must be .bin, .ply, .pcd, .npy, .xyz, .txt or .csv, each also with "
      ".gz";
  EXPECT_EQ(ErrorOf("a.las", "1 2 3\n"), "ending '.las'" + must_be);
  EXPECT_EQ(ErrorOf("bin", "1 2 3\n"), "ending ''" + must_be);
  EXPECT_EQ(ErrorOf("a.las.gz", "1 2 3\n"), "ending '.las.gz'" + must_be);
  EXPECT_EQ(ErrorOf("a.gz", "1 2 3\n"), "ending '.gz'" + must_be);
}

TEST_F(CloudIoTest, DoesNotTakeTheEndingOfADirectory) {
  std::filesystem::create_directory(PathOf("scans.bin"));
  EXPECT_THAT(ErrorOf("scans.bin/scan", "1"), StartsWith("ending ''"));
}

TEST_F(CloudIoTest, IgnoresTheCaseOfTheEnding) {
  Read("A.BIN", Little({1.0f, 2.0f, 3.0f, 0.5f}));
  Read("A.Ply", AsciiPly("1", "1 2 3\n"));
  Read("A.pCD", PcdXyz("1", "ascii") + "1 2 3\n");
}

TEST_F(CloudIoTest, QuotesNothingThatBreaksTheLineOrTheScreen) {
  const std::string error =
      ErrorOf("a.ply", AsciiPly("1", "1 2 \x1b[2J" + std::string(999, 'a')));
  EXPECT_THAT(error, Not(HasSubstr("\x1b")));
  EXPECT_LT(error.size(), 120);
}

// KITTI .bin

TEST_F(CloudIoTest, BinIsFloatsWithIntensity) {
  const PointCloud cloud =
      Read("a.bin", Little({1.0f, 2.0f, 3.0f, 0.25f, 4.0f, 5.0f, 6.0f, 0.75f}));
  ExpectTwoPoints(cloud);
  EXPECT_EQ(cloud.intensity, Eigen::Vector2f(0.25f, 0.75f));
}

TEST_F(CloudIoTest, BinRefusesHalfAPoint) {
  EXPECT_EQ(ErrorOf("scan.bin", std::string(1993, '\0')),
            "size 1993 bytes is not a multiple of 16 (x y z intensity as "
            "float32); is it truncated, or of another layout "
            "(point_floats)?");
}

TEST_F(CloudIoTest, BinDropsAndCountsWhatIsNotFinite) {
  const PointCloud cloud = Read("a.bin", Little({kNan, 0.0f, 0.0f,  9.0f,  //
                                                 1.0f, 2.0f, 3.0f,  kNan,  //
                                                 0.0f, kInf, 0.0f,  9.0f,  //
                                                 4.0f, 5.0f, 6.0f,  0.5f,  //
                                                 0.0f, 0.0f, -kInf, 9.0f}));
  EXPECT_EQ(cloud.num_dropped, 3);
  ASSERT_EQ(cloud.points.cols(), 2);
  EXPECT_EQ(cloud.points.col(1), Eigen::Vector3d(4.0, 5.0, 6.0));
  ASSERT_EQ(cloud.intensity.size(), 2);
  EXPECT_TRUE(std::isnan(cloud.intensity[0]));
  EXPECT_EQ(cloud.intensity[1], 0.5f);
}

TEST_F(CloudIoTest, KeepsWhatIsFarAway) {
  const PointCloud cloud = Read("a.ply", AsciiPly("1", "1e15 -1e300 3\n"));
  EXPECT_EQ(cloud.points.col(0), Eigen::Vector3d(1e15, -1e300, 3.0));
}

TEST_F(CloudIoTest, RefusesACloudWithoutAFinitePoint) {
  const std::string kReason = "points: none of 1 is finite and not zero";
  EXPECT_EQ(ErrorOf("a.bin", Little({kNan, kNan, kNan, 1.0f})), kReason);
  EXPECT_EQ(ErrorOf("a.ply", AsciiPly("1", "nan 2 3\n")), kReason);
  EXPECT_EQ(ErrorOf("a.pcd", PcdXyz("1", "ascii") + "1 inf 3\n"), kReason);
}

// Raw Livox frames keep them where nothing came back.
TEST_F(CloudIoTest, PointsAtTheOriginAreDroppedAndCounted) {
  const auto expect_two = [](const PointCloud& cloud) {
    EXPECT_EQ(cloud.num_dropped, 3);
    ASSERT_EQ(cloud.points.cols(), 2);
    EXPECT_EQ(cloud.points.col(0), Eigen::Vector3d(1.0, 0.0, 0.0));
    EXPECT_EQ(cloud.points.col(1), Eigen::Vector3d(4.0, 5.0, 6.0));
  };
  const std::string lines = "0 0 0\n1 0 0\n-0 0 -0.0\n4 5 6\nnan 5 6\n";
  expect_two(Read("a.ply", AsciiPly("5", lines)));
  expect_two(Read("a.pcd", PcdXyz("5", "ascii") + lines));
  expect_two(Read("a.xyz", lines));
  expect_two(Read("a.bin", Little({0.0f, 0.0f, 0.0f,  9.0f,  //
                                   1.0f, 0.0f, 0.0f,  9.0f,  //
                                   0.0f, 0.0f, -0.0f, 9.0f,  //
                                   4.0f, 5.0f, 6.0f,  9.0f,  //
                                   kNan, 5.0f, 6.0f,  9.0f})));
  EXPECT_EQ(ErrorOf("a.xyz", "0 0 0\n0 0 0\n"),
            "points: none of 2 is finite and not zero");
}

// PLY

TEST_F(CloudIoTest, PlyAscii) {
  ExpectTwoPoints(Read("a.ply", AsciiPly("2", "1 2 3\n4 5 6\n")));
}

TEST_F(CloudIoTest, PlyAsciiTakesEveryWayToWriteANumber) {
  const PointCloud cloud = Read(
      "a.ply",
      AsciiPly("4", "+1 2.0e0 \t 3.\n\n  4 +5e+0 600E-2 \n+nan 0 0\n-INF 0 0"));
  EXPECT_EQ(cloud.num_dropped, 2);
  EXPECT_EQ(cloud.points.col(0), Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(cloud.points.col(1), Eigen::Vector3d(4.0, 5.0, 6.0));
}

TEST_F(CloudIoTest, PlyAsciiDoesNotDependOnTheLocale) {
  const std::string previous = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) {
    GTEST_SKIP() << "needs locale de_DE.UTF-8";
  }
  const PointCloud cloud = Read("a.ply", AsciiPly("1", "1.5 2.5 3.5\n"));
  std::setlocale(LC_ALL, previous.c_str());
  EXPECT_EQ(cloud.points.col(0), Eigen::Vector3d(1.5, 2.5, 3.5));
}

TEST_F(CloudIoTest, PlyCommentsAndDosLineEnds) {
  ExpectTwoPoints(
      Read("a.ply",
           "ply\r\ncomment end_header is not here\r\nformat "
           "binary_little_endian 1.0\r\nobj_info made by hand\r\n"
           "element vertex 2\r\nproperty float x\r\nproperty float y\r\n"
           "comment\r\nproperty float z\r\nend_header\r\n" +
               Little({1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f})));
  ExpectTwoPoints(
      Read("b.ply",
           "ply\r\nformat ascii 1.0\r\nelement vertex 2\r\nproperty float x\r\n"
           "property float y\r\nproperty float z\r\nend_header\r\n"
           "1 2 3\r\n4 5 6\r\n"));
}

TEST_F(CloudIoTest, PlyBigEndian) {
  const PointCloud cloud =
      Read("a.ply",
           Ply("binary_big_endian",
               std::string("element vertex 2\n") + kXyz +
                   "property short intensity\n",
               std::string(
                   "\x3f\x80\x00\x00\x40\x00\x00\x00\x40\x40\x00\x00\x01\x02"
                   "\x40\x80\x00\x00\x40\xa0\x00\x00\x40\xc0\x00\x00\xff\xff",
                   28)));
  ExpectTwoPoints(cloud);
  EXPECT_EQ(cloud.intensity, Eigen::Vector2f(258.0f, -1.0f));
}

TEST_F(CloudIoTest, PlyPropertiesInAnyOrderAndType) {
  const std::string elements =
      "element vertex 2\nproperty uchar red\nproperty ushort z\n"
      "property int8 a\nproperty double b\nproperty int64 x\n"
      "property uint c\nproperty float32 reflectance\nproperty char y\n";
  const auto row = [](std::int64_t x, std::int8_t y, std::uint16_t z, float r) {
    return Little<std::uint8_t>({255}) + Little({z}) +
           Little<std::int8_t>({-1}) + Little({1e300}) + Little({x}) +
           Little<std::uint32_t>({7}) + Little({r}) + Little({y});
  };
  const PointCloud cloud =
      Read("a.ply",
           Ply("binary_little_endian",
               elements,
               row(1, 2, 3, 0.5f) + row(-4000000000, -5, 65535, 0.75f)));
  EXPECT_EQ(cloud.points.col(0), Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(cloud.points.col(1), Eigen::Vector3d(-4e9, -5.0, 65535.0));
  EXPECT_EQ(cloud.intensity, Eigen::Vector2f(0.5f, 0.75f));
}

TEST_F(CloudIoTest, PlyKnowsEveryTypeInBothOrders) {
  const auto check = [&](const std::string& type, auto value) {
    const std::string elements = "element vertex 1\nproperty " + type +
                                 " x\nproperty " + type + " y\nproperty " +
                                 type + " z\n";
    for (const bool is_big : {false, true}) {
      const PointCloud cloud =
          Read("a.ply",
               Ply(is_big ? "binary_big_endian" : "binary_little_endian",
                   elements,
                   is_big ? Big({value, value, value})
                          : Little({value, value, value})));
      ASSERT_EQ(cloud.points.cols(), 1) << type;
      EXPECT_EQ(cloud.points(2, 0), static_cast<double>(value)) << type;
    }
  };
  for (const char* type : {"char", "int8"}) check(type, std::int8_t{-100});
  for (const char* type : {"uchar", "uint8"}) check(type, std::uint8_t{200});
  for (const char* type : {"short", "int16"}) check(type, std::int16_t{-30000});
  for (const char* type : {"ushort", "uint16"}) {
    check(type, std::uint16_t{60000});
  }
  for (const char* type : {"int", "int32"}) check(type, -2000000000);
  for (const char* type : {"uint", "uint32"}) check(type, 4000000000u);
  check("int64", std::int64_t{-4000000000});
  check("uint64", std::uint64_t{40000000000});
  for (const char* type : {"float", "float32"}) check(type, 0.1f);
  for (const char* type : {"double", "float64"}) check(type, 0.1);
}

TEST_F(CloudIoTest, PlySkipsListsAndElementsBeforeTheVertices) {
  const std::string elements =
      "element camera 2\nproperty list uchar int ids\nproperty double f\n"
      "element nothing 5\n"
      "element vertex 2\nproperty float x\nproperty list ushort short track\n"
      "property float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\n";
  ExpectTwoPoints(Read("a.ply",
                       Ply("ascii",
                           elements,
                           "3 7 8 9 0.5\n0 0.5\n"
                           "1 2 -1 -2 2 3\n4 0 5 6\n3 0 1 0\n")));
  ExpectTwoPoints(Read(
      "b.ply",
      Ply("binary_little_endian",
          elements,
          "\x03" + Little({7, 8, 9}) + Little({0.5}) + std::string(1, '\0') +
              Little({0.5}) + Little({1.0f}) + Little<std::uint16_t>({2}) +
              Little<std::int16_t>({-1, -2}) + Little({2.0f, 3.0f, 4.0f}) +
              Little<std::uint16_t>({0}) + Little({5.0f, 6.0f}))));
}

TEST_F(CloudIoTest, PlyKnowsTheNamesOfIntensity) {
  for (const std::string name :
       {"intensity", "scalar_intensity", "scalar_Intensity", "reflectance"}) {
    const PointCloud cloud =
        Read("a.ply",
             Ply("ascii",
                 "element vertex 1\nproperty float " + name + "\n" + kXyz,
                 "0.5 1 2 3\n"));
    ASSERT_EQ(cloud.intensity.size(), 1) << name;
    EXPECT_EQ(cloud.intensity[0], 0.5f) << name;
  }
  EXPECT_EQ(Read("a.ply", AsciiPly("1", "1 2 3\n")).intensity.size(), 0);
}

TEST_F(CloudIoTest, PlyRefusesFewerPointsThanPromised) {
  EXPECT_EQ(ErrorOf("a.ply", AsciiPly("3", "1 2 3\n4 5 6\n")),
            "element 'vertex': promises 3 points but holds 2; is the file "
            "truncated?");
  EXPECT_EQ(ErrorOf("b.ply",
                    Ply("binary_little_endian",
                        std::string("element vertex 24613\n") + kXyz,
                        std::string(1210, 'a'))),
            "element 'vertex': promises 24613 points but holds 100; is the "
            "file truncated?");
}

TEST_F(CloudIoTest, PlyRefusesAListThatLeavesTheFile) {
  const std::string elements =
      std::string("element vertex 1\nproperty list uint int a\n") + kXyz;
  EXPECT_THAT(ErrorOf("a.ply",
                      Ply("binary_little_endian",
                          elements,
                          Little({4294967295u, 1u, 2u, 3u}))),
              HasSubstr("promises 1 points but holds 0"));
  EXPECT_EQ(
      ErrorOf("b.ply", Ply("ascii", elements, "18446744073709551615 1\n")),
      "element 'vertex', row 0: has too few values; is the file "
      "truncated?");
}

TEST_F(CloudIoTest, PlyRefusesANegativeListLength) {
  const std::string elements =
      std::string("element vertex 1\nproperty list char int a\n") + kXyz;
  EXPECT_THAT(ErrorOf("a.ply",
                      Ply("binary_little_endian",
                          elements,
                          "\xff" + Little({1.0f, 2.0f, 3.0f}))),
              HasSubstr("a list has an impossible length"));
  EXPECT_THAT(ErrorOf("b.ply", Ply("ascii", elements, "-1 1 2 3\n")),
              HasSubstr("'-1' is not the length of a list"));
}

TEST_F(CloudIoTest, PlyRefusesHugeCountsAtOnce) {
  for (const std::string count :
       {"1000000000000000000", "18446744073709551615", "768614336404564651"}) {
    for (const std::string format :
         {"ascii", "binary_little_endian", "binary_big_endian"}) {
      EXPECT_THAT(
          ErrorOf(
              "a.ply",
              Ply(format, "element vertex " + count + "\n" + kXyz, "1 2 3\n")),
          HasSubstr("promises " + count + " points but holds"));
      EXPECT_THAT(
          ErrorOf(
              "a.ply",
              Ply(format,
                  "element face " + count +
                      "\nproperty list uchar int i\nelement vertex 1\n" + kXyz,
                  "1 2 3\n")),
          HasSubstr("promises " + count + " rows but holds at most"));
    }
  }
}

TEST_F(CloudIoTest, PlyRefusesBadCounts) {
  for (const std::string count :
       {"-1", "1.5", "two", "18446744073709551616", ""}) {
    EXPECT_EQ(ErrorOf("a.ply", AsciiPly(count, "1 2 3\n")),
              "line 3: is not understood: 'element vertex " + count + "'");
  }
}

TEST_F(CloudIoTest, PlyRefusesNoPoints) {
  EXPECT_EQ(ErrorOf("a.ply", AsciiPly("0", "")), "points: there are none");
}

TEST_F(CloudIoTest, PlyRefusesBadHeaders) {
  EXPECT_EQ(ErrorOf("a.ply", "plyable\n"),
            "line 1: is 'plyable', must be 'ply'");
  EXPECT_EQ(ErrorOf("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\n"),
            "header: has no end_header; is the file truncated?");
  EXPECT_EQ(ErrorOf("a.ply", "ply\nend_header\n"),
            "header: has no format line");
  EXPECT_EQ(ErrorOf("a.ply", Ply("ascii", "", "")),
            "header: has no element vertex");
  EXPECT_EQ(ErrorOf("a.ply", Ply("binary_middle_endian", "", "")),
            "line 2: is not understood: 'format binary_middle_endian 1.0'");
  EXPECT_EQ(ErrorOf("a.ply", Ply("ascii", "property float x\n", "")),
            "line 3: is not understood: 'property float x'");
  for (const std::string property : {"property half x",
                                     "property float",
                                     "property list float int x",
                                     "property list uchar x",
                                     "property float x y"}) {
    EXPECT_EQ(ErrorOf("a.ply",
                      Ply("ascii", "element vertex 1\n" + property + "\n", "")),
              "line 4: is not understood: '" + property + "'");
  }
}

TEST_F(CloudIoTest, PlyRefusesMissingAndAmbiguousCoordinates) {
  const std::string x = "property float x\n";
  const std::string y = "property float y\n";
  const std::string reason =
      ": must be there exactly once and as a single number";
  EXPECT_EQ(
      ErrorOf("a.ply", Ply("ascii", "element vertex 1\n" + x + y, "1 2\n")),
      "element 'vertex': property z" + reason);
  EXPECT_EQ(ErrorOf("a.ply",
                    Ply("ascii", "element vertex 1\n" + x + kXyz, "1 1 2 3\n")),
            "element 'vertex': property x" + reason);
  EXPECT_EQ(ErrorOf("a.ply",
                    Ply("ascii",
                        "element vertex 1\n" + x + y +
                            "property list uchar float z\n",
                        "1 2 1 3\n")),
            "element 'vertex': property z" + reason);
}

TEST_F(CloudIoTest, PlyRefusesBadRows) {
  EXPECT_EQ(ErrorOf("a.ply", AsciiPly("2", "1 2 3\n4 five 6\n")),
            "element 'vertex', row 1: 'five' is not a number");
  EXPECT_EQ(ErrorOf("a.ply", AsciiPly("1", "1 2,5 3\n")),
            "element 'vertex', row 0: '2,5' is not a number");
  EXPECT_EQ(ErrorOf("a.ply", AsciiPly("1", "1 +-2 3\n")),
            "element 'vertex', row 0: '+-2' is not a number");
  EXPECT_EQ(ErrorOf("a.ply", AsciiPly("1", "1 2 3 4\n")),
            "element 'vertex', row 0: '4' is one value too many");
  EXPECT_EQ(ErrorOf("a.ply", AsciiPly("2", "1 2 3\n4 5\n")),
            "element 'vertex', row 1: has too few values; is the file "
            "truncated?");
}

// PCD

TEST_F(CloudIoTest, PcdAscii) {
  ExpectTwoPoints(Read("a.pcd", PcdXyz("2", "ascii") + "1 2 3\n4 5 6\n"));
}

TEST_F(CloudIoTest, PcdBinary) {
  ExpectTwoPoints(Read(
      "a.pcd",
      PcdXyz("2", "binary") + Little({1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f})));
}

TEST_F(CloudIoTest, PcdBinaryMayBePadded) {
  ExpectTwoPoints(Read("a.pcd",
                       PcdXyz("2", "binary") +
                           Little({1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f}) +
                           std::string(4096, '\0')));
}

TEST_F(CloudIoTest, PcdCompressed) {
  ExpectTwoPoints(Read(
      "a.pcd", PcdXyz("2", "binary_compressed") + Compressed(kTwoByField)));
}

TEST_F(CloudIoTest, PcdCompressedAtTheBestRatioOfLzf) {
  const PointCloud cloud = Read("a.pcd",
                                PcdXyz("100000", "binary_compressed") +
                                    Compressed(std::string(1200000, '\1')));
  const float same = std::bit_cast<float>(0x01010101u);
  EXPECT_EQ(cloud.points, Points::Constant(3, 100000, same));
}

// Fields in another order, of every size, with COUNT > 1 and padding.
constexpr char kManyFields[] =
    "VERSION .6\r\nPOINTS 2\r\nTYPE I F U F U I F\r\nSIZE 1 4 2 8 1 8 4\r\n"
    "FIELDS z hist _ y label x intensity\r\nCOUNT 1 2 3 1 1 1 1\r\n"
    "WIDTH 1\r\nHEIGHT 2\r\nDATA ";

TEST_F(CloudIoTest, PcdFieldsInAnyOrderAndTypeAscii) {
  const PointCloud cloud = Read("a.pcd",
                                std::string(kManyFields) +
                                    "ascii\r\n"
                                    "3 9 9 0 0 0 2 7 1 0.25\r\n\r\n"
                                    "6 nan 9 0 0 0 5 7 4 0.75\r\n");
  ExpectTwoPoints(cloud);
  EXPECT_EQ(cloud.intensity, Eigen::Vector2f(0.25f, 0.75f));
}

TEST_F(CloudIoTest, PcdFieldsInAnyOrderAndTypeBinary) {
  const auto row = [](std::int64_t x, double y, std::int8_t z, float r) {
    return Little({z}) + Little({9.0f, kNan}) +
           Little<std::uint16_t>({1, 2, 3}) + Little({y}) +
           Little<std::uint8_t>({7}) + Little({x}) + Little({r});
  };
  const PointCloud cloud =
      Read("a.pcd",
           std::string(kManyFields) + "binary\r\n" + row(1, 2.0, 3, 0.25f) +
               row(4, 5.0, 6, 0.75f));
  ExpectTwoPoints(cloud);
  EXPECT_EQ(cloud.intensity, Eigen::Vector2f(0.25f, 0.75f));
}

TEST_F(CloudIoTest, PcdFieldsInAnyOrderAndTypeCompressed) {
  const PointCloud cloud = Read(
      "a.pcd",
      std::string(kManyFields) + "binary_compressed\r\n" +
          Compressed(Little<std::int8_t>({3, 6}) +
                     Little({9.0f, kNan, 9.0f, kNan}) +
                     Little<std::uint16_t>({1, 2, 3, 1, 2, 3}) +
                     Little({2.0, 5.0}) + Little<std::uint8_t>({7, 8}) +
                     Little<std::int64_t>({1, 4}) + Little({0.25f, 0.75f})));
  ExpectTwoPoints(cloud);
  EXPECT_EQ(cloud.intensity, Eigen::Vector2f(0.25f, 0.75f));
}

TEST_F(CloudIoTest, PcdDropsAndCountsWhatIsNotFinite) {
  const PointCloud cloud =
      Read("a.pcd", PcdXyz("3", "ascii") + "nan nan nan\n1 2 3\n1 -inf 3\n");
  EXPECT_EQ(cloud.num_dropped, 2);
  ASSERT_EQ(cloud.points.cols(), 1);
  EXPECT_EQ(cloud.points.col(0), Eigen::Vector3d(1.0, 2.0, 3.0));
}

TEST_F(CloudIoTest, PcdCountAndPointsMayBeMissing) {
  ExpectTwoPoints(Read("a.pcd",
                       "VERSION 0.6\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"
                       "WIDTH 2\nHEIGHT 1\nDATA ascii\n1 2 3\n4 5 6\n"));
}

// PcdXyz("2", data) with one replacement.
std::string PcdWith(const std::string& from,
                    const std::string& to,
                    const std::string& data = "ascii") {
  std::string header = PcdXyz("2", data);
  header.replace(header.find(from), from.size(), to);
  return header + "1 2 3\n4 5 6\n";
}

TEST_F(CloudIoTest, PcdRefusesUnknownData) {
  EXPECT_EQ(ErrorOf("a.pcd", PcdXyz("2", "binary_zipped")),
            "DATA: 'binary_zipped' is unknown");
}

TEST_F(CloudIoTest, PcdRefusesUnknownVersions) {
  EXPECT_EQ(ErrorOf("a.pcd", PcdWith("VERSION 0.7", "VERSION 0.8")),
            "VERSION: '0.8' is unknown");
}

TEST_F(CloudIoTest, PcdOfOldVersionsIsRead) {
  for (const std::string version : {"VERSION .5\n", "VERSION 0.5\n", ""}) {
    ExpectTwoPoints(Read("a.pcd", PcdWith("VERSION 0.7\n", version)));
  }
  ExpectTwoPoints(Read("a.pcd", PcdWith("FIELDS", "COLUMNS")));
  ExpectTwoPoints(Read("a.pcd", PcdWith("SIZE 4 4 4\nTYPE F F F\n", "")));
}

TEST_F(CloudIoTest, PcdTypesAndNamesMayBeInEitherCase) {
  ExpectTwoPoints(Read("a.pcd", PcdWith("TYPE F F F", "TYPE f F f")));
  ExpectTwoPoints(Read("a.pcd", PcdWith("FIELDS x y z", "FIELDS X Y Z")));
  EXPECT_EQ(ErrorOf("a.pcd", PcdWith("FIELDS x y z", "FIELDS X X Y")),
            "FIELDS: x: must be there exactly once and as a single number");
  for (const std::string type : {"i", "u"}) {
    ExpectTwoPoints(
        Read("a.pcd", PcdWith("TYPE F F F", "TYPE " + type + " F F")));
  }
}

TEST_F(CloudIoTest, PcdLowerCaseOfAnExactNameIsAnotherField) {
  const PointCloud cloud =
      Read("a.pcd",
           "FIELDS X x y z Z Intensity\nSIZE 4 4 4 4 4 4\nTYPE F F F F F F\n"
           "WIDTH 1\nHEIGHT 1\nDATA ascii\n9 1 2 3 9 0.5\n");
  EXPECT_EQ(cloud.points.col(0), Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(cloud.intensity[0], 0.5f);
}

TEST_F(CloudIoTest, PcdFieldsOfCountZeroAreNotThere) {
  const std::string header =
      "VERSION 0.7\nFIELDS x _ y z\nSIZE 4 1 4 4\nTYPE F U F F\n"
      "COUNT 1 0 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ";
  ExpectTwoPoints(Read("a.pcd", header + "ascii\n1 2 3\n4 5 6\n"));
  ExpectTwoPoints(
      Read("a.pcd",
           header + "binary\n" + Little({1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f})));
  ExpectTwoPoints(
      Read("a.pcd", header + "binary_compressed\n" + Compressed(kTwoByField)));
}

TEST_F(CloudIoTest, PcdWidthAndHeightOfZeroAreMissing) {
  for (const std::string sizes :
       {"WIDTH 0\nHEIGHT 0", "WIDTH 0\nHEIGHT 1", "WIDTH 2\nHEIGHT 0"}) {
    ExpectTwoPoints(Read("a.pcd", PcdWith("WIDTH 2\nHEIGHT 1", sizes)));
  }
  ExpectTwoPoints(Read("a.pcd", PcdWith("HEIGHT 1\n", "")));
  EXPECT_EQ(ErrorOf("a.pcd", PcdWith("WIDTH 2\nHEIGHT 1", "WIDTH 3")),
            "POINTS: 2 is not WIDTH x HEIGHT = 3 x 1");
}

TEST_F(CloudIoTest, PcdRefusesBadHeaders) {
  EXPECT_EQ(ErrorOf("a.pcd", "# .PCD\nVERSION 0.7\n"),
            "header: has no DATA line; is the file truncated?");
  EXPECT_EQ(ErrorOf("a.pcd", "1 2 3\n"),
            "line 1: '1' does not belong in a PCD header, or not twice");
  EXPECT_EQ(ErrorOf("a.pcd", PcdWith("HEIGHT 1", "WIDTH 2")),
            "line 8: 'WIDTH' does not belong in a PCD header, or not twice");
  EXPECT_EQ(ErrorOf("a.pcd", PcdWith("SIZE 4 4 4", "SIZE 4 4")),
            "FIELDS: 3 names for 2 SIZE, 3 TYPE and 3 COUNT entries");
}

TEST_F(CloudIoTest, PcdRefusesBadTypesAndSizes) {
  for (const std::string size :
       {"0", "3", "16", "-4", "99999999999999999999"}) {
    EXPECT_EQ(ErrorOf("a.pcd", PcdWith("SIZE 4 4 4", "SIZE 4 " + size + " 4")),
              "FIELDS 'y': there is no TYPE 'F' of SIZE '" + size + "'");
  }
  EXPECT_EQ(ErrorOf("a.pcd", PcdWith("TYPE F F F", "TYPE F D F")),
            "FIELDS 'y': there is no TYPE 'D' of SIZE '4'");
}

TEST_F(CloudIoTest, PcdRefusesBadCounts) {
  for (const std::string count : {"-1", "4294967295", "18446744073709551615"}) {
    EXPECT_THAT(ErrorOf("a.pcd", PcdWith("COUNT 1 1 1", "COUNT 1 1 " + count)),
                StartsWith("FIELDS 'z': COUNT '" + count + "' is not"));
  }
}

TEST_F(CloudIoTest, PcdRefusesMissingAndAmbiguousCoordinates) {
  const std::string reason =
      ": must be there exactly once and as a single number";
  EXPECT_EQ(ErrorOf("a.pcd", PcdWith("FIELDS x y z", "FIELDS x y w")),
            "FIELDS: z" + reason);
  EXPECT_EQ(ErrorOf("a.pcd", PcdWith("FIELDS x y z", "FIELDS x y y")),
            "FIELDS: y" + reason);
  EXPECT_EQ(ErrorOf("a.pcd", PcdWith("COUNT 1 1 1", "COUNT 2 1 1")),
            "FIELDS: x" + reason);
  EXPECT_EQ(ErrorOf("a.pcd", PcdWith("COUNT 1 1 1", "COUNT 1 1 0")),
            "FIELDS: z" + reason);
  EXPECT_EQ(ErrorOf("a.pcd", PcdWith("COUNT 1 1 1", "COUNT 0 0 0")),
            "FIELDS: x" + reason);
}

TEST_F(CloudIoTest, PcdRefusesFewerPointsThanPromised) {
  const std::string reason =
      "POINTS: promises 3 points but holds 2; is the file truncated?";
  EXPECT_EQ(ErrorOf("a.pcd", PcdXyz("3", "ascii") + "1 2 3\n4 5 6\n"), reason);
  EXPECT_EQ(ErrorOf("a.pcd", PcdXyz("3", "binary") + std::string(35, 'a')),
            reason);
}

TEST_F(CloudIoTest, PcdRefusesMoreLinesThanPromised) {
  EXPECT_EQ(ErrorOf("a.pcd", PcdXyz("1", "ascii") + "1 2 3\n4 5 6\n"),
            "POINTS: promises 1 points but holds 2");
}

TEST_F(CloudIoTest, PcdRefusesContradictingSizes) {
  EXPECT_EQ(ErrorOf("a.pcd", PcdWith("HEIGHT 1", "HEIGHT 2")),
            "POINTS: 2 is not WIDTH x HEIGHT = 2 x 2");
}

TEST_F(CloudIoTest, PcdRefusesHugeNumbersAtOnce) {
  for (const std::string data : {"ascii", "binary", "binary_compressed"}) {
    for (const std::string count : {"99999999999", "18446744073709551615"}) {
      const std::string bytes = PcdXyz(count, data) + Compressed(kTwoByField);
      EXPECT_THAT(ErrorOf("a.pcd", bytes), HasSubstr(count + " points"));
    }
    EXPECT_EQ(ErrorOf("a.pcd",
                      PcdWith("WIDTH 2\nHEIGHT 1",
                              "WIDTH 4294967296\nHEIGHT 4294967296",
                              data)),
              "WIDTH x HEIGHT = 4294967296 x 4294967296: is too large");
  }
}

TEST_F(CloudIoTest, PcdRefusesBadNumbersOfPoints) {
  for (const std::string name : {"WIDTH", "POINTS"}) {
    for (const std::string count : {"-2", "2.0", "18446744073709551616"}) {
      EXPECT_EQ(ErrorOf("a.pcd", PcdWith(name + " 2", name + " " + count)),
                name + ": '" + count + "' is not a number of points");
    }
  }
  EXPECT_EQ(ErrorOf("a.pcd", PcdXyz("0", "binary")), "POINTS: there are none");
}

TEST_F(CloudIoTest, PcdRefusesBadRows) {
  EXPECT_EQ(ErrorOf("a.pcd", PcdXyz("2", "ascii") + "1 2 3\n4 five 6\n"),
            "point 1: 'five' is not a number");
  EXPECT_EQ(ErrorOf("a.pcd", PcdXyz("1", "ascii") + "1 2 3 4\n"),
            "point 0: '4' is one value too many");
  EXPECT_EQ(ErrorOf("a.pcd", PcdXyz("2", "ascii") + "1 2 3\n4 5\n"),
            "point 1: has too few values; is the file truncated?");
}

TEST_F(CloudIoTest, PcdRefusesTruncatedCompressedData) {
  const std::string header = PcdXyz("2", "binary_compressed");
  const std::string body = Compressed(kTwoByField);
  for (std::size_t size = 0; size < body.size(); ++size) {
    EXPECT_THAT(ErrorOf("a.pcd", header + body.substr(0, size)),
                AllOf(StartsWith("DATA binary_compressed: "),
                      EndsWith("is the file truncated?")));
  }
}

TEST_F(CloudIoTest, PcdRefusesCompressedDataOfAnotherSize) {
  EXPECT_EQ(ErrorOf("a.pcd",
                    PcdXyz("3", "binary_compressed") + Compressed(kTwoByField)),
            "DATA binary_compressed: 24 bytes are not 3 points of 12 bytes");
  // The header is consistent, but the stream is not.
  std::string body = Compressed(kTwoByField);
  body.replace(4, 4, Little<std::uint32_t>({36}));
  EXPECT_THAT(ErrorOf("a.pcd", PcdXyz("3", "binary_compressed") + body),
              EndsWith("bytes do not decompress to 36"));
}

TEST_F(CloudIoTest, PcdRefusesAnImpossibleRatioWithoutAllocating) {
  EXPECT_EQ(ErrorOf("a.pcd",
                    PcdXyz("357913941", "binary_compressed") +
                        Little<std::uint32_t>({4, 4294967292}) + "abcd"),
            "DATA binary_compressed: 4 bytes do not decompress to 4294967292");
}

// Writing

TEST_F(CloudIoTest, PlyRoundTripIsExact) {
  for (const bool has_intensity : {false, true}) {
    PointCloud cloud = RandomCloud(1000, has_intensity);
    cloud.points.col(7) << -0.0, 5e-324, 1.7976931348623157e308;
    std::string error;
    ASSERT_TRUE(WriteCloud(cloud, PathOf("a.ply"), &error)) << error;
    const auto read = ReadCloud(PathOf("a.ply"), &error);
    ASSERT_TRUE(read.has_value()) << error;
    EXPECT_EQ(read->points, cloud.points);
    EXPECT_TRUE(std::signbit(read->points(0, 7)));
    EXPECT_EQ(read->intensity.size(), cloud.intensity.size());
    EXPECT_EQ(read->intensity, cloud.intensity);
    EXPECT_EQ(read->num_dropped, 0);
  }
}

TEST_F(CloudIoTest, BinRoundTripIsExactForFloats) {
  const PointCloud cloud = RandomCloud(1000, true);
  std::string error;
  ASSERT_TRUE(WriteCloud(cloud, PathOf("a.BIN"), &error)) << error;
  const auto read = ReadCloud(PathOf("a.BIN"), {.point_floats = 4}, &error);
  ASSERT_TRUE(read.has_value()) << error;
  EXPECT_EQ(read->points, cloud.points.cast<float>().cast<double>());
  EXPECT_EQ(read->intensity, cloud.intensity);

  ASSERT_TRUE(WriteCloud(*read, PathOf("b.bin"), &error)) << error;
  EXPECT_EQ(ReadWholeFile(PathOf("a.BIN"), &error),
            ReadWholeFile(PathOf("b.bin"), &error));
}

TEST_F(CloudIoTest, BinPointsMayHaveAnyNumberOfFloats) {
  const std::string bytes = Little({1.0f,
                                    2.0f,
                                    3.0f,
                                    0.5f,
                                    7.0f,
                                    8.0f,  //
                                    4.0f,
                                    5.0f,
                                    6.0f,
                                    0.6f,
                                    7.0f,
                                    8.0f});
  std::string error;
  const std::string path = Write("a.bin", bytes);
  const auto cloud = ReadCloud(path, {.point_floats = 6}, &error);
  ASSERT_TRUE(cloud) << error;
  ExpectTwoPoints(*cloud);
  EXPECT_EQ(cloud->intensity, Eigen::Vector2f(0.5f, 0.6f));
  EXPECT_EQ(ReadCloud(path, {.point_floats = 3}, &error)->intensity.size(), 0);
  for (const int bad : {-1, 1, 2, 65}) {
    EXPECT_FALSE(ReadCloud(path, {.point_floats = bad}, &error));
    EXPECT_THAT(error, StartsWith("point_floats = " + std::to_string(bad)));
  }
}

TEST_F(CloudIoTest, BinWithoutIntensityHasZeros) {
  std::string error;
  ASSERT_TRUE(WriteCloud(RandomCloud(3, false), PathOf("a.bin"), &error));
  const auto read = ReadCloud(PathOf("a.bin"), &error);
  ASSERT_TRUE(read.has_value()) << error;
  EXPECT_EQ(read->intensity, Eigen::Vector3f::Zero());
}

TEST_F(CloudIoTest, PcdComesBackRoundedToFloat) {
  for (const bool has_intensity : {true, false}) {
    std::string error;
    const PointCloud cloud = RandomCloud(100, has_intensity);
    ASSERT_TRUE(WriteCloud(cloud, PathOf("a.pcd"), &error)) << error;
    const auto read = ReadCloud(PathOf("a.pcd"), &error);
    ASSERT_TRUE(read.has_value()) << error;
    EXPECT_EQ(read->points, cloud.points.cast<float>().cast<double>());
    EXPECT_EQ(read->intensity, cloud.intensity);
  }
}

// A failed write leaves neither the file nor a temporary one.
class CloudIoWriteErrorTest : public CloudIoTest {
 protected:
  std::string WriteErrorOf(const PointCloud& cloud, const std::string& path) {
    const std::size_t num_files = NumFiles();
    std::string error;
    EXPECT_FALSE(WriteCloud(cloud, path, &error));
    EXPECT_THAT(error, StartsWith(path + ": "));
    EXPECT_EQ(NumFiles(), num_files);
    return error.substr(std::min(error.size(), path.size() + 2));
  }
};

TEST_F(CloudIoWriteErrorTest, UnknownEnding) {
  EXPECT_EQ(WriteErrorOf(RandomCloud(3, true), PathOf("a.las")),
            "ending '.las': must be .bin, .ply or .pcd");
  EXPECT_EQ(WriteErrorOf(RandomCloud(3, true), PathOf("a.npy")),
            "ending '.npy': must be .bin, .ply or .pcd");
  EXPECT_EQ(WriteErrorOf(RandomCloud(3, true), PathOf("a.ply.gz")),
            "ending '.ply.gz': must be .bin, .ply or .pcd");
}

TEST_F(CloudIoWriteErrorTest, MissingDirectory) {
  EXPECT_THAT(WriteErrorOf(RandomCloud(3, true), PathOf("none/a.ply")),
              HasSubstr("No such file or directory"));
}

TEST_F(CloudIoWriteErrorTest, UnwritableDirectory) {
  ASSERT_EQ(chmod(directory_.c_str(), 0555), 0);
  {
    const WithoutRoot without_root;
    EXPECT_THAT(WriteErrorOf(RandomCloud(3, true), PathOf("a.ply")),
                HasSubstr("Permission denied"));
  }
  chmod(directory_.c_str(), 0700);
}

TEST_F(CloudIoWriteErrorTest, DirectoryInTheWay) {
  std::filesystem::create_directory(PathOf("a.ply"));
  EXPECT_THAT(WriteErrorOf(RandomCloud(3, true), PathOf("a.ply")),
              HasSubstr("Is a directory"));
}

TEST_F(CloudIoWriteErrorTest, DiskFullKeepsTheOldFile) {
  const std::string old = AsciiPly("1", "1 2 3\n");
  const std::string path = Write("a.ply", old);
  rlimit previous = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &previous), 0);
  rlimit limit = previous;
  limit.rlim_cur = 1000;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  const std::string reason = WriteErrorOf(RandomCloud(1000, true), path);
  setrlimit(RLIMIT_FSIZE, &previous);
  std::signal(SIGXFSZ, handler);

  EXPECT_THAT(reason, HasSubstr("File too large"));
  std::string error;
  EXPECT_EQ(ReadWholeFile(path, &error), old);
}

TEST_F(CloudIoWriteErrorTest, WhatCouldNotBeReadBack) {
  EXPECT_EQ(WriteErrorOf(PointCloud(), PathOf("a.ply")),
            "points: there are none");
  PointCloud cloud = RandomCloud(3, true);
  cloud.points(1, 2) = 1e300;
  EXPECT_EQ(WriteErrorOf(cloud, PathOf("a.bin")),
            "point 2: is beyond the range of float32");
  cloud.points(1, 2) = kNan;
  EXPECT_EQ(WriteErrorOf(cloud, PathOf("a.ply")), "points: not all are finite");
  cloud = RandomCloud(3, true);
  cloud.intensity.conservativeResize(2);
  EXPECT_EQ(WriteErrorOf(cloud, PathOf("a.ply")),
            "intensity: 2 numbers for 3 points");
}

// Float32 has steps of 0.5 m there.
TEST_F(CloudIoWriteErrorTest, UtmCoordinatesAreNotRounded) {
  PointCloud cloud = RandomCloud(100, true);
  cloud.points.row(0).array() += 465000.0;
  cloud.points.row(1).array() += 5428000.0;
  std::string error;
  ASSERT_TRUE(WriteCloud(cloud, PathOf("a.pcd"), &error)) << error;
  const auto read = ReadCloud(PathOf("a.pcd"), &error);
  ASSERT_TRUE(read.has_value()) << error;
  EXPECT_EQ(read->points, cloud.points);
  EXPECT_EQ(read->intensity, cloud.intensity);
  cloud.points(0, 0) = 1.0;
  EXPECT_EQ(WriteErrorOf(cloud, PathOf("a.bin")),
            "point 0: float32 keeps only 0.5 m at these coordinates; write a "
            ".ply or .pcd");
  // Rounded already.
  cloud.points = cloud.points.cast<float>().cast<double>().eval();
  EXPECT_TRUE(WriteCloud(cloud, PathOf("a.bin"), &error)) << error;
}

TEST_F(CloudIoTest, ReplacesAFileAndLeavesNoOther) {
  std::string error;
  ASSERT_TRUE(WriteCloud(RandomCloud(1000, true), PathOf("a.ply"), &error));
  ASSERT_TRUE(WriteCloud(RandomCloud(3, false), PathOf("a.ply"), &error));
  const auto read = ReadCloud(PathOf("a.ply"), &error);
  ASSERT_TRUE(read.has_value()) << error;
  EXPECT_EQ(read->points.cols(), 3);
  EXPECT_EQ(NumFiles(), 1u);
}

// For arbitrary bytes, the result is a valid cloud or a one-line error.
TEST(CloudParserTest, SurvivesDamagedFiles) {
  const std::string list_elements =
      "element face 1\nproperty list uchar int i\nelement vertex 2\n"
      "property float x\nproperty list ushort short track\n"
      "property float y\nproperty float z\n";
  using Parser = std::optional<PointCloud> (*)(std::string_view, std::string*);
  const std::vector<std::pair<Parser, std::string>> samples = {
      {[](std::string_view bytes, std::string* error) {
         return ParseKittiBin(bytes, 0, error);
       },
       Little({1.0f, 2.0f, 3.0f, 0.5f, 4.0f, 5.0f, 6.0f, 0.5f})},
      {ParsePly, AsciiPly("2", "1 2 3\n4 5 6\n")},
      {ParsePly,
       Ply("ascii", list_elements, "2 1 2\n1 2 -1 -2 2 3\n4 0 5 6\n")},
      {ParsePly,
       Ply("binary_little_endian",
           list_elements,
           "\x02" + Little({7, 8}) + Little({1.0f}) +
               Little<std::uint16_t>({2}) + Little<std::int16_t>({-1, -2}) +
               Little({2.0f, 3.0f, 4.0f}) + Little<std::uint16_t>({0}) +
               Little({5.0f, 6.0f}))},
      {ParsePly,
       Ply("binary_big_endian",
           std::string("element vertex 2\n") + kXyz,
           Big({1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f}))},
      {ParsePcd, PcdXyz("2", "ascii") + "1 2 3\n4 5 6\n"},
      {ParsePcd,
       PcdXyz("2", "binary") + Little({1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f})},
      {ParsePcd, PcdXyz("2", "binary_compressed") + Compressed(kTwoByField)},
      {ParsePcd,
       std::string(kManyFields) + "ascii\n3 9 9 0 0 0 2 7 1 0\n"
                                  "6 nan 9 0 0 0 5 7 4 0\n"}};

  std::mt19937 rng(1);
  const auto draw = [&](std::size_t size) {
    return std::uniform_int_distribution<std::size_t>(0, size - 1)(rng);
  };
  int num_clouds = 0;
  int num_errors = 0;
  constexpr int kNumDraws = 1000;
  for (const auto& [parse, sample] : samples) {
    for (int i = 0; i < kNumDraws; ++i) {
      std::string bytes = sample;
      for (std::size_t n = draw(4) + 1; n > 0; --n) {
        const std::size_t at = draw(bytes.size());
        switch (draw(5)) {
          case 0:
            bytes[at] = static_cast<char>(draw(256));
            break;
          case 1:
            bytes[at] = static_cast<char>(bytes[at] ^ (1 << draw(8)));
            break;
          case 2:
            bytes[at] = "0123456789-. \n\xff"[draw(15)];
            break;
          case 3:
            bytes.insert(at, bytes.substr(draw(bytes.size()), draw(12)));
            break;
          default:
            bytes.erase(at, draw(12));
            break;
        }
        if (draw(8) == 0) bytes.resize(draw(bytes.size() + 1));
        if (bytes.empty()) bytes = sample;
      }
      std::string error;
      const auto cloud = parse(bytes, &error);
      if (cloud) {
        ++num_clouds;
        ASSERT_GT(cloud->points.cols(), 0);
        ASSERT_TRUE(cloud->points.allFinite());
        ASSERT_TRUE(cloud->intensity.size() == 0 ||
                    cloud->intensity.size() == cloud->points.cols());
      } else {
        ++num_errors;
        ASSERT_THAT(error, Not(IsEmpty()));
        ASSERT_THAT(error, Not(HasSubstr("\n")));
      }
    }
  }
  EXPECT_GT(num_clouds, 100);  // Damage must go beyond the headers.
  EXPECT_GT(num_errors, 100);
}

TEST_F(CloudIoTest, TextMayHaveAnyLineEndsBlanksAndAByteOrderMark) {
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex 2\n" +
                          std::string(kXyz) + "end_header\n1 2 3\n4 5 6\n\n";
  const std::string pcd = PcdXyz("2", "ascii") + "1 2 3\n4 5 6\n\n";
  for (const std::string end : {"\n", "\r\n", "\r", " \n", "\t\r"}) {
    for (const std::string start : {"", "\xef\xbb\xbf"}) {
      ExpectTwoPoints(Read("a.ply", start + WithEnds(end, ply)));
      ExpectTwoPoints(Read("a.pcd", start + WithEnds(end, pcd)));
    }
  }
}

// Data that begin with a line feed, or end in a carriage return.
TEST_F(CloudIoTest, BinaryDataBeginRightAfterTheHeadersLastLineEnd) {
  const float first = std::bit_cast<float>(0x3f80000au);  // Its first byte: LF.
  const float last = std::bit_cast<float>(0x0d80003fu);   // Its last byte: CR.
  const std::string data = Little({first, 2.0f, last});
  const std::string ply =
      "ply\nformat binary_little_endian 1.0\n"
      "element vertex 1\n" +
      std::string(kXyz) + "end_header\n";
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    for (const auto& [name, header] :
         {std::pair("a.ply", ply), std::pair("a.pcd", PcdXyz("1", "binary"))}) {
      const PointCloud cloud = Read(name, WithEnds(end, header) + data);
      ASSERT_EQ(cloud.points.cols(), 1);
      EXPECT_EQ(cloud.points.col(0), Eigen::Vector3d(first, 2.0, last));
    }
  }
}

TEST_F(CloudIoTest, NumbersBelowTheRangeOfDoubleAreZero) {
  const PointCloud cloud =
      Read("a.ply", AsciiPly("1", "-1.2e-400 1e-99999999999 3\n"));
  EXPECT_EQ(cloud.points.col(0), Eigen::Vector3d(0.0, 0.0, 3.0));
  EXPECT_TRUE(std::signbit(cloud.points(0, 0)));
  EXPECT_EQ(ErrorOf("a.ply", AsciiPly("1", "1 2 1e400\n")),
            "element 'vertex', row 0: '1e400' is not a number");
}

TEST_F(CloudIoTest, SaysWhatAForeignFileIs) {
  const auto error = [&](const std::string& start) {
    const std::string bytes = start + std::string(1024 - start.size(), 'a');
    const std::string reason = ErrorOf("a.ply", bytes);
    EXPECT_EQ(ErrorOf("a.bin", bytes), reason);
    EXPECT_EQ(ErrorOf("a.pcd", bytes), reason);
    return reason;
  };
  EXPECT_EQ(error("version https://git-lfs.github.com/spec/v1\n"),
            "is a pointer of Git LFS, not the data; run git lfs pull");
  EXPECT_EQ(error("<!DOCTYPE html>404"),
            "is a web page; the download failed, repeat it");
  EXPECT_EQ(error("\x1f\x8b\x08"),
            "is gzip-compressed; add .gz to its name, or run gunzip");
  EXPECT_EQ(error("\x93NUMPY"), "is a NumPy array; name it .npy");
  EXPECT_EQ(error(std::string("\xff\xfep\0l\0y\0\r\0\n\0", 12)),
            "is UTF-16 text; save it as UTF-8");
  EXPECT_THAT(ErrorOf("a.bin", AsciiPly("1", "1 2 3\n")),
              HasSubstr("is a PLY file; name it .ply"));
  EXPECT_THAT(ErrorOf("a.pcd", AsciiPly("1", "1 2 3\n")),
              HasSubstr("is a PLY file; name it .ply"));
  EXPECT_THAT(ErrorOf("a.ply", PcdXyz("1", "ascii")),
              HasSubstr("is a PCD file; name it .pcd"));
  for (const std::string line : {"1", "1.0 2.0 3.0 0.5\n"}) {
    std::string text;
    for (int i = 0; i < 1600; ++i) text += line;
    EXPECT_EQ(ErrorOf("a.bin", text),
              "is text, not the binary numbers of a .bin; name it .xyz if each "
              "line is a point");
  }
}

// Read as float32, its header would be eight points.
TEST_F(CloudIoTest, ANumPyArrayNamedBinIsNotRead) {
  std::string npy = "\x93NUMPY" + std::string("\x01\x00\x76\x00", 4) +
                    "{'descr': '<f4', 'fortran_order': False, 'shape': (99, "
                    "4), }";
  npy.resize(128, ' ');
  for (int i = 1; i <= 4 * 99; ++i) npy += Little({static_cast<float>(i)});
  EXPECT_EQ(Read("a.npy", npy).points.cols(), 99);
  EXPECT_EQ(ErrorOf("a.bin", npy), "is a NumPy array; name it .npy");
  EXPECT_EQ(ErrorOf("a.csv", npy), "is a NumPy array; name it .npy");
  EXPECT_EQ(ErrorOf("a.npy", "PK\x03\x04" + npy),
            "is a zip archive; unpack it");  // As an .npz is.
}

// Their headers and data, of a multiple of 16 bytes, would be points.
TEST_F(CloudIoTest, BinaryPlyAndPcdNamedBinAreNotRead) {
  const std::string ply = Ply(
      "binary_little_endian", std::string("element vertex 99\n") + kXyz, "");
  const std::string pcd = PcdXyz("99", "binary");
  for (const auto& [header, reason] :
       {std::pair(ply, "is a PLY file; name it .ply"),
        std::pair(pcd, "is a PCD file; name it .pcd"),
        std::pair(pcd.substr(pcd.find("VERSION")),
                  "is a PCD file; name it .pcd"),
        std::pair(std::string("\x1f\x8b\x08"),
                  "is gzip-compressed; add .gz to its name, or run gunzip")}) {
    std::string bytes = header;
    for (int i = 1; i <= 3 * 99; ++i)
      bytes += Little({0.1f * static_cast<float>(i)});
    bytes.resize(bytes.size() / 16 * 16);
    EXPECT_EQ(ErrorOf("a.bin", bytes), reason);
  }
}

TEST_F(CloudIoTest, TheEndingsOfTextAreOneFormat) {
  for (const char* name : {"a.xyz", "a.TXT", "a.csv"}) {
    ExpectTwoPoints(Read(name, "1 2 3\n4 5 6\n"));
  }
}

// Real files

class RealCloudTest : public ::testing::Test {
 protected:
  static PointCloud Read(const std::string& name) {
    std::string error;
    const auto cloud = ReadCloud(std::string(QUATRO_DATA) + "/" + name, &error);
    EXPECT_TRUE(cloud.has_value()) << error;
    return cloud.value_or(PointCloud());
  }

  static bool Has(const std::string& folder) {
    return std::filesystem::exists(std::string(QUATRO_DATA) + "/" + folder);
  }
};

TEST_F(RealCloudTest, PclRoomScanIsCompressed) {
  if (!Has("pcl_room_scan")) GTEST_SKIP() << "needs pcl_room_scan";
  const PointCloud cloud = Read("pcl_room_scan/room_scan1.pcd");
  EXPECT_EQ(cloud.points.cols() + cloud.num_dropped, 112586);
  EXPECT_LT(cloud.points.cwiseAbs().maxCoeff(), 100.0);  // [m]
}

TEST_F(RealCloudTest, SmallGicpHasIntensity) {
  if (!Has("small_gicp")) GTEST_SKIP() << "needs small_gicp";
  const PointCloud cloud = Read("small_gicp/source.ply");
  EXPECT_EQ(cloud.num_dropped, 5107);  // At the origin.
  EXPECT_EQ(cloud.points.cols() + cloud.num_dropped, 69792);
  EXPECT_EQ(cloud.intensity.size(), cloud.points.cols());
}

TEST_F(RealCloudTest, TurboRegIsDouble) {
  if (!Has("kitti_10m_turboreg")) GTEST_SKIP() << "needs kitti_10m_turboreg";
  const PointCloud cloud = Read("kitti_10m_turboreg/000_pts_src.ply");
  EXPECT_EQ(cloud.points.cols(), 24613);
  EXPECT_EQ(cloud.intensity.size(), 0);
  EXPECT_NE(cloud.points, cloud.points.cast<float>().cast<double>());
}

TEST_F(RealCloudTest, KittiBin) {
  if (!Has("kitti_00")) GTEST_SKIP() << "needs kitti_00";
  const PointCloud cloud = Read("kitti_00/000000.bin");
  EXPECT_EQ(cloud.points.cols(), 124668);
  EXPECT_EQ(cloud.num_dropped, 0);
  EXPECT_LT(cloud.points.colwise().norm().maxCoeff(), 130.0);  // [m]
  EXPECT_GE(cloud.intensity.minCoeff(), 0.0f);
  EXPECT_LE(cloud.intensity.maxCoeff(), 1.0f);
}

}  // namespace
}  // namespace quatro::cloud_io_test
