// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/base/zeroed_allocator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>
#include <vector>

namespace quatro::zeroed_allocator_test {
namespace {

using Zeros = ZeroedVector<std::uint64_t>;

TEST(ZeroedAllocator, IsZeroAndCanBeWrittenAtAnySize) {
  constexpr std::size_t kHugePage = (std::size_t{1} << 21) / 8;
  // The second allocation may get the memory of the first.
  for (int round = 0; round < 2; ++round) {
    for (const std::size_t size : {std::size_t{1},
                                   std::size_t{1000},
                                   kHugePage - 1,
                                   kHugePage,
                                   kHugePage + 1,
                                   3 * kHugePage + 17}) {
      Zeros numbers(size);
      ASSERT_TRUE(std::ranges::all_of(numbers, [](auto x) { return x == 0; }))
          << size;
      std::ranges::fill(numbers, ~std::uint64_t{0});
      const Zeros copy = numbers;
      ASSERT_EQ(copy, numbers);
    }
  }
}

TEST(ZeroedAllocator, IsAligned) {
  struct alignas(64) Row {
    float x[16] = {};
  };
  for (const std::size_t size : {1u, 7u, 100000u}) {
    const ZeroedVector<Row> rows(size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(rows.data()) % 64, 0u) << size;
    EXPECT_EQ(rows.back().x[15], 0.0f);
  }
}

TEST(ZeroedAllocator, WhatDoesNotFitIsBadAlloc) {
  constexpr std::size_t kLargest = std::numeric_limits<std::size_t>::max();
  for (const std::size_t num : {kLargest, kLargest / 8, kLargest / 17}) {
    EXPECT_THROW(ZeroedAllocator<std::uint64_t>().allocate(num),
                 std::bad_alloc);
  }
}

}  // namespace
}  // namespace quatro::zeroed_allocator_test
