// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Point cloud files: .bin without a header, PLY, PCD, .npy and text,
// distinguished by the ending of their name (cloud_format.h). Any of them may
// be compressed by gzip.
//
// A file is read completely or not at all. A file that is truncated, malformed
// or without a single finite point is an error; its one-line message names the
// file, the field and the reason. Points with a NaN or infinite coordinate and
// points at the origin, which scanners write for beams without a return, are
// dropped and counted. A file is written under a temporary name and then
// renamed, so no reader ever sees an incomplete file.

#ifndef QUATRO_FEATURES_IO_CLOUD_IO_H_
#define QUATRO_FEATURES_IO_CLOUD_IO_H_

#include <optional>
#include <string>

#include "features/io/point_cloud.h"

namespace quatro {

// How files without a header are read.
struct ReadCloudOptions {
  // The number of values of a point of a .bin, 3 to 64: x, y, z, the intensity,
  // and others, which are skipped. 0: inferred from the values (bin_layout.h).
  int point_floats = 0;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Reads one of kReadableClouds. Returns nullopt and sets *error if that fails.
std::optional<PointCloud> ReadCloud(const std::string& path,
                                    const ReadCloudOptions& options,
                                    std::string* error);

// Reads with default options.
std::optional<PointCloud> ReadCloud(const std::string& path,
                                    std::string* error);

// Writes `.bin` (float32 x y z intensity), `.pcd` (binary, float32 x y z, or
// double if float32 would lose more than 1 mm) or `.ply` (binary little-endian,
// double x y z), the last two with a float intensity if the cloud has one.
// Returns false and sets *error if that fails, or if a .bin would lose more
// than 1 mm.
// A .bin whose intensities vary as much as its coordinates can be read again
// only with point_floats = 4.
bool WriteCloud(const PointCloud& cloud,
                const std::string& path,
                std::string* error);

// The bytes that WriteCloud() would write. Returns nullopt and sets *error if
// it could not write them.
std::optional<std::string> FormatCloud(const PointCloud& cloud,
                                       const std::string& path,
                                       std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_CLOUD_IO_H_
