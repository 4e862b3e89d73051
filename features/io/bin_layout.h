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
// they make no sense as float32: the low half of a double, read as float32, is
// either noise, two in five times beyond 8e6, or zero. Coordinates beyond 8e6
// m, slightly more than the Earth's radius, make no sense.
//
// A file of fewer than 64 points is read as float32 x y z intensity. It is an
// error if its size allows 3, 5 or 6 values with a smaller G, unless the
// intensity is constant.
//
// Integers read as float32 are tiny. It is an error if most values that are not
// zero are below 1e-30.
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

// Infers the layout by the criteria above. If `num_values` > 0, infers only
// whether it is float32 or float64. Returns nullopt and sets *error, without a
// path, if no layout makes sense, if points seem to have more than 6 values, or
// if the size is not a whole number of points.
std::optional<BinLayout> FindBinLayout(std::string_view bytes,
                                       int num_values,
                                       std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_BIN_LAYOUT_H_
