// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// An allocator for large vectors of numbers that start at zero and are written
// once. Fresh memory from the system is already zero, so it is not cleared
// again.
//
// Memory of at least 1.5 MiB is requested in huge pages of 2 MiB if the system
// has them, except for a last page that is less than three quarters full. The
// first write to a page causes a page fault, which takes longer than writing a
// page of 4 KiB. Huge pages also keep rows that lie far apart within reach of
// the processor's TLB.

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

// Returns memory that is zero. Throws std::bad_alloc. `alignment` is at most a
// page.
void* AllocateZeroed(std::size_t num_bytes, std::size_t alignment);

// Frees memory of AllocateZeroed(). `num_bytes` is the number that was
// allocated.
void FreeZeroed(void* memory, std::size_t num_bytes) noexcept;

// For vectors that never shrink, of types T for which all bytes zero is T().
template <typename T>
struct ZeroedAllocator {
  static_assert(std::is_trivially_copyable_v<T>);
  using value_type = T;

  ZeroedAllocator() = default;
  // Converts from the allocator of another type. There is no state to copy.
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

  void construct(T*) {}  // The memory already holds T().
  template <typename... Args>
  void construct(T* element, Args&&... args) {
    std::construct_at(element, std::forward<Args>(args)...);
  }

  bool operator==(const ZeroedAllocator&) const { return true; }
};

// A vector whose elements start as T().
template <typename T>
using ZeroedVector = std::vector<T, ZeroedAllocator<T>>;

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_ZEROED_ALLOCATOR_H_
