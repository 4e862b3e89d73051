// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The header of a PCD file. Its strings refer to the text, which the caller
// owns.

#ifndef QUATRO_FEATURES_IO_PCD_HEADER_H_
#define QUATRO_FEATURES_IO_PCD_HEADER_H_

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "features/io/cloud_fields.h"

namespace quatro {

// One field of a point.
struct PcdField {
  std::string_view name;  // "_" is padding.
  ScalarType type;
  std::uint64_t count = 1;   // Values per point; 0: no such field.
  std::uint64_t offset = 0;  // In a row [bytes].
};

// The layout of a PCD file.
struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t row_size = 0;  // [bytes], below 2^32; 0 if all counts are 0.
  std::uint64_t num_points = 0;

  // One of "ascii", "binary", "binary_compressed".
  std::string_view data;
};

// Removes the header from *bytes, which then starts with the first row. Returns
// nullopt and sets *error if the header is malformed. Does not check whether
// the rows exist.
std::optional<PcdHeader> TakePcdHeader(std::string_view* bytes,
                                       std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_PCD_HEADER_H_
