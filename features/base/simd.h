// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// One function compiled for several instruction sets, chosen when the program
// starts, so that one portable build runs at each machine's width.
//
// All paths give the same bits: contraction into fused multiply-add is off for
// the whole library (third_party/target.cmake), and a loop so marked must not
// reduce floating-point numbers across lanes.
//
// Either the compiler chooses (QUATRO_SIMD_CLONES, for plain loops), or the
// caller does, by SimdLevel, for code written in features/base/lanes.h; tests
// then take each path in turn.

#ifndef QUATRO_FEATURES_BASE_SIMD_H_
#define QUATRO_FEATURES_BASE_SIMD_H_

// The sanitizers' start-up comes after the choice, which they would break. They
// pass these loops over: arithmetic on arrays of constant sizes, which they
// would slow down twentyfold.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define QUATRO_NO_SANITIZE __attribute__((no_sanitize("address", "undefined")))
#elif defined(__has_feature)  // Clang's; Eigen's, for GCC, denies everything.
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

// A part of such a function. Inlined into each of its clones.
#if defined(QUATRO_NO_SANITIZE)
#define QUATRO_SIMD_INLINE \
  inline __attribute__((always_inline)) QUATRO_NO_SANITIZE
#else
#define QUATRO_SIMD_INLINE inline __attribute__((always_inline))
#endif

// A function for one level alone, to be called only where it is supported.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__)
#define QUATRO_SIMD_AVX2 __attribute__((target("arch=x86-64-v3")))
#define QUATRO_SIMD_AVX512 __attribute__((target("arch=x86-64-v4")))
#else
#define QUATRO_SIMD_AVX2
#define QUATRO_SIMD_AVX512
#endif

namespace quatro {

// Instruction sets, each with all of those before it.
enum class SimdLevel { kBaseline, kAvx2, kAvx512 };

// What this machine and this build have.
inline SimdLevel BestSimdLevel() {
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__)
  if (__builtin_cpu_supports("x86-64-v4")) return SimdLevel::kAvx512;
  if (__builtin_cpu_supports("x86-64-v3")) return SimdLevel::kAvx2;
#endif
  return SimdLevel::kBaseline;
}

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_SIMD_H_
