// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Sixteen numbers at once, in pieces of one register each. kBytes is 16, 32 or
// 64 for SimdLevel::kBaseline, kAvx2 and kAvx512. Uses the compiler's vector
// types, because its loop vectorizer does poorly on short loops.
//
// Use this only in functions that are inlined into one marked for the level
// (features/base/simd.h): below the level, larger registers have no calling
// convention.

#ifndef QUATRO_FEATURES_BASE_LANES_H_
#define QUATRO_FEATURES_BASE_LANES_H_

#include <cstdint>

#include "features/base/simd.h"

#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__)
#include <immintrin.h>
#endif

namespace quatro {

constexpr int kLanes = 16;

// Registers of kBytes, and the number of them that hold sixteen numbers.
template <int kBytes>
struct Lanes {
  // One register of each type.
  using Float __attribute__((vector_size(kBytes), may_alias)) = float;
  using Int __attribute__((vector_size(kBytes), may_alias)) = std::int32_t;
  using Double __attribute__((vector_size(kBytes), may_alias)) = double;
  using Long __attribute__((vector_size(kBytes), may_alias)) = std::int64_t;
  static constexpr int kNumPieces = 64 / kBytes;
  static constexpr int kPieceLanes = kBytes / 4;
};

// Sixteen numbers in memory, aligned to 64 bytes.
struct alignas(64) FloatRow {
  float lane[kLanes];
};
struct alignas(64) IntRow {
  std::int32_t lane[kLanes];
};

// One register's worth of a row.
template <int kBytes>
QUATRO_SIMD_INLINE const typename Lanes<kBytes>::Float& Piece(
    const FloatRow& row, int piece) {
  return reinterpret_cast<const typename Lanes<kBytes>::Float*>(
      row.lane)[piece];
}

// One register's worth of a row.
template <int kBytes>
QUATRO_SIMD_INLINE const typename Lanes<kBytes>::Int& Piece(const IntRow& row,
                                                            int piece) {
  return reinterpret_cast<const typename Lanes<kBytes>::Int*>(row.lane)[piece];
}

// The two halves of a register, as smaller registers.
template <int kBytes>
QUATRO_SIMD_INLINE void Halve(const typename Lanes<kBytes>::Int& x,
                              typename Lanes<kBytes / 2>::Int* low,
                              typename Lanes<kBytes / 2>::Int* high) {
  if constexpr (kBytes == 64) {
    *low = __builtin_shufflevector(x, x, 0, 1, 2, 3, 4, 5, 6, 7);
    *high = __builtin_shufflevector(x, x, 8, 9, 10, 11, 12, 13, 14, 15);
  } else {
    *low = __builtin_shufflevector(x, x, 0, 1, 2, 3);
    *high = __builtin_shufflevector(x, x, 4, 5, 6, 7);
  }
}

// The bitwise or of all lanes.
template <int kBytes>
QUATRO_SIMD_INLINE std::int32_t OrOf(const typename Lanes<kBytes>::Int& x) {
  if constexpr (kBytes > 16) {
    typename Lanes<kBytes / 2>::Int low, high;
    Halve<kBytes>(x, &low, &high);
    return OrOf<kBytes / 2>(low | high);
  } else {
    typename Lanes<16>::Int y = x | __builtin_shufflevector(x, x, 2, 3, 0, 1);
    y |= __builtin_shufflevector(y, y, 1, 0, 3, 2);
    return y[0];
  }
}

// The smallest lane.
template <int kBytes>
QUATRO_SIMD_INLINE std::int32_t MinOf(const typename Lanes<kBytes>::Int& x) {
  if constexpr (kBytes > 16) {
    typename Lanes<kBytes / 2>::Int low, high;
    Halve<kBytes>(x, &low, &high);
    return MinOf<kBytes / 2>(low < high ? low : high);
  } else {
    typename Lanes<16>::Int other = __builtin_shufflevector(x, x, 2, 3, 0, 1);
    typename Lanes<16>::Int y = x < other ? x : other;
    other = __builtin_shufflevector(y, y, 1, 0, 3, 2);
    y = y < other ? y : other;
    return y[0];
  }
}

// Operations that the compiler's vectors lack and that some levels have one
// instruction for. Results are returned through pointers, because registers
// have no calling convention below their level.
template <int kBytes>
struct Instructions {
  // A register.
  using Float = typename Lanes<kBytes>::Float;

  // The elementwise maximum.
  QUATRO_SIMD_INLINE static void Max(const Float& a,
                                     const Float& b,
                                     Float* max) {
    *max = a > b ? a : b;
  }

  // *sum += a b. The level decides whether the product is rounded first. So do
  // not use it for results that must be the same at all levels.
  QUATRO_SIMD_INLINE static void AddProduct(const Float& a,
                                            const Float& b,
                                            Float* sum) {
    *sum += a * b;
  }

  // Bit k is set iff lane k is <= limit.
  QUATRO_SIMD_INLINE static std::uint32_t BitsNotAbove(const Float& x,
                                                       float limit) {
    typename Lanes<kBytes>::Int weight;
    for (int lane = 0; lane < Lanes<kBytes>::kPieceLanes; ++lane) {
      weight[lane] = 1 << lane;
    }
    return static_cast<std::uint32_t>(OrOf<kBytes>((x <= limit) & weight));
  }
};

#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__)
template <>
struct Instructions<32> {
  // A register.
  using Float = typename Lanes<32>::Float;

  QUATRO_SIMD_AVX2 static void Max(const Float& a, const Float& b, Float* max) {
    *max = _mm256_max_ps(a, b);
  }
  QUATRO_SIMD_AVX2 static void AddProduct(const Float& a,
                                          const Float& b,
                                          Float* sum) {
    *sum = _mm256_fmadd_ps(a, b, *sum);
  }
  QUATRO_SIMD_AVX2 static std::uint32_t BitsNotAbove(const Float& x,
                                                     float limit) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(
        _mm256_cmp_ps(x, _mm256_set1_ps(limit), _CMP_LE_OQ)));
  }
};

template <>
struct Instructions<64> {
  // A register.
  using Float = typename Lanes<64>::Float;

  QUATRO_SIMD_AVX512 static void Max(const Float& a,
                                     const Float& b,
                                     Float* max) {
    // Masked, because GCC 12 reports the plain intrinsic as uninitialized.
    *max = _mm512_maskz_max_ps(0xffff, a, b);
  }
  QUATRO_SIMD_AVX512 static void AddProduct(const Float& a,
                                            const Float& b,
                                            Float* sum) {
    *sum = _mm512_fmadd_ps(a, b, *sum);
  }
  QUATRO_SIMD_AVX512 static std::uint32_t BitsNotAbove(const Float& x,
                                                       float limit) {
    return _mm512_cmp_ps_mask(x, _mm512_set1_ps(limit), _CMP_LE_OQ);
  }
};
#endif

// Bit k is set iff lane k is <= limit.
template <int kBytes>
QUATRO_SIMD_INLINE std::uint32_t BitsNotAbove(
    const typename Lanes<kBytes>::Float (&x)[Lanes<kBytes>::kNumPieces],
    float limit) {
  std::uint32_t bits = 0;
  for (int piece = 0; piece < Lanes<kBytes>::kNumPieces; ++piece) {
    bits |= Instructions<kBytes>::BitsNotAbove(x[piece], limit)
            << (piece * Lanes<kBytes>::kPieceLanes);
  }
  return bits;
}

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_LANES_H_
