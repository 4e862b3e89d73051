// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// .npy as NumPy's save() writes it: an array of N x 3 to N x 64 little-endian
// float32 or float64, in C or Fortran order. A row is a point. Its first three
// numbers are x, y and z; if there are four or five, the fourth is the
// intensity.
//
// Source: numpy.lib.format, versions 1.0 to 3.0 of the format.

#ifndef QUATRO_FEATURES_IO_NPY_H_
#define QUATRO_FEATURES_IO_NPY_H_

#include <optional>
#include <string>
#include <string_view>

#include "features/io/point_cloud.h"

namespace quatro {

// Returns nullopt and sets *error, without a path, if `bytes` contain no such
// array, or fewer or more numbers than its header says.
std::optional<PointCloud> ParseNpy(std::string_view bytes, std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_NPY_H_
