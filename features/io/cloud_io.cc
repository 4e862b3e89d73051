// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/cloud_io.h"

#include <cstddef>
#include <exception>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "features/base/file.h"
#include "features/base/foreign_file.h"
#include "features/io/cloud_format.h"
#include "features/io/gzip.h"
#include "features/io/kitti_bin.h"
#include "features/io/npy.h"
#include "features/io/pcd.h"
#include "features/io/ply.h"
#include "features/io/point_text.h"

namespace quatro {
namespace {

constexpr std::string_view kNpyMagic = "\x93NUMPY";

// Says what the file is if its first bytes are those of another type; empty
// otherwise.
std::string OtherType(CloudFormat format, std::string_view bytes) {
  const auto is = [&](CloudFormat other, std::string_view start) {
    return format != other && bytes.starts_with(start);
  };
  if (is(CloudFormat::kNpy, kNpyMagic)) return "is a NumPy array; name it .npy";
  if (bytes.starts_with("\x1f\x8b\x08")) {
    return "is gzip-compressed; add .gz to its name, or run gunzip";
  }
  const std::string_view foreign = DescribeForeignFile(bytes);
  if (!foreign.empty() && !bytes.starts_with(kNpyMagic)) {
    return std::string(foreign);
  }
  if (is(CloudFormat::kPcd, "# .PCD") || is(CloudFormat::kPcd, "VERSION ")) {
    return "is a PCD file; name it .pcd";
  }
  if (is(CloudFormat::kPly, "ply\n") || is(CloudFormat::kPly, "ply\r")) {
    return "is a PLY file; name it .ply";
  }
  return "";
}

std::optional<PointCloud> Parse(CloudFormat format,
                                std::string_view bytes,
                                const ReadCloudOptions& options,
                                std::string* error) {
  switch (format) {
    case CloudFormat::kPly:
      return ParsePly(bytes, error);
    case CloudFormat::kPcd:
      return ParsePcd(bytes, error);
    case CloudFormat::kNpy:
      return ParseNpy(bytes, error);
    case CloudFormat::kText:
      return ParsePointText(bytes, error);
    case CloudFormat::kBin:
      break;
  }
  // A header would be read as points. Scans may begin with the two bytes of
  // UTF-16 by chance.
  const bool may_be_number =
      bytes.starts_with('\xff') || bytes.starts_with('\xfe');
  if (!may_be_number) *error = OtherType(CloudFormat::kBin, bytes);
  if (!error->empty()) return std::nullopt;
  // Lines of equal length would have columns, too.
  if (LooksLikeText(bytes)) {
    *error =
        "is text, not the binary numbers of a .bin; name it .xyz if each line "
        "is a point";
    return std::nullopt;
  }
  return ParseKittiBin(bytes, options.point_floats, error);
}

// A cloud that ReadCloud() would not read back is not written.
bool IsWritable(const PointCloud& cloud, std::string* error) {
  if (cloud.points.cols() == 0) {
    *error = "points: there are none";
    return false;
  }
  if (!cloud.points.allFinite()) {
    *error = "points: not all are finite";
    return false;
  }
  if (cloud.intensity.size() != 0 &&
      cloud.intensity.size() != cloud.points.cols()) {
    *error = "intensity: " + std::to_string(cloud.intensity.size()) +
             " numbers for " + std::to_string(cloud.points.cols()) + " points";
    return false;
  }
  return true;
}

}  // namespace

bool ReadCloudOptions::IsValid(std::string* error) const {
  constexpr int kMax = 64;
  const bool is_valid =
      point_floats == 0 || (point_floats >= 3 && point_floats <= kMax);
  *error = is_valid ? ""
                    : "point_floats = " + std::to_string(point_floats) +
                          ", must be 0 (told by the file) or in [3, 64]";
  return is_valid;
}

std::optional<PointCloud> ReadCloud(const std::string& path,
                                    std::string* error) {
  return ReadCloud(path, ReadCloudOptions(), error);
}

std::optional<PointCloud> ReadCloud(const std::string& path,
                                    const ReadCloudOptions& options,
                                    std::string* error) {
  if (!options.IsValid(error)) return std::nullopt;
  const auto type = FindCloudFileType(path);
  std::error_code ignored;
  if (!type && !std::filesystem::is_directory(path, ignored)) {
    *error = path + ": " + UnknownEnding(path, kReadableClouds);
    return std::nullopt;
  }
  std::optional<std::string> bytes = ReadWholeFile(path, error);
  if (!bytes) return std::nullopt;
  if (bytes->empty()) {
    *error = path + ": is empty";
    return std::nullopt;
  }

  std::string reason;
  std::optional<PointCloud> cloud;
  try {
    if (type->is_gzip) bytes = Gunzip(*bytes, &reason);
    if (!bytes) {
      *error = path + ": " + reason;
      return std::nullopt;
    }
    cloud = Parse(type->format, *bytes, options, &reason);
  } catch (const std::exception&) {  // The standard library's and Eigen's.
    reason = "points: do not fit in memory";
  }
  if (!cloud) {
    const std::string other = OtherType(type->format, *bytes);
    *error = path + ": " + (other.empty() ? reason : other);
  }
  return cloud;
}

std::optional<std::string> FormatCloud(const PointCloud& cloud,
                                       const std::string& path,
                                       std::string* error) {
  const auto type = FindCloudFileType(path);
  const CloudFormat format = type ? type->format : CloudFormat::kText;
  if (format == CloudFormat::kText || format == CloudFormat::kNpy ||
      type->is_gzip) {
    *error = path + ": " + UnknownEnding(path, kWritableClouds);
    return std::nullopt;
  }
  std::string reason;
  std::optional<std::string> bytes;
  if (IsWritable(cloud, &reason)) {
    bytes = format == CloudFormat::kBin   ? FormatKittiBin(cloud, &reason)
            : format == CloudFormat::kPcd ? FormatPcd(cloud)
                                          : FormatPly(cloud);
  }
  if (!bytes) *error = path + ": " + reason;
  return bytes;
}

bool WriteCloud(const PointCloud& cloud,
                const std::string& path,
                std::string* error) {
  const auto bytes = FormatCloud(cloud, path, error);
  return bytes && WriteFileAtomically(path, *bytes, error);
}

}  // namespace quatro
