// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// For large vectors of numbers that start at zero and are written once: fresh
// memory from the system is zero already, and need not be written twice.
//
// What fills huge pages of 2 MiB, the last by three quarters, is asked for in
// such pages where the system has them. The first write to a page is a fault,
// which for one of 4 KiB takes longer than to write it; and rows that lie far
// apart stay within reach of the processor's table of pages.

#ifndef QUATRO_FEATURES_BASE_ZEROED_ALLOCATOR_H_
#define QUATRO_FEATURES_BASE_ZEROED_ALLOCATOR_H_

#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace quatro {

// Throws std::bad_alloc. `alignment` of no more than a page.
void* AllocateZeroed(std::size_t num_bytes, std::size_t alignment);

// Of as many bytes as were allocated.
void FreeZeroed(void* memory, std::size_t num_bytes) noexcept;

// Of a vector that is never made smaller, of what is T() if all of its bytes
// are zero.
template <typename T>
struct ZeroedAllocator {
  static_assert(std::is_trivially_copyable_v<T>);
  using value_type = T;

  ZeroedAllocator() = default;
  // From that of another type; there is nothing to copy.
  template <typename U>
  explicit ZeroedAllocator(const ZeroedAllocator<U>&) {}

  T* allocate(std::size_t n) {
    if (n > std::numeric_limits<std::size_t>::max() / sizeof(T)) {
      throw std::bad_array_new_length();
    }
    return static_cast<T*>(AllocateZeroed(n * sizeof(T), alignof(T)));
  }
  void deallocate(T* memory, std::size_t n) noexcept {
    FreeZeroed(memory, n * sizeof(T));
  }

  void construct(T*) {}  // T() is what is there.
  template <typename... Args>
  void construct(T* element, Args&&... args) {
    std::construct_at(element, std::forward<Args>(args)...);
  }

  bool operator==(const ZeroedAllocator&) const { return true; }
};

// Starts at T().
template <typename T>
using ZeroedVector = std::vector<T, ZeroedAllocator<T>>;

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_ZEROED_ALLOCATOR_H_
