// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/cloud_fields.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace quatro {
namespace {

template <typename T>
double DecodeAs(const char* bytes, std::endian order) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, raw.size());
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(std::bit_cast<T>(raw));
}

template <typename T>
void Append(T value, std::string* bytes) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (std::endian::native != std::endian::little) {
    std::reverse(raw.begin(), raw.end());
  }
  bytes->append(raw.data(), raw.size());
}

// Whether the names are equal, regardless of the case of ASCII letters.
bool EqualInAnyCase(std::string_view a, std::string_view b) {
  const auto lower = [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  };
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [&](char c, char d) {
        return lower(c) == lower(d);
      });
}

}  // namespace

std::size_t SizeOf(ScalarType type) {
  switch (type) {
    case ScalarType::kInt8:
    case ScalarType::kUint8:
      return 1;
    case ScalarType::kInt16:
    case ScalarType::kUint16:
      return 2;
    case ScalarType::kInt32:
    case ScalarType::kUint32:
    case ScalarType::kFloat32:
      return 4;
    case ScalarType::kInt64:
    case ScalarType::kUint64:
    case ScalarType::kFloat64:
      break;
  }
  return 8;
}

double DecodeScalar(const char* bytes, ScalarType type, std::endian order) {
  switch (type) {
    case ScalarType::kInt8:
      return DecodeAs<std::int8_t>(bytes, order);
    case ScalarType::kUint8:
      return DecodeAs<std::uint8_t>(bytes, order);
    case ScalarType::kInt16:
      return DecodeAs<std::int16_t>(bytes, order);
    case ScalarType::kUint16:
      return DecodeAs<std::uint16_t>(bytes, order);
    case ScalarType::kInt32:
      return DecodeAs<std::int32_t>(bytes, order);
    case ScalarType::kUint32:
      return DecodeAs<std::uint32_t>(bytes, order);
    case ScalarType::kInt64:
      return DecodeAs<std::int64_t>(bytes, order);
    case ScalarType::kUint64:
      return DecodeAs<std::uint64_t>(bytes, order);
    case ScalarType::kFloat32:
      return DecodeAs<float>(bytes, order);
    case ScalarType::kFloat64:
      break;
  }
  return DecodeAs<double>(bytes, order);
}

void AppendLittleEndian(float value, std::string* bytes) {
  Append(value, bytes);
}

void AppendLittleEndian(double value, std::string* bytes) {
  Append(value, bytes);
}

bool FitsFloat32(double coordinate) {
  constexpr double kMaxRounding = 1e-3;  // [m]
  return std::abs(static_cast<float>(coordinate) - coordinate) <= kMaxRounding;
}

std::optional<CloudColumns> FindCloudColumns(
    const std::vector<std::string_view>& names, std::string* error) {
  const auto find = [&](std::string_view name) -> std::optional<std::size_t> {
    auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      found = std::find_if(names.begin(), names.end(), [&](auto other) {
        return EqualInAnyCase(other, name);
      });
    }
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
  };

  CloudColumns columns;
  constexpr std::array<std::string_view, 3> kCoordinates = {"x", "y", "z"};
  for (std::size_t i = 0; i < kCoordinates.size(); ++i) {
    columns[i] = find(kCoordinates[i]);
    if (!columns[i] ||
        std::count(names.begin(), names.end(), names[*columns[i]]) != 1) {
      *error = std::string(kCoordinates[i]) +
               ": must be there exactly once and as a single number";
      return std::nullopt;
    }
  }
  for (const char* name : {"intensity", "scalar_intensity", "reflectance"}) {
    if (!columns[3]) columns[3] = find(name);
  }
  return columns;
}

CloudBuilder::CloudBuilder(std::uint64_t max_num_points, bool has_intensity)
    : has_intensity_(has_intensity) {
  const auto num_points = static_cast<Eigen::Index>(max_num_points);
  cloud_.points.resize(3, num_points);
  if (has_intensity_) cloud_.intensity.resize(num_points);
}

void CloudBuilder::Add(const std::array<double, 4>& row) {
  const auto [x, y, z, intensity] = row;
  const bool is_zero = x == 0.0 && y == 0.0 && z == 0.0;
  if (is_zero || !std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
    ++cloud_.num_dropped;
    return;
  }
  cloud_.points.col(num_points_) << x, y, z;
  if (has_intensity_) {
    cloud_.intensity[num_points_] = static_cast<float>(intensity);
  }
  ++num_points_;
}

std::optional<PointCloud> CloudBuilder::Build(std::string* error) {
  PointCloud cloud = std::exchange(cloud_, PointCloud());
  const Eigen::Index num_points = std::exchange(num_points_, 0);
  if (num_points == 0) {
    *error = cloud.num_dropped == 0
                 ? "points: there are none"
                 : "points: none of " + std::to_string(cloud.num_dropped) +
                       " is finite and not zero";
    return std::nullopt;
  }
  cloud.points.conservativeResize(3, num_points);
  if (has_intensity_) cloud.intensity.conservativeResize(num_points);
  return cloud;
}

}  // namespace quatro
