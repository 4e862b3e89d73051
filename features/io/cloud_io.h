// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Point cloud files: KITTI .bin, PLY and PCD, distinguished by their extension.
//
// A file is read completely or not at all. A file that is truncated, malformed
// or without a single finite point is an error; its one-line message names the
// file, the field and the reason. Points with a NaN or infinite coordinate are
// dropped and counted. A file is written under a temporary name and then
// renamed, so no reader ever sees an incomplete file.

#ifndef QUATRO_FEATURES_IO_CLOUD_IO_H_
#define QUATRO_FEATURES_IO_CLOUD_IO_H_

#include <optional>
#include <string>

#include "features/io/point_cloud.h"

namespace quatro {

// Reads `.bin`, `.ply` or `.pcd`. Returns nullopt and sets *error on failure.
std::optional<PointCloud> ReadCloud(const std::string& path,
                                    std::string* error);

// Writes `.bin` (float32 x y z intensity), `.pcd` (binary, float32 x y z) or
// `.ply` (binary little-endian, double x y z). The last two get a float
// intensity if the cloud has one. Returns false and sets *error on failure.
bool WriteCloud(const PointCloud& cloud,
                const std::string& path,
                std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_CLOUD_IO_H_
