// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// PCD 0.6 and 0.7: ascii, binary and binary_compressed.
//
// A point is one row with fields x, y, z of any type and COUNT 1, and
// optionally an intensity (see FindCloudColumns). All other fields are skipped.
// VIEWPOINT is ignored: points stay in the frame in which they were stored.

#ifndef QUATRO_FEATURES_IO_PCD_H_
#define QUATRO_FEATURES_IO_PCD_H_

#include <optional>
#include <string>
#include <string_view>

#include "features/io/point_cloud.h"

namespace quatro {

// Sets *error, without a path, if there is no cloud in `bytes`.
std::optional<PointCloud> ParsePcd(std::string_view bytes, std::string* error);

// Binary, float32 x y z and, where there is one, intensity: coordinates are
// rounded. Sets *error if one is beyond the range of float32.
std::optional<std::string> FormatPcd(const PointCloud& cloud,
                                     std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_PCD_H_
