// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/kitti_bin.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "features/io/bin_layout.h"
#include "features/io/cloud_fields.h"

namespace quatro {
namespace {

constexpr std::size_t kPointSize = 4 * sizeof(float);

}  // namespace

std::optional<PointCloud> ParseKittiBin(std::string_view bytes,
                                        int point_floats,
                                        std::string* error) {
  const auto layout = FindBinLayout(bytes, point_floats, error);
  if (!layout) return std::nullopt;
  const std::size_t point_size = layout->PointSize();
  const bool has_intensity = layout->num_values > 3;
  CloudBuilder builder(bytes.size() / point_size, has_intensity);
  for (std::size_t start = 0; start < bytes.size(); start += point_size) {
    std::array<double, 4> row = {};
    for (std::size_t i = 0; i < (has_intensity ? 4u : 3u); ++i) {
      row[i] = DecodeScalar(bytes.data() + start + i * SizeOf(layout->type),
                            layout->type,
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
      if (!FitsFloat32(coordinate)) {
        const float next = std::nextafter(std::abs(rounded), INFINITY);
        std::array<char, 120> text;
        std::snprintf(text.data(),
                      text.size(),
                      ": float32 keeps only %.2g m at these coordinates; write "
                      "a .ply or .pcd",
                      static_cast<double>(next - std::abs(rounded)));
        *error = "point " + std::to_string(i) + text.data();
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
