// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// PCD 0.5, 0.6 and 0.7: ascii, binary and binary_compressed. Variants that PCL
// reads are accepted: no VERSION, COLUMNS in place of FIELDS, TYPE in lower
// case, fields of COUNT 0, a WIDTH or HEIGHT of 0.
//
// A point is one row with fields x, y, z of any type and COUNT 1, and an
// optional intensity (see FindCloudColumns). All other fields are skipped.
// VIEWPOINT is ignored: points stay in the frame in which they were stored.

#ifndef QUATRO_FEATURES_IO_PCD_H_
#define QUATRO_FEATURES_IO_PCD_H_

#include <optional>
#include <string>
#include <string_view>

#include "features/io/point_cloud.h"

namespace quatro {

// Returns nullopt and sets *error, without a path, if `bytes` contain no cloud.
std::optional<PointCloud> ParsePcd(std::string_view bytes, std::string* error);

// Writes binary x y z and, if the cloud has one, float32 intensity. Coordinates
// are rounded to float32, unless this would change one by more than 1 mm; then
// all are written as doubles.
std::string FormatPcd(const PointCloud& cloud);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_PCD_H_
