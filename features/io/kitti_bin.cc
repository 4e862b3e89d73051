// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/kitti_bin.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

#include "features/io/cloud_fields.h"

namespace quatro {
namespace {

constexpr std::size_t kPointSize = 4 * sizeof(float);

}  // namespace

std::optional<PointCloud> ParseKittiBin(std::string_view bytes,
                                        std::string* error) {
  if (bytes.size() % kPointSize != 0) {
    *error = "size " + std::to_string(bytes.size()) +
             " bytes is not a multiple of 16 (x y z intensity as float32)";
    return std::nullopt;
  }
  CloudBuilder builder(bytes.size() / kPointSize, /*has_intensity=*/true);
  for (std::size_t start = 0; start < bytes.size(); start += kPointSize) {
    std::array<double, 4> row;
    for (std::size_t i = 0; i < row.size(); ++i) {
      row[i] = DecodeScalar(bytes.data() + start + i * sizeof(float),
                            ScalarType::kFloat32,
                            std::endian::little);
    }
    builder.Add(row);
  }
  return builder.Build(error);
}

std::optional<std::string> FormatKittiBin(const PointCloud& cloud,
                                          std::string* error) {
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(cloud.points.cols()) * kPointSize);
  for (Eigen::Index i = 0; i < cloud.points.cols(); ++i) {
    for (const double coordinate : cloud.points.col(i)) {
      const float rounded = static_cast<float>(coordinate);
      if (!std::isfinite(rounded)) {
        *error =
            "point " + std::to_string(i) + ": is beyond the range of float32";
        return std::nullopt;
      }
      AppendLittleEndian(rounded, &bytes);
    }
    AppendLittleEndian(cloud.intensity.size() == 0 ? 0.0f : cloud.intensity[i],
                       &bytes);
  }
  return bytes;
}

}  // namespace quatro
