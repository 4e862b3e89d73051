// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/npy.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "features/base/cloud_text.h"
#include "features/io/cloud_fields.h"

namespace quatro {
namespace {

using std::string_view_literals::operator""sv;

constexpr std::string_view kMagic = "\x93NUMPY"sv;
constexpr std::uint64_t kMaxNumColumns = 64;

struct Header {
  ScalarType type = ScalarType::kFloat64;
  bool is_fortran = false;
  std::uint64_t num_rows = 0;
  std::uint64_t num_columns = 0;
};

// Removes the header's dictionary from *bytes. Returns an empty view and sets
// *error if there is none.
std::string_view TakeDictionary(std::string_view* bytes, std::string* error) {
  constexpr std::size_t kVersionEnd = 8;
  if (!bytes->starts_with(kMagic)) {
    *error = "is not a NumPy array; it must start with \\x93NUMPY";
    return {};
  }
  const bool is_short =
      bytes->size() > kMagic.size() && (*bytes)[kMagic.size()] == '\x01';
  const std::size_t begin = kVersionEnd + (is_short ? 2 : 4);
  if (bytes->size() < begin) {
    *error = "the header ends early; is the file truncated?";
    return {};
  }
  const auto size = static_cast<std::size_t>(
      DecodeScalar(bytes->data() + kVersionEnd,
                   is_short ? ScalarType::kUint16 : ScalarType::kUint32,
                   std::endian::little));
  if (size > bytes->size() - begin) {
    *error = "the header ends early; is the file truncated?";
    return {};
  }
  const std::string_view dictionary = Trim(bytes->substr(begin, size));
  bytes->remove_prefix(begin + size);
  if (dictionary.size() < 2 || dictionary.front() != '{' ||
      dictionary.back() != '}') {
    *error = "header " + Quoted(dictionary) + ": must be a dictionary in {}";
    return {};
  }
  return dictionary;
}

// The value of 'key', up to the next comma outside of brackets and quotes.
std::string_view ValueOf(std::string_view key, std::string_view dictionary) {
  for (const char quote : {'\'', '"'}) {
    const std::string quoted = quote + std::string(key) + quote;
    const std::size_t found = dictionary.find(quoted);
    if (found == std::string_view::npos) continue;
    std::string_view rest = Trim(dictionary.substr(found + quoted.size()));
    if (!rest.starts_with(':')) continue;
    rest = Trim(rest.substr(1));
    int depth = 0;
    char open = '\0';  // The quote that `c` is inside of.
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const char c = rest[i];
      if (open != '\0') {
        if (c == open) open = '\0';
      } else if (c == '\'' || c == '"') {
        open = c;
      } else if (c == '(' || c == '[') {
        ++depth;
      } else if (c == ')' || c == ']') {
        --depth;
      } else if (depth == 0 && (c == ',' || c == '}')) {
        return Trim(rest.substr(0, i));
      }
    }
  }
  return {};
}

// Accepts only '<f4' and '<f8'.
bool ReadType(std::string_view descr, ScalarType* type, std::string* error) {
  const std::string_view name =
      descr.size() > 2 ? descr.substr(1, descr.size() - 2) : descr;
  if (name == "<f4" || name == "<f8") {
    *type = name == "<f4" ? ScalarType::kFloat32 : ScalarType::kFloat64;
    return true;
  }
  *error =
      descr.starts_with('[')
          ? "is a structured array; save x, y and z as columns of one float32 "
            "or float64 array"
          : "dtype " + Quoted(name) +
                ": must be '<f4' or '<f8'; save array.astype('<f4')";
  return false;
}

// "(N, C)".
bool ReadShape(std::string_view shape, Header* header, std::string* error) {
  std::vector<std::uint64_t> sizes;
  bool is_tuple =
      shape.size() >= 2 && shape.front() == '(' && shape.back() == ')';
  std::string_view rest =
      is_tuple ? Trim(shape.substr(1, shape.size() - 2)) : std::string_view();
  while (!rest.empty()) {
    const std::string_view part = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), part.size() + 1));
    rest = Trim(rest);
    const auto size = ParseCount(Trim(part));
    is_tuple = is_tuple && size.has_value();
    sizes.push_back(size.value_or(0));
  }
  if (is_tuple && sizes.size() == 2 && sizes[1] >= 3 &&
      sizes[1] <= kMaxNumColumns) {
    header->num_rows = sizes[0];
    header->num_columns = sizes[1];
    return true;
  }
  *error = "shape " + Quoted(shape) + ": must be (N, 3) to (N, " +
           std::to_string(kMaxNumColumns) + "), a point in each row";
  if (is_tuple && sizes.size() == 2 && (sizes[0] == 3 || sizes[0] == 4)) {
    *error += "; save array.T";
  } else if (is_tuple && sizes.size() > 2) {
    *error += "; save array.reshape(-1, " + std::to_string(sizes.back()) + ")";
  }
  return false;
}

std::optional<Header> TakeHeader(std::string_view* bytes, std::string* error) {
  const std::string_view dictionary = TakeDictionary(bytes, error);
  if (dictionary.empty()) return std::nullopt;
  Header header;
  if (!ReadType(ValueOf("descr", dictionary), &header.type, error) ||
      !ReadShape(ValueOf("shape", dictionary), &header, error)) {
    return std::nullopt;
  }
  const std::string_view order = ValueOf("fortran_order", dictionary);
  if (order != "True" && order != "False") {
    *error = "fortran_order " + Quoted(order) + ": must be True or False";
    return std::nullopt;
  }
  header.is_fortran = order == "True";
  return header;
}

}  // namespace

std::optional<PointCloud> ParseNpy(std::string_view bytes, std::string* error) {
  const auto header = TakeHeader(&bytes, error);
  if (!header) return std::nullopt;
  const auto [type, is_fortran, num_rows, num_columns] = *header;
  const std::size_t size = SizeOf(type);
  // Divides, because the product of the numbers in the header may overflow.
  if (bytes.size() % (num_columns * size) != 0 ||
      bytes.size() / (num_columns * size) != num_rows) {
    *error = std::to_string(bytes.size()) + " bytes of numbers, must be " +
             std::to_string(num_rows) + " x " + std::to_string(num_columns) +
             " of " + std::to_string(size) +
             " bytes as the header says; is the file truncated?";
    return std::nullopt;
  }
  const bool has_intensity = num_columns == 4 || num_columns == 5;
  CloudBuilder builder(num_rows, has_intensity);
  for (std::size_t i = 0; i < num_rows; ++i) {
    std::array<double, 4> row = {};
    for (std::size_t k = 0; k < (has_intensity ? 4u : 3u); ++k) {
      const std::size_t index =
          is_fortran ? k * num_rows + i : i * num_columns + k;
      row[k] =
          DecodeScalar(bytes.data() + index * size, type, std::endian::little);
    }
    builder.Add(row);
  }
  return builder.Build(error);
}

}  // namespace quatro
