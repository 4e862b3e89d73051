// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Counter-based random numbers. The k-th draw of a seed is a pure function of
// seed and k, so results depend neither on threads, nor on order, nor on the
// standard library.
//
// Source: Steele, Lea and Flood, "Fast Splittable Pseudorandom Number
// Generators", OOPSLA 2014 (SplitMix64).

#ifndef QUATRO_FEATURES_BASE_RANDOM_H_
#define QUATRO_FEATURES_BASE_RANDOM_H_

#include <cmath>
#include <cstdint>

namespace quatro {

// One step of SplitMix64: scrambles 64 bits.
inline std::uint64_t Mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// The sequence of random numbers of a seed.
class Random {
 public:
  // Equal seeds give equal numbers.
  explicit Random(std::uint64_t seed) : state_(Mix(seed)) {}

  // The next 64 bits.
  std::uint64_t Next() { return Mix(state_++); }

  // Skips this many draws.
  void Skip(std::uint64_t num_draws) { state_ += num_draws; }

  // Uniform in [0, n), n >= 1. The bias is below n / 2^64.
  std::uint64_t Below(std::uint64_t n) {
    __extension__ using Wide = unsigned __int128;
    return static_cast<std::uint64_t>((static_cast<Wide>(Next()) * n) >> 64);
  }

  // Uniform in [0, 1).
  double Uniform() { return static_cast<double>(Next() >> 11) * 0x1p-53; }

  // Standard normal, by the method of Box and Muller from two uniform draws.
  double Normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
    return radius * std::cos(2.0 * M_PI * Uniform());
  }

 private:
  std::uint64_t state_;
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_RANDOM_H_
