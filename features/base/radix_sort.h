// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A stable radix sort in ascending order of keys: 11 bits at a time from the
// lowest up, in time proportional to the number of items times the number of
// bits.

#ifndef QUATRO_FEATURES_BASE_RADIX_SORT_H_
#define QUATRO_FEATURES_BASE_RADIX_SORT_H_

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "features/base/zeroed_allocator.h"

namespace quatro {

// An index and the key that it is sorted by.
struct KeyedIndex {
  std::uint64_t key;
  std::int32_t index;
};

// Sorts *keyed. Keys must be below 2^num_bits.
inline void RadixSort(int num_bits, ZeroedVector<KeyedIndex>* keyed) {
  constexpr int kDigitBits = 11;
  constexpr std::uint64_t kMask = (1 << kDigitBits) - 1;
  ZeroedVector<KeyedIndex> sorted(keyed->size());
  for (int shift = 0; shift < num_bits; shift += kDigitBits) {
    std::array<std::size_t, kMask + 1> begin{};
    for (const KeyedIndex& item : *keyed) ++begin[item.key >> shift & kMask];
    std::size_t sum = 0;
    for (std::size_t& at : begin) {
      const std::size_t count = at;
      at = sum;
      sum += count;
    }
    for (const KeyedIndex& item : *keyed) {
      sorted[begin[item.key >> shift & kMask]++] = item;
    }
    keyed->swap(sorted);
  }
}

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_RADIX_SORT_H_
