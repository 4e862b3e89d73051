// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// .bin: little-endian numbers without a header. KITTI's layout, float32 x y z
// intensity, is the one that is written; see bin_layout.h for others.

#ifndef QUATRO_FEATURES_IO_KITTI_BIN_H_
#define QUATRO_FEATURES_IO_KITTI_BIN_H_

#include <optional>
#include <string>
#include <string_view>

#include "features/io/point_cloud.h"

namespace quatro {

// A point has `point_floats` numbers: x, y, z, the intensity if there are more
// than three, and others, which are skipped. If it is 0, FindBinLayout() infers
// it. Returns nullopt and sets *error, without a path, if `bytes` contain no
// cloud.
std::optional<PointCloud> ParseKittiBin(std::string_view bytes,
                                        int point_floats,
                                        std::string* error);

// Coordinates are rounded to float32. If the cloud has no intensity, zeros are
// written. Returns nullopt and sets *error if a coordinate is outside the range
// of float32 or would be rounded by more than 1 mm.
std::optional<std::string> FormatKittiBin(const PointCloud& cloud,
                                          std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_KITTI_BIN_H_
