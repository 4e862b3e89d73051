// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// For large vectors of numbers that start at zero and are written once: fresh
// memory from the system is zero already, and need not be written twice.

#ifndef QUATRO_FEATURES_ZEROED_ALLOCATOR_H_
#define QUATRO_FEATURES_ZEROED_ALLOCATOR_H_

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace quatro {

// Of a vector that is never made smaller.
template <typename T>
struct ZeroedAllocator {
  static_assert(std::is_arithmetic_v<T>);
  using value_type = T;

  ZeroedAllocator() = default;
  // From that of another type; there is nothing to copy.
  template <typename U>
  explicit ZeroedAllocator(const ZeroedAllocator<U>&) {}

  T* allocate(std::size_t n) {
    void* memory = std::calloc(n, sizeof(T));
    if (memory == nullptr) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }

  void construct(T*) {}  // T() is what is there.
  template <typename... Args>
  void construct(T* element, Args&&... args) {
    std::construct_at(element, std::forward<Args>(args)...);
  }

  bool operator==(const ZeroedAllocator&) const { return true; }
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_ZEROED_ALLOCATOR_H_
