// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The header of a PLY file. Its strings refer to the text, which the caller
// owns.

#ifndef QUATRO_FEATURES_IO_PLY_HEADER_H_
#define QUATRO_FEATURES_IO_PLY_HEADER_H_

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "features/io/cloud_fields.h"

namespace quatro {

// A property of a row: one number or a list of numbers.
struct PlyProperty {
  std::string_view name;
  ScalarType type;
  std::optional<ScalarType> length_type;  // Set for a list.
};

// An element: rows with the same properties.
struct PlyElement {
  std::string_view name;
  std::uint64_t num_rows = 0;
  std::vector<PlyProperty> properties;
};

// The layout of a PLY file.
struct PlyHeader {
  // One of "ascii", "binary_little_endian", "binary_big_endian".
  std::string_view format;

  std::vector<PlyElement> elements;
};

// Removes the header from *bytes, which then starts with the first row. Returns
// nullopt and sets *error if the header is malformed. Does not check whether
// the rows exist.
std::optional<PlyHeader> TakePlyHeader(std::string_view* bytes,
                                       std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_PLY_HEADER_H_
