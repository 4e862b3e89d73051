// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Numbers keys 0, 1, 2, ... in the order in which they first appear: a hash
// table with linear probing, at most half full.

#ifndef QUATRO_FEATURES_BASE_KEY_NUMBERS_H_
#define QUATRO_FEATURES_BASE_KEY_NUMBERS_H_

#include <cstddef>
#include <cstdint>
#include <vector>

#include "features/base/random.h"

namespace quatro {

// Keys are any numbers.
class KeyNumbers {
 public:
  // How many keys have appeared.
  std::size_t size() const { return size_; }

  // The number of `key`, which is size() before the call if the key is new.
  std::size_t Add(std::uint64_t key) {
    if (2 * size_ >= slots_.size()) Grow();
    Slot& slot = slots_[SlotOf(key)];
    if (slot.number_plus_one == 0) {
      slot = {key, static_cast<std::uint32_t>(++size_)};
    }
    return slot.number_plus_one - 1;
  }

  // The number of `key`, or size() if it has not appeared.
  std::size_t Find(std::uint64_t key) const {
    const std::uint32_t found = slots_[SlotOf(key)].number_plus_one;
    return found == 0 ? size_ : found - 1;
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t number_plus_one = 0;  // Zero in a free slot.
  };

  // The slot of the key, or the free one for it.
  std::size_t SlotOf(std::uint64_t key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = Mix(key) & mask;
    while (slots_[at].number_plus_one != 0 && slots_[at].key != key) {
      at = (at + 1) & mask;
    }
    return at;
  }

  void Grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.number_plus_one != 0) slots_[SlotOf(slot.key)] = slot;
    }
  }

  std::vector<Slot> slots_ = std::vector<Slot>(1 << 10);
  std::size_t size_ = 0;
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_KEY_NUMBERS_H_
