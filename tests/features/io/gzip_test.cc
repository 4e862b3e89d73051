// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/gzip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "features/base/file.h"
#include "features/io/cloud_io.h"

namespace quatro::gzip_test {
namespace {

using ::testing::HasSubstr;
using std::string_view_literals::operator""sv;

// "1 2 3\n4 5 6\n", by gzip -9n.
constexpr std::string_view kTwoPoints =
    "\x1f\x8b\x08\x00\x00\x00\x00\x00\x02\x03\x33\x54\x30\x52\x30\xe6"
    "\x32\x51\x30\x55\x30\xe3\x02\x00\x02\xb4\x5b\xfb\x0c\x00\x00\x00"sv;
// Nothing, by gzip -n; and "1\n", by gzip -n | gzip -n.
constexpr std::string_view kEmpty =
    "\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03\x03\x00\x00\x00\x00\x00"
    "\x00\x00\x00\x00"sv;
constexpr std::string_view kTwice =
    "\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03\x93\xef\xe6\x60\x00\x03"
    "\x66\xe3\x27\x4c\x0c\xc1\x7f\x02\xd3\x99\x80\x7c\x00\x4b\xb7\x1a"
    "\x5f\x16\x00\x00\x00"sv;

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define QUATRO_TEST_HAS_SANITIZER
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define QUATRO_TEST_HAS_SANITIZER
#endif
#ifdef QUATRO_TEST_HAS_SANITIZER
constexpr bool kHasSanitizer = true;
#else
constexpr bool kHasSanitizer = false;
#endif

constexpr char kText[] = "1 2 3\n4 5 6\n";

bool HasZlib() {
  std::string error;
  Gunzip(kTwoPoints, &error);
  return error.find("built without zlib") == std::string::npos;
}

std::string ErrorOf(std::string_view bytes) {
  std::string error;
  EXPECT_FALSE(Gunzip(bytes, &error));
  return error;
}

TEST(Gunzip, WithoutZlibItSaysSo) {
  if (HasZlib()) GTEST_SKIP() << "built with zlib";
  EXPECT_EQ(ErrorOf(kTwoPoints),
            "is gzip-compressed, and quatro was built without zlib; run "
            "gunzip, or install zlib and build again");
}

TEST(Gunzip, MembersAreJoinedAndPaddingIsPassedOver) {
  if (!HasZlib()) GTEST_SKIP() << "needs zlib";
  std::string error;
  const std::string two = std::string(kTwoPoints) + std::string(kTwoPoints);
  EXPECT_EQ(Gunzip(kTwoPoints, &error), kText) << error;
  EXPECT_EQ(Gunzip(two, &error), std::string(kText) + kText) << error;
  EXPECT_EQ(Gunzip(two + std::string(512, '\0'), &error),
            std::string(kText) + kText)
      << error;
}

TEST(Gunzip, RefusesWhatIsCutOffDamagedOrNotGzip) {
  if (!HasZlib()) GTEST_SKIP() << "needs zlib";
  for (std::size_t size = 2; size < kTwoPoints.size(); ++size) {
    EXPECT_EQ(ErrorOf(kTwoPoints.substr(0, size)),
              "the gzip data end early; is the file truncated?");
  }
  int num_damaged = 0;
  for (std::size_t i = 10; i < kTwoPoints.size(); ++i) {
    std::string damaged(kTwoPoints);
    damaged[i] = static_cast<char>(damaged[i] ^ 0x55);
    std::string error;
    if (Gunzip(damaged, &error)) continue;
    EXPECT_THAT(error, HasSubstr("the gzip data"));
    ++num_damaged;
  }
  EXPECT_EQ(num_damaged, static_cast<int>(kTwoPoints.size()) - 10);
  EXPECT_EQ(ErrorOf("1 2 3\n"),
            "is not gzip-compressed; remove .gz from its name");
  EXPECT_EQ(ErrorOf(std::string(kTwoPoints) + "1 2 3\n"),
            "the gzip data are damaged; repeat the download");
}

TEST(Gunzip, RefusesNoDataAndDataCompressedTwice) {
  if (!HasZlib()) GTEST_SKIP() << "needs zlib";
  EXPECT_EQ(ErrorOf(kEmpty),
            "is gzip-compressed, but contains no data; compress the file "
            "again");
  EXPECT_EQ(ErrorOf(kTwice), "is gzip-compressed twice; run gunzip once");
}

// The decompressed data need 256 MB at once.
TEST(Gunzip, SaysThatMemoryIsExhausted) {
  if (!HasZlib()) GTEST_SKIP() << "needs zlib";
  if (kHasSanitizer) GTEST_SKIP() << "a sanitizer needs all addresses";
  const std::string bytes = std::string(kTwoPoints) + std::string(64 << 20, 0);
  rlimit previous = {};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &previous), 0);
  std::size_t num_pages = 0;
  std::ifstream("/proc/self/statm") >> num_pages;
  ASSERT_GT(num_pages, 0u);
  rlimit limit = previous;
  limit.rlim_cur =
      num_pages * static_cast<std::size_t>(getpagesize()) + (64 << 20);
  ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
  std::string error;
  const bool is_read = Gunzip(bytes, &error).has_value();
  setrlimit(RLIMIT_AS, &previous);
  EXPECT_FALSE(is_read);
  EXPECT_EQ(error, "the decompressed data do not fit in memory");
}

TEST(Gunzip, CloudsOfEveryFormatAreRead) {
  if (!HasZlib()) GTEST_SKIP() << "needs zlib";
  const std::string folder = ::testing::TempDir() + "gzip_test";
  std::filesystem::create_directories(folder);
  std::string error;
  for (const std::string name : {"a.xyz.gz", "a.CSV.GZ"}) {
    const std::string path = folder + "/" + name;
    ASSERT_TRUE(WriteFileAtomically(path, kTwoPoints, &error)) << error;
    const auto cloud = ReadCloud(path, &error);
    ASSERT_TRUE(cloud) << error;
    EXPECT_EQ(cloud->points.col(1), Eigen::Vector3d(4.0, 5.0, 6.0));
  }
  const std::string path = folder + "/a.ply.gz";
  ASSERT_TRUE(WriteFileAtomically(path, kTwoPoints, &error)) << error;
  EXPECT_FALSE(ReadCloud(path, &error));
  EXPECT_EQ(error, path + ": line 1: is '1 2 3', must be 'ply'");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace quatro::gzip_test
