// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// .bin: little-endian numbers without a header. KITTI's layout, which is the
// one that is written, is float32 x y z intensity; see bin_layout.h for others.

#ifndef QUATRO_FEATURES_IO_KITTI_BIN_H_
#define QUATRO_FEATURES_IO_KITTI_BIN_H_

#include <optional>
#include <string>
#include <string_view>

#include "features/io/point_cloud.h"

namespace quatro {

// A point has `point_floats` numbers, x y z and, if there are four, an
// intensity first; 0: as FindBinLayout() finds. Sets *error, without a path, if
// there is no cloud in `bytes`.
std::optional<PointCloud> ParseKittiBin(std::string_view bytes,
                                        int point_floats,
                                        std::string* error);

// Coordinates are rounded to float32. If the cloud has no intensity, zeros are
// written. Returns nullopt and sets *error if a coordinate is outside the range
// of float32.
std::optional<std::string> FormatKittiBin(const PointCloud& cloud,
                                          std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_KITTI_BIN_H_
