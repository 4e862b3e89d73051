// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Point cloud files: KITTI .bin, PLY and PCD, told apart by their ending.
//
// A file is read whole or not at all: what is truncated, malformed or without a
// single finite point is an error in one line that names file, field and
// reason. Points with a NaN or infinite coordinate are dropped and counted.
// A file is written under another name first and then renamed, so that no
// reader ever sees half of it.

#ifndef QUATRO_FEATURES_IO_CLOUD_IO_H_
#define QUATRO_FEATURES_IO_CLOUD_IO_H_

#include <optional>
#include <string>

#include "features/io/point_cloud.h"

namespace quatro {

// Reads `.bin`, `.ply` or `.pcd`. Returns nullopt and sets *error otherwise.
std::optional<PointCloud> ReadCloud(const std::string& path,
                                    std::string* error);

// Writes `.bin` (float32 x y z intensity), `.pcd` (binary, float32 x y z) or
// `.ply` (binary little-endian, double x y z), the last two with a float
// intensity where there is one. Returns false and sets *error if it can't.
bool WriteCloud(const PointCloud& cloud,
                const std::string& path,
                std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_CLOUD_IO_H_
