// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Compiles one function for several instruction sets. The choice is made when
// the program starts, so one portable build uses the full register width of
// each machine.
//
// All paths give the same bits. For this, contraction into fused multiply-add
// is off for the whole library (third_party/target.cmake), and a marked loop
// must not reduce floating-point numbers across lanes.
//
// The compiler makes the choice for plain loops (QUATRO_SIMD_CLONES). The
// caller makes it, by SimdLevel, for code written with features/base/lanes.h;
// tests run every level of it.

#ifndef QUATRO_FEATURES_BASE_SIMD_H_
#define QUATRO_FEATURES_BASE_SIMD_H_

// The choice is made before the sanitizers start, which would break it. Marked
// loops are not sanitized: they are arithmetic on arrays of constant sizes, and
// sanitizers would slow them down by a factor of twenty.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define QUATRO_NO_SANITIZE __attribute__((no_sanitize("address", "undefined")))
#elif defined(__has_feature)  // Clang only; not Eigen's stub for GCC.
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define QUATRO_NO_SANITIZE __attribute__((no_sanitize("address", "undefined")))
#endif
#endif

#if defined(QUATRO_NO_SANITIZE)
#define QUATRO_SIMD_CLONES QUATRO_NO_SANITIZE
#elif defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__)
#define QUATRO_SIMD_CLONES \
  __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define QUATRO_SIMD_CLONES
#endif

// A part of a marked function, inlined into each of its clones.
#if defined(QUATRO_NO_SANITIZE)
#define QUATRO_SIMD_INLINE \
  inline __attribute__((always_inline)) QUATRO_NO_SANITIZE
#else
#define QUATRO_SIMD_INLINE inline __attribute__((always_inline))
#endif

// A function for one level. Call it only if the level is supported.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__)
#define QUATRO_SIMD_AVX2 __attribute__((target("arch=x86-64-v3")))
#define QUATRO_SIMD_AVX512 __attribute__((target("arch=x86-64-v4")))
#else
#define QUATRO_SIMD_AVX2
#define QUATRO_SIMD_AVX512
#endif

namespace quatro {

// Instruction sets. Each includes those before it.
enum class SimdLevel { kBaseline, kAvx2, kAvx512 };

// The best level that both this machine and this build support.
inline SimdLevel BestSimdLevel() {
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__)
  if (__builtin_cpu_supports("x86-64-v4")) return SimdLevel::kAvx512;
  if (__builtin_cpu_supports("x86-64-v3")) return SimdLevel::kAvx2;
#endif
  return SimdLevel::kBaseline;
}

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_SIMD_H_
