// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The formats of point clouds, known by the ending of the file's name.

#ifndef QUATRO_FEATURES_IO_CLOUD_FORMAT_H_
#define QUATRO_FEATURES_IO_CLOUD_FORMAT_H_

#include <optional>
#include <string>

namespace quatro {

// How the points are stored.
enum class CloudFormat {
  kBin,   // .bin, see kitti_bin.h
  kPly,   // .ply
  kPcd,   // .pcd
  kNpy,   // .npy
  kText,  // .xyz, .txt and .csv, see point_text.h
};

// All endings that can be read, and those that can be written, for messages.
inline constexpr char kReadableClouds[] =
    ".bin, .ply, .pcd, .npy, .xyz, .txt or .csv, each also with .gz";
inline constexpr char kWritableClouds[] = ".bin, .ply or .pcd";

// A format, and whether the file is compressed by gzip.
struct CloudFileType {
  CloudFormat format;
  bool is_gzip = false;
};

// The type by the ending, in upper or lower case: "a.PLY" or "a.ply.gz".
// Returns nullopt if the ending is not known.
std::optional<CloudFileType> FindCloudFileType(const std::string& path);

// "ending '.las': must be .bin, ...", where `must_be` is one of the lists.
std::string UnknownEnding(const std::string& path, const char* must_be);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_CLOUD_FORMAT_H_
