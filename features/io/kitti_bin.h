// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// KITTI .bin: little-endian float32 x y z intensity, without a header.

#ifndef QUATRO_FEATURES_IO_KITTI_BIN_H_
#define QUATRO_FEATURES_IO_KITTI_BIN_H_

#include <optional>
#include <string>
#include <string_view>

#include "features/io/point_cloud.h"

namespace quatro {

// Returns nullopt and sets *error, without a path, if `bytes` contain no cloud.
std::optional<PointCloud> ParseKittiBin(std::string_view bytes,
                                        std::string* error);

// Coordinates are rounded to float32. If the cloud has no intensity, zeros are
// written. Returns nullopt and sets *error if a coordinate is outside the range
// of float32.
std::optional<std::string> FormatKittiBin(const PointCloud& cloud,
                                          std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_KITTI_BIN_H_
