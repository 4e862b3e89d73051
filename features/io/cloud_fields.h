// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Parts shared by PLY and PCD: rows of typed numbers, some of which are the x,
// y, z and intensity of a point.

#ifndef QUATRO_FEATURES_IO_CLOUD_FIELDS_H_
#define QUATRO_FEATURES_IO_CLOUD_FIELDS_H_

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "features/io/point_cloud.h"

namespace quatro {

// The types of numbers in a file.
enum class ScalarType {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64,
};

// The size of the type in bytes.
std::size_t SizeOf(ScalarType type);

// Reads SizeOf(type) bytes, aligned or not.
double DecodeScalar(const char* bytes, ScalarType type, std::endian order);

// Appends the bytes of the number, lowest first.
void AppendLittleEndian(float value, std::string* bytes);
void AppendLittleEndian(double value, std::string* bytes);

// Whether the coordinate as float32 is finite and within 1 mm.
bool FitsFloat32(double coordinate);

// The fields of a row that are x, y, z and intensity. Only the intensity may be
// missing.
using CloudColumns = std::array<std::optional<std::size_t>, 4>;

// `names` has one entry per field, empty if the field is not a single number.
// Returns nullopt and sets *error unless there is exactly one x, y and z; if a
// lower-case name is missing, X, Y or Z is used. The intensity is the first of
// "intensity", "scalar_intensity" and "reflectance" that occurs, in upper or
// lower case.
std::optional<CloudColumns> FindCloudColumns(
    const std::vector<std::string_view>& names, std::string* error);

// Collects the rows of a file and keeps the finite points that are not zero.
class CloudBuilder {
 public:
  // Allocates `max_num_points` at once, so check this number against the size
  // of the file first.
  CloudBuilder(std::uint64_t max_num_points, bool has_intensity);

  // Adds a row x, y, z, intensity. Call this at most max_num_points times.
  void Add(const std::array<double, 4>& row);

  // Returns nullopt and sets *error if no point is left. The builder is
  // empty afterwards.
  std::optional<PointCloud> Build(std::string* error);

 private:
  bool has_intensity_;
  Eigen::Index num_points_ = 0;
  PointCloud cloud_;
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_CLOUD_FIELDS_H_
