// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/base/key_numbers.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>

#include "features/base/random.h"

namespace quatro::key_numbers_test {
namespace {

TEST(KeyNumbers, AreThoseOfAMap) {
  KeyNumbers numbers;
  std::map<std::uint64_t, std::size_t> map;
  Random random(3);
  for (int k = 0; k < 20'000; ++k) {
    // Neighbors, multiples of large powers of two, and any number.
    const std::uint64_t any = random.Next();
    const std::uint64_t keys[] = {any % 8'000, any << 50, any};
    const std::uint64_t key = keys[k % 3];
    const auto known = map.find(key);
    EXPECT_EQ(numbers.Find(key),
              known == map.end() ? map.size() : known->second);
    const std::size_t number = map.emplace(key, map.size()).first->second;
    EXPECT_EQ(numbers.Add(key), number);
    EXPECT_EQ(numbers.size(), map.size());
  }
  for (const auto& [key, number] : map) EXPECT_EQ(numbers.Find(key), number);
}

TEST(KeyNumbers, HaveNoKeyAtFirst) {
  const KeyNumbers numbers;
  EXPECT_EQ(numbers.size(), 0u);
  EXPECT_EQ(numbers.Find(0), 0u);
}

}  // namespace
}  // namespace quatro::key_numbers_test
