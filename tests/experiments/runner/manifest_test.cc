// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/runner/manifest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/run_program.h"

namespace quatro::manifest_test {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

Manifest Example() {
  Manifest manifest = BeginManifest();
  manifest.seed = std::numeric_limits<std::uint64_t>::max();
  manifest.flags = {{"preset", "kitti"}, {"methods", "quatro,\"teaser\""}};
  manifest.other_flags = {{"threads", "2"}};
  manifest.data = {12, 3, 4567, "0123456789abcdef"};
  return manifest;
}

TEST(BuildInfo, IsFilledIn) {
  const Manifest manifest = BeginManifest();
  EXPECT_THAT(manifest.build.version, MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_THAT(manifest.build.commit,
              MatchesRegex("unknown|[0-9a-f]+|[0-9a-f]+-dirty"));
  EXPECT_THAT(manifest.build.compiler,
              MatchesRegex("(gcc|clang) [0-9]+\\..*, .+"));
  EXPECT_GE(manifest.machine.cores, 1);
  EXPECT_GE(manifest.machine.memory_mib, 64);
  EXPECT_FALSE(manifest.machine.cpu.empty());
  EXPECT_THAT(manifest.start_time,
              MatchesRegex("20[0-9][0-9]-[01][0-9]-[0-3][0-9]T[0-9:]{8}Z"));
}

TEST(Manifest, ComesBack) {
  const Manifest manifest = Example();
  std::string error;
  const auto back = ParseManifest(FormatManifest(manifest), &error);
  ASSERT_TRUE(back) << error;
  EXPECT_EQ(FormatManifest(*back), FormatManifest(manifest));
  EXPECT_EQ(back->seed, manifest.seed);
  EXPECT_EQ(back->flags, manifest.flags);
  EXPECT_EQ(back->other_flags, manifest.other_flags);
  EXPECT_EQ(back->machine.memory_mib, manifest.machine.memory_mib);
  EXPECT_EQ(back->data.num_missing, 3);
  EXPECT_EQ(back->data.num_bytes, 4567u);
  EXPECT_EQ(back->data.checksum, "0123456789abcdef");
}

TEST(Manifest, TextThatIsNotUtf8DoesNotEndTheRun) {
  Manifest manifest = Example();
  manifest.flags["pairs"] = "\xff.csv";
  std::string error;
  EXPECT_TRUE(ParseManifest(FormatManifest(manifest), &error)) << error;
}

TEST(Manifest, WhatIsMissingOrOfAnotherTypeIsNamed) {
  const auto good = nlohmann::ordered_json::parse(FormatManifest(Example()));
  std::string error;
  for (const auto& [name, value] : good.items()) {
    auto bad = good;
    bad.erase(name);
    EXPECT_FALSE(ParseManifest(bad.dump(), &error)) << name;
    EXPECT_THAT(error, StartsWith(name));
    bad[name] = 1.5;
    EXPECT_FALSE(ParseManifest(bad.dump(), &error)) << name;
    EXPECT_THAT(error, StartsWith(name));
    if (!value.is_object() || name == "flags" || name == "other_flags") {
      continue;
    }
    for (const auto& [inner, unused] : value.items()) {
      bad = good;
      bad[name].erase(inner);
      EXPECT_FALSE(ParseManifest(bad.dump(), &error)) << inner;
      EXPECT_THAT(error, StartsWith(name + "." + inner + " must be "));
    }
  }
  auto bad = good;
  bad["flags"]["preset"] = 3;
  EXPECT_FALSE(ParseManifest(bad.dump(), &error));
  EXPECT_EQ(error, "flags.preset must be text");
  bad = good;
  bad["machine"]["cores"] = -1;
  EXPECT_FALSE(ParseManifest(bad.dump(), &error));
  EXPECT_EQ(error, "machine.cores must be a whole number >= 0");
  bad = good;
  bad["flags"]["pre\x7f\nset"] = 3;
  EXPECT_FALSE(ParseManifest(bad.dump(), &error));
  EXPECT_EQ(error, "flags.pre??set must be text");
  for (const char* const text : {"", "[]", "{", "3"}) {
    EXPECT_FALSE(ParseManifest(text, &error));
    EXPECT_EQ(error, "is not a JSON object");
  }
}

TEST(DecidesTheSame, LooksAtWhatDecidesAndAtNothingElse) {
  const Manifest was = Example();
  Manifest is = was;
  is.build.commit = "other";
  is.build.compiler = "other";
  is.machine = {};
  is.start_time = "later";
  is.other_flags["threads"] = "8";
  std::string difference = "old";
  EXPECT_TRUE(DecidesTheSame(was, is, &difference));
  EXPECT_EQ(difference, "");
  const auto expect = [&](const std::function<void(Manifest*)>& change,
                          const std::string& expected) {
    Manifest changed = was;
    change(&changed);
    EXPECT_FALSE(DecidesTheSame(was, changed, &difference));
    EXPECT_EQ(difference, expected);
  };
  expect([](Manifest* m) { m->flags["preset"] = "paper"; },
         "flag --preset was 'kitti', is 'paper'");
  expect([](Manifest* m) { m->flags["preset"] = "pa\nper"; },
         "flag --preset was 'kitti', is 'pa?per'");
  expect([](Manifest* m) { m->flags["ins"] = "on"; },
         "flag --ins was not set, is 'on'");
  expect([](Manifest* m) { m->flags.erase("methods"); },
         "flag --methods was 'quatro,\"teaser\"', is not set");
  expect([](Manifest* m) { m->seed = 1; },
         "seed was 18446744073709551615, is 1");
  expect([](Manifest* m) { m->data.checksum = "f"; },
         "checksum of the data was 0123456789abcdef, is f");
  expect([&](Manifest* m) { m->build.version = "9.9.9"; },
         "version was " + was.build.version + ", is 9.9.9");
}

// Noll's test vectors of 64-bit FNV-1a.
TEST(Fnv1a, IsThatOfItsAuthors) {
  EXPECT_EQ(Fnv1a(""), 0xcbf29ce484222325u);
  EXPECT_EQ(Fnv1a("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(Fnv1a("foobar"), 0x85944171f73967e8u);
}

class DataChecksumTest : public ProgramTest {
 protected:
  DataSummary Summarize(const std::string& folder,
                        const std::vector<std::string>& scans,
                        const std::vector<std::string>& lists) const {
    std::string error;
    const auto summary = SummarizeData(PathOf(folder), scans, lists, &error);
    EXPECT_TRUE(summary) << error;
    return summary.value_or(DataSummary{});
  }

  void Fill(const std::string& folder) const {
    std::filesystem::create_directories(PathOf(folder));
    Write(folder + "/a.bin", "1234");
    Write(folder + "/b.bin", "567");
    Write(folder + "/poses.txt", "1 0 0");
  }
};

TEST_F(DataChecksumTest, DependsOnNamesSizesAndLists) {
  Fill("one");
  const DataSummary summary =
      Summarize("one", {"b.bin", "a.bin", "none.bin", "a.bin"}, {"poses.txt"});
  EXPECT_EQ(summary.num_files, 4);
  EXPECT_EQ(summary.num_missing, 1);
  EXPECT_EQ(summary.num_bytes, 12u);
  EXPECT_THAT(summary.checksum, MatchesRegex("[0-9a-f]{16}"));
  const auto checksum = [&](const std::string& folder) {
    return Summarize(folder, {"a.bin", "b.bin", "none.bin"}, {"poses.txt"})
        .checksum;
  };
  EXPECT_EQ(checksum("one"), summary.checksum);
  // The data are the same in another folder.
  Fill("two");
  EXPECT_EQ(checksum("two"), summary.checksum);
  // A scan of the same size is considered equal.
  Write("two/a.bin", "4321");
  EXPECT_EQ(checksum("two"), summary.checksum);
  Write("two/a.bin", "43215");
  EXPECT_NE(checksum("two"), summary.checksum);
  // A list of the same size is not.
  Fill("two");
  Write("two/poses.txt", "1 0 1");
  EXPECT_NE(checksum("two"), summary.checksum);
  Fill("two");
  Write("two/none.bin", "");
  EXPECT_NE(checksum("two"), summary.checksum);
}

TEST_F(DataChecksumTest, AListThatIsMissingIsAnError) {
  Fill("one");
  std::string error;
  EXPECT_FALSE(SummarizeData(PathOf("one"), {}, {"none.txt"}, &error));
  EXPECT_THAT(error, HasSubstr("none.txt"));
}

class ManifestFileTest : public ProgramTest {};

TEST_F(ManifestFileTest, IsReadAndNamedIfItIsBad) {
  std::string error;
  const auto back =
      ReadManifest(Write("manifest.json", FormatManifest(Example())), &error);
  ASSERT_TRUE(back) << error;
  EXPECT_EQ(back->flags, Example().flags);
  EXPECT_FALSE(ReadManifest(Write("bad.json", "{}"), &error));
  EXPECT_THAT(error, HasSubstr("bad.json: version must be text"));
  EXPECT_FALSE(ReadManifest(PathOf("none.json"), &error));
  EXPECT_THAT(error, HasSubstr("none.json"));
}

}  // namespace
}  // namespace quatro::manifest_test
