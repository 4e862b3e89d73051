// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "features/base/cloud_text.h"
#include "features/io/cloud_fields.h"
#include "features/io/ply_header.h"
#include "features/io/ply_rows.h"

namespace quatro {
namespace {

using Row = std::array<double, 4>;

// Property k goes to (*row)[slots[k]], if there is a slot.
using Slots = std::vector<std::optional<std::size_t>>;

template <typename Rows>
bool ReadRow(std::span<const PlyProperty> properties,
             const Slots& slots,
             Rows* rows,
             Row* row,
             std::string* reason) {
  if (!rows->BeginRow()) return false;
  for (std::size_t k = 0; k < properties.size(); ++k) {
    const PlyProperty& property = properties[k];
    std::uint64_t length = 1;
    if (property.length_type &&
        !rows->TakeLength(*property.length_type, &length, reason)) {
      return false;
    }
    if (!(slots[k] ? rows->Take(property.type, &(*row)[*slots[k]], reason)
                   : rows->Skip(property.type, length, reason))) {
      return false;
    }
  }
  return rows->EndRow(reason);
}

bool HasList(const PlyElement& element) {
  return std::any_of(element.properties.begin(),
                     element.properties.end(),
                     [](const PlyProperty& property) {
                       return property.length_type.has_value();
                     });
}

std::string TooFewRows(const PlyElement& element,
                       std::uint64_t num_held,
                       bool is_bound) {
  return "element " + Quoted(element.name) + ": promises " +
         std::to_string(element.num_rows) +
         (element.name == "vertex" ? " points" : " rows") + " but holds " +
         (is_bound ? "at most " : "") + std::to_string(num_held) +
         "; is the file truncated?";
}

// Calls use_row for each row.
template <typename Rows, typename UseRow>
bool ReadElement(const PlyElement& element,
                 const Slots& slots,
                 Rows* rows,
                 std::string* error,
                 UseRow use_row) {
  Row row = {};
  for (std::uint64_t i = 0; i < element.num_rows; ++i) {
    std::string reason;
    if (!ReadRow(element.properties, slots, rows, &row, &reason)) {
      *error = reason.empty() ? TooFewRows(element, i, /*is_bound=*/false)
                              : "element " + Quoted(element.name) + ", row " +
                                    std::to_string(i) + ": " + reason;
      return false;
    }
    use_row(row);
  }
  return true;
}

std::optional<CloudColumns> PlyColumns(const PlyElement& vertex,
                                       std::string* error) {
  std::vector<std::string_view> names;
  for (const PlyProperty& property : vertex.properties) {
    names.push_back(property.length_type ? "" : property.name);
  }
  std::optional<CloudColumns> columns = FindCloudColumns(names, error);
  if (!columns) *error = "element 'vertex': property " + *error;
  return columns;
}

template <typename Rows>
std::optional<PointCloud> ReadCloudFrom(const PlyHeader& header,
                                        Rows rows,
                                        std::string* error) {
  for (const PlyElement& element : header.elements) {
    const bool is_vertex = element.name == "vertex";
    std::optional<CloudColumns> columns;
    if (is_vertex && !(columns = PlyColumns(element, error))) {
      return std::nullopt;
    }
    if (element.properties.empty()) continue;  // Its rows have no data.

    // Checked before anything is allocated, because num_rows may be any number.
    const std::uint64_t max_num_rows = rows.MaxNumRows(element.properties);
    if (element.num_rows > max_num_rows) {
      *error = TooFewRows(element, max_num_rows, HasList(element));
      return std::nullopt;
    }
    Slots slots(element.properties.size());
    if (!is_vertex) {
      if (!ReadElement(element, slots, &rows, error, [](const Row&) {})) {
        return std::nullopt;
      }
      continue;
    }
    for (std::size_t i = 0; i < columns->size(); ++i) {
      if ((*columns)[i]) slots[*(*columns)[i]] = i;
    }
    CloudBuilder builder(element.num_rows, (*columns)[3].has_value());
    if (!ReadElement(element, slots, &rows, error, [&](const Row& row) {
          builder.Add(row);
        })) {
      return std::nullopt;
    }
    return builder.Build(error);  // Later elements are not needed.
  }
  *error = "header: has no element vertex";
  return std::nullopt;
}

}  // namespace

std::optional<PointCloud> ParsePly(std::string_view bytes, std::string* error) {
  const std::optional<PlyHeader> header = TakePlyHeader(&bytes, error);
  if (!header) return std::nullopt;
  if (header->format == "ascii") {
    return ReadCloudFrom(*header, TextPlyRows(bytes), error);
  }
  const std::endian order = header->format == "binary_big_endian"
                                ? std::endian::big
                                : std::endian::little;
  return ReadCloudFrom(*header, BinaryPlyRows(bytes, order), error);
}

std::string FormatPly(const PointCloud& cloud) {
  const bool has_intensity = cloud.intensity.size() != 0;
  const auto num_points = static_cast<std::size_t>(cloud.points.cols());
  std::string bytes =
      "ply\n"
      "format binary_little_endian 1.0\n"
      "element vertex " +
      std::to_string(num_points) +
      "\n"
      "property double x\n"
      "property double y\n"
      "property double z\n";
  if (has_intensity) bytes += "property float intensity\n";
  bytes += "end_header\n";
  bytes.reserve(bytes.size() +
                num_points * (3 * sizeof(double) + sizeof(float)));
  for (Eigen::Index i = 0; i < cloud.points.cols(); ++i) {
    for (const double coordinate : cloud.points.col(i)) {
      AppendLittleEndian(coordinate, &bytes);
    }
    if (has_intensity) AppendLittleEndian(cloud.intensity[i], &bytes);
  }
  return bytes;
}

}  // namespace quatro
