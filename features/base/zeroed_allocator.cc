// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/base/zeroed_allocator.h"

#include <cstdlib>
#include <cstring>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace quatro {
namespace {

#if defined(__linux__)
constexpr std::size_t kHugePage = std::size_t{1} << 21;

// The part of `num_bytes` to put into huge pages. The last of them is at least
// three quarters full.
std::size_t BytesInHugePages(std::size_t num_bytes) {
  return (num_bytes + kHugePage / 4) / kHugePage * kHugePage;
}

// Rounds up to whole huge pages. Linux 6.7 and later align mappings of such
// sizes to huge pages.
std::size_t InWholePages(std::size_t num_bytes) {
  return (num_bytes + kHugePage - 1) / kHugePage * kHugePage;
}
#endif

}  // namespace

void* AllocateZeroed(std::size_t num_bytes, std::size_t alignment) {
  // Keeps the rounding up below from overflowing.
  constexpr std::size_t kLargest = std::numeric_limits<std::size_t>::max() / 2;
  if (num_bytes > kLargest) throw std::bad_alloc();
#if defined(__linux__)
  if (const std::size_t huge = BytesInHugePages(num_bytes); huge > 0) {
    void* memory = mmap(nullptr,
                        InWholePages(num_bytes),
                        PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS,
                        -1,
                        0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    madvise(memory, huge, MADV_HUGEPAGE);  // Only advice; failure is harmless.
    return memory;
  }
#endif
  if (alignment <= alignof(std::max_align_t)) {
    void* memory = std::calloc(1, num_bytes);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
  }
  const std::size_t size = (num_bytes + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, size);
  if (memory == nullptr) throw std::bad_alloc();
  return std::memset(memory, 0, size);
}

void FreeZeroed(void* memory, std::size_t num_bytes) noexcept {
#if defined(__linux__)
  if (BytesInHugePages(num_bytes) > 0) {
    munmap(memory, InWholePages(num_bytes));
    return;
  }
#endif
  std::free(memory);
}

}  // namespace quatro
