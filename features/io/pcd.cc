// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/pcd.h"

#include <lzf.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "features/base/cloud_text.h"
#include "features/io/cloud_fields.h"
#include "features/io/pcd_header.h"

namespace quatro {
namespace {

std::string WrongNumPoints(const PcdHeader& header, std::uint64_t num_held) {
  return "POINTS: promises " + std::to_string(header.num_points) +
         " points but holds " + std::to_string(num_held) +
         (num_held < header.num_points ? "; is the file truncated?" : "");
}

std::optional<CloudColumns> PcdColumns(const PcdHeader& header,
                                       std::string* error) {
  std::vector<std::string_view> names;
  for (const PcdField& field : header.fields) {
    names.push_back(field.count == 1 ? field.name : "");
  }
  std::optional<CloudColumns> columns = FindCloudColumns(names, error);
  if (!columns) *error = "FIELDS: " + *error;
  return columns;
}

// Parses one line of an ascii file. Returns false and sets *reason if it is
// malformed.
bool ParseRow(std::string_view line,
              const std::vector<std::optional<std::size_t>>& slots,
              const PcdHeader& header,
              std::array<double, 4>* row,
              std::string* reason) {
  for (std::size_t k = 0; k < header.fields.size(); ++k) {
    for (std::uint64_t i = 0; i < header.fields[k].count; ++i) {
      const std::string_view word = TakeWord(&line);
      if (word.empty()) {
        *reason = "has too few values; is the file truncated?";
        return false;
      }
      if (!slots[k]) continue;
      const std::optional<double> number = ParseNumber(word);
      if (!number) {
        *reason = Quoted(word) + " is not a number";
        return false;
      }
      (*row)[*slots[k]] = *number;
    }
  }
  const std::string_view word = TakeWord(&line);
  if (!word.empty()) *reason = Quoted(word) + " is one value too many";
  return word.empty();
}

std::optional<PointCloud> ReadAscii(const PcdHeader& header,
                                    const CloudColumns& columns,
                                    std::string_view text,
                                    std::string* error) {
  const std::uint64_t num_lines = CountLines(text);
  if (header.num_points != num_lines) {
    *error = WrongNumPoints(header, num_lines);
    return std::nullopt;
  }

  std::vector<std::optional<std::size_t>> slots(header.fields.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i]) slots[*columns[i]] = i;
  }
  CloudBuilder builder(header.num_points, columns[3].has_value());
  for (std::uint64_t i = 0; i < header.num_points;) {
    const std::string_view line = TakeLine(&text);
    std::string_view words = line;
    if (TakeWord(&words).empty()) continue;
    std::array<double, 4> row = {};
    std::string reason;
    if (!ParseRow(line, slots, header, &row, &reason)) {
      *error = "point " + std::to_string(i) + ": " + reason;
      return std::nullopt;
    }
    builder.Add(row);
    ++i;
  }
  return builder.Build(error);
}

// `bytes` has all header.num_points points, either row by row or field by field
// (all x before all y).
std::optional<PointCloud> ReadBinary(const PcdHeader& header,
                                     const CloudColumns& columns,
                                     std::string_view bytes,
                                     bool is_field_by_field,
                                     std::string* error) {
  CloudBuilder builder(header.num_points, columns[3].has_value());
  for (std::uint64_t i = 0; i < header.num_points; ++i) {
    std::array<double, 4> row = {};
    for (std::size_t j = 0; j < columns.size(); ++j) {
      if (!columns[j]) continue;
      const PcdField& field = header.fields[*columns[j]];
      const std::uint64_t start =
          is_field_by_field
              ? header.num_points * field.offset + i * SizeOf(field.type)
              : i * header.row_size + field.offset;
      row[j] =
          DecodeScalar(bytes.data() + start, field.type, std::endian::little);
    }
    builder.Add(row);
  }
  return builder.Build(error);
}

std::uint64_t DecodeSize(std::string_view bytes, std::size_t start) {
  return static_cast<std::uint64_t>(DecodeScalar(
      bytes.data() + start, ScalarType::kUint32, std::endian::little));
}

