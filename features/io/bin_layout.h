// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The number of values of a point in a .bin, which has no header. KITTI's are
// x y z intensity as float32, nuScenes' x y z intensity ring; others have 3 or
// 6 values, or doubles.
//
// If a point has c numbers, every c-th value is of one kind: x is wide, z and
// the intensity are narrow. With g = asinh, which tames far points, and pairs
// (a, b) of values whose indices are equal modulo c, the mean difference
//
//   G(c) = E |g(a) - g(b)|                                                 (1)
//
// is therefore smallest at the true c and its multiples: for any kinds a and b,
// E |a - b| >= (E |a - a'| + E |b - b'|) / 2 (energy distance). The c with the
// smallest G is chosen, except in two cases:
//
//   - A divisor of c with nearly as small a G is preferred, because points of
//     scanners whose beams alternate differ in pairs.
//   - If G(c) is not below G(1), the values have no columns: an error.
//
// Non-finite values and points at the origin, three zeros in a row, are
// ignored. If all but every k-th row of c values are zero, a point has k c
// values, the last of which are zero in all points. The values are float64 if
// they make no sense as float32: the low half of a double is either noise, of
// which two in five are beyond 8e6, or empty. Coordinates beyond 8e6 m, the
// Earth's radius and a bit, make no sense.
//
// Fewer than 64 points are float32 x y z intensity without a test of (1).
//
// Source: Szekely and Rizzo, "Energy statistics", JSPI 2013, for the
// inequality.

#ifndef QUATRO_FEATURES_IO_BIN_LAYOUT_H_
#define QUATRO_FEATURES_IO_BIN_LAYOUT_H_

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "features/io/cloud_fields.h"

namespace quatro {

// The layout of one point.
struct BinLayout {
  int num_values = 4;                      // x, y, z, then the intensity.
  ScalarType type = ScalarType::kFloat32;  // Or kFloat64.

  // [bytes]
  std::size_t PointSize() const {
    return static_cast<std::size_t>(num_values) * SizeOf(type);
  }
};

// By the criteria above; with `num_values` > 0, float32 or float64 alone is
// decided. Sets *error, without a path, if no layout makes sense, if several
// do, or if the size is no whole number of points.
std::optional<BinLayout> FindBinLayout(std::string_view bytes,
                                       int num_values,
                                       std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_BIN_LAYOUT_H_
