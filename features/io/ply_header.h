// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The header of a PLY file, as text that the caller keeps.

#ifndef QUATRO_FEATURES_IO_PLY_HEADER_H_
#define QUATRO_FEATURES_IO_PLY_HEADER_H_

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "features/io/cloud_fields.h"

namespace quatro {

// One number, or one list of them, of a row.
struct PlyProperty {
  std::string_view name;
  ScalarType type;
  std::optional<ScalarType> length_type;  // Of a list.
};

// Rows of the same properties.
struct PlyElement {
  std::string_view name;
  std::uint64_t num_rows = 0;
  std::vector<PlyProperty> properties;
};

// What a PLY file holds, and how.
struct PlyHeader {
  // One of "ascii", "binary_little_endian", "binary_big_endian".
  std::string_view format;

  std::vector<PlyElement> elements;
};

// Removes the header from *bytes, which then starts with the first row. Sets
// *error if it is malformed; whether the rows are there is not looked at.
std::optional<PlyHeader> TakePlyHeader(std::string_view* bytes,
                                       std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_PLY_HEADER_H_