// `bytes` are the compressed size, the decompressed size and the compressed
// data.
std::optional<std::string> Decompress(const PcdHeader& header,
                                      std::string_view bytes,
                                      std::string* error) {
  const std::string place = "DATA binary_compressed: ";
  constexpr std::size_t kSizes = 2 * sizeof(std::uint32_t);
  if (bytes.size() < kSizes) {
    *error = place + "has no sizes; is the file truncated?";
    return std::nullopt;
  }
  const std::uint64_t compressed_size = DecodeSize(bytes, 0);
  const std::uint64_t size = DecodeSize(bytes, sizeof(std::uint32_t));
  bytes.remove_prefix(kSizes);
  if (compressed_size > bytes.size()) {
    *error = place + "promises " + std::to_string(compressed_size) +
             " bytes but holds " + std::to_string(bytes.size()) +
             "; is the file truncated?";
    return std::nullopt;
  }
  // Divides first, because the product may overflow.
  if (header.num_points > size / header.row_size ||
      header.num_points * header.row_size != size) {
    *error = place + std::to_string(size) + " bytes are not " +
             std::to_string(header.num_points) + " points of " +
             std::to_string(header.row_size) + " bytes";
    return std::nullopt;
  }
  // LZF decompresses 3 bytes to at most 264.
  constexpr std::uint64_t kMaxRatio = 88;
  std::string data;
  if (size <= kMaxRatio * compressed_size) {
    data.resize(size);
    data.resize(lzf_decompress(bytes.data(),
                               static_cast<unsigned int>(compressed_size),
                               data.data(),
                               static_cast<unsigned int>(size)));
  }
  if (data.size() != size) {
    *error = place + std::to_string(compressed_size) +
             " bytes do not decompress to " + std::to_string(size);
    return std::nullopt;
  }
  return data;
}

}  // namespace

std::optional<PointCloud> ParsePcd(std::string_view bytes, std::string* error) {
  const std::optional<PcdHeader> header = TakePcdHeader(&bytes, error);
  if (!header) return std::nullopt;
  const std::optional<CloudColumns> columns = PcdColumns(*header, error);
  if (!columns) return std::nullopt;
  if (header->num_points == 0) {
    *error = "POINTS: there are none";
    return std::nullopt;
  }

  if (header->data == "ascii") {
    return ReadAscii(*header, *columns, bytes, error);
  }
  if (header->data == "binary_compressed") {
    const auto data = Decompress(*header, bytes, error);
    if (!data) return std::nullopt;
    return ReadBinary(
        *header, *columns, *data, /*is_field_by_field=*/true, error);
  }
  // Extra bytes are accepted, because PCL used to pad files to whole pages.
  const std::uint64_t num_held = bytes.size() / header->row_size;
  if (header->num_points > num_held) {
    *error = WrongNumPoints(*header, num_held);
    return std::nullopt;
  }
  return ReadBinary(
      *header, *columns, bytes, /*is_field_by_field=*/false, error);
}

std::string FormatPcd(const PointCloud& cloud) {
  const bool has_intensity = cloud.intensity.size() != 0;
  const auto* const coordinates = cloud.points.data();
  const bool is_float =
      std::all_of(coordinates, coordinates + cloud.points.size(), FitsFloat32);
  const std::string count = std::to_string(cloud.points.cols());
  std::string bytes = "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7";
  for (const char* line :
       {"FIELDS x y z", is_float ? "SIZE 4 4 4" : "SIZE 8 8 8", "TYPE F F F"}) {
    bytes += std::string("\n") + line;
    if (has_intensity) {
      bytes += *line == 'F' ? " intensity" : *line == 'S' ? " 4" : " F";
    }
  }
  bytes += std::string("\nCOUNT 1 1 1") + (has_intensity ? " 1" : "") +
           "\nWIDTH " + count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
           count + "\nDATA binary\n";
  for (Eigen::Index i = 0; i < cloud.points.cols(); ++i) {
    for (const double coordinate : cloud.points.col(i)) {
      if (is_float) {
        AppendLittleEndian(static_cast<float>(coordinate), &bytes);
      } else {
        AppendLittleEndian(coordinate, &bytes);
      }
    }
    if (has_intensity) AppendLittleEndian(cloud.intensity[i], &bytes);
  }
  return bytes;
}

}  // namespace quatro
