// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What PLY and PCD have in common: rows of typed numbers, some of which are
// the x, y, z and intensity of a point.

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

// The types a number of a file can have.
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

// [bytes]
std::size_t SizeOf(ScalarType type);

// Reads SizeOf(type) bytes, aligned or not.
double DecodeScalar(const char* bytes, ScalarType type, std::endian order);

// Writes the number's bytes, the lowest first.
void AppendLittleEndian(float value, std::string* bytes);
void AppendLittleEndian(double value, std::string* bytes);

// Which fields of a row are x, y, z and intensity. Only the last may be absent.
using CloudColumns = std::array<std::optional<std::size_t>, 4>;

// `names` has one entry a field, empty where the field is not a single number.
// Sets *error if there is not exactly one x, y and z. The first of
// "intensity", "scalar_intensity", "scalar_Intensity" and "reflectance" that
// occurs is the intensity.
std::optional<CloudColumns> FindCloudColumns(
    const std::vector<std::string_view>& names, std::string* error);

// Collects rows, of which it keeps the finite ones.
class CloudBuilder {
 public:
  // `max_num_points` are allocated at once: callers hold it against the size
  // of the file first.
  CloudBuilder(std::uint64_t max_num_points, bool has_intensity);

  // At most max_num_points times. `row` is x, y, z, intensity.
  void Add(const std::array<double, 4>& row);

  // Sets *error if no point is left. The builder is empty afterwards.
  std::optional<PointCloud> Build(std::string* error);

 private:
  bool has_intensity_;
  Eigen::Index num_points_ = 0;
  PointCloud cloud_;
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_CLOUD_FIELDS_H_
