// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// PLY, ascii or binary of either byte order.
//
// A point is one row of the element "vertex" with scalar properties x, y, z of
// any type, and an optional intensity (see FindCloudColumns). All other
// properties and elements are skipped.

#ifndef QUATRO_FEATURES_IO_PLY_H_
#define QUATRO_FEATURES_IO_PLY_H_

#include <optional>
#include <string>
#include <string_view>

#include "features/io/point_cloud.h"

namespace quatro {

// Returns nullopt and sets *error, without a path, if `bytes` contain no cloud.
std::optional<PointCloud> ParsePly(std::string_view bytes, std::string* error);

// Writes binary little-endian double x y z and, if the cloud has one, float
// intensity.
std::string FormatPly(const PointCloud& cloud);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_PLY_H_
