// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/cloud_io.h"

#include <cstddef>
#include <exception>
#include <string_view>

#include "features/base/cloud_text.h"
#include "features/base/file.h"
#include "features/base/foreign_file.h"
#include "features/io/kitti_bin.h"
#include "features/io/pcd.h"
#include "features/io/ply.h"

namespace quatro {
namespace {

// The extension in lower case, with its dot. Empty if the file name has none.
std::string Ending(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  const std::size_t dot = path.find_last_of('.');
  if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) {
    return "";
  }
  std::string ending = path.substr(dot);
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending;
}

std::optional<PointCloud> Parse(std::string_view ending,
                                std::string_view bytes,
                                const ReadCloudOptions& options,
                                std::string* error) {
  if (ending == ".bin") {
    // Lines of equal length would have columns, too.
    if (LooksLikeText(bytes)) {
      *error = "is text, not the binary numbers of a .bin";
      return std::nullopt;
    }
    return ParseKittiBin(bytes, options.point_floats, error);
  }
  if (ending == ".ply") return ParsePly(bytes, error);
  return ParsePcd(bytes, error);
}

// In place of a parser's reason, if the file is no such file at all.
std::string ReasonOf(std::string_view ending,
                     std::string_view bytes,
                     const std::string& reason) {
  const std::string_view foreign = DescribeForeignFile(bytes);
  if (!foreign.empty()) return std::string(foreign);
  if (ending != ".pcd" && bytes.starts_with("# .PCD")) {
    return "is a PCD file; name it .pcd";
  }
  if (ending != ".ply" &&
      (bytes.starts_with("ply\n") || bytes.starts_with("ply\r"))) {
    return "is a PLY file; name it .ply";
  }
  return reason;
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
  const std::string ending = Ending(path);
  if (ending != ".bin" && ending != ".ply" && ending != ".pcd") {
    *error =
        path + ": ending " + Quoted(ending) + ": is not .bin, .ply or .pcd";
    return std::nullopt;
  }
  const std::optional<std::string> bytes = ReadWholeFile(path, error);
  if (!bytes) return std::nullopt;
  if (bytes->empty()) {
    *error = path + ": is empty";
    return std::nullopt;
  }

  std::string reason;
  std::optional<PointCloud> cloud;
  try {
    cloud = Parse(ending, *bytes, options, &reason);
  } catch (const std::exception&) {  // The standard library's and Eigen's.
    reason = "points: do not fit in memory";
  }
  if (!cloud) *error = path + ": " + ReasonOf(ending, *bytes, reason);
  return cloud;
}

std::optional<std::string> FormatCloud(const PointCloud& cloud,
                                       const std::string& path,
                                       std::string* error) {
  const std::string ending = Ending(path);
  if (ending != ".bin" && ending != ".ply" && ending != ".pcd") {
    *error =
        path + ": ending " + Quoted(ending) + ": is not .bin, .ply or .pcd";
    return std::nullopt;
  }
  std::string reason;
  std::optional<std::string> bytes;
  if (IsWritable(cloud, &reason)) {
    bytes = ending == ".bin"   ? FormatKittiBin(cloud, &reason)
            : ending == ".pcd" ? FormatPcd(cloud, &reason)
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
