// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Reads the rows of a PLY file value by value, from bytes or from text.
//
// Both classes have the same members. MaxNumRows() is an upper bound derived
// from the remaining size of the file. It is exact unless there are lists or
// further elements. The other functions return false at the end of the data,
// and false with a *reason if the data are invalid.

#ifndef QUATRO_FEATURES_IO_PLY_ROWS_H_
#define QUATRO_FEATURES_IO_PLY_ROWS_H_

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "features/base/cloud_text.h"
#include "features/io/cloud_fields.h"
#include "features/io/ply_header.h"

namespace quatro {

// Rows as bytes in the given byte order.
class BinaryPlyRows {
 public:
  // `bytes` must outlive this.
  BinaryPlyRows(std::string_view bytes, std::endian order)
      : bytes_(bytes), order_(order) {}

  // `properties` must not be empty.
  std::uint64_t MaxNumRows(std::span<const PlyProperty> properties) const {
    std::size_t min_size = 0;
    for (const PlyProperty& property : properties) {
      min_size += SizeOf(property.length_type.value_or(property.type));
    }
    return bytes_.size() / min_size;
  }

  bool BeginRow() { return true; }

  bool Take(ScalarType type, double* value, std::string*) {
    if (bytes_.size() < SizeOf(type)) return false;
    *value = DecodeScalar(bytes_.data(), type, order_);
    bytes_.remove_prefix(SizeOf(type));
    return true;
  }

  bool TakeLength(ScalarType type, std::uint64_t* length, std::string* reason) {
    double value = 0.0;
    if (!Take(type, &value, reason)) return false;
    // No file has a list this long. Lengths below this are exact as a double.
    constexpr double kTooLong = 4503599627370496.0;
    if (!(value >= 0.0 && value < kTooLong)) {
      *reason = "a list has an impossible length";
      return false;
    }
    *length = static_cast<std::uint64_t>(value);
    return true;
  }

  bool Skip(ScalarType type, std::uint64_t num_values, std::string*) {
    if (num_values > bytes_.size() / SizeOf(type)) return false;
    bytes_.remove_prefix(num_values * SizeOf(type));
    return true;
  }

  bool EndRow(std::string*) { return true; }

 private:
  std::string_view bytes_;
  std::endian order_;
};

// Rows as text, one line per row.
class TextPlyRows {
 public:
  // `text` must outlive this.
  explicit TextPlyRows(std::string_view text)
      : text_(text), num_lines_(CountLines(text)) {}

  std::uint64_t MaxNumRows(std::span<const PlyProperty>) const {
    return num_lines_;
  }

  bool BeginRow() {
    while (!text_.empty()) {
      line_ = TakeLine(&text_);
      std::string_view words = line_;
      if (TakeWord(&words).empty()) continue;
      --num_lines_;
      return true;
    }
    return false;
  }

  bool Take(ScalarType, double* value, std::string* reason) {
    std::string_view word;
    if (!TakeWordOrFail(&word, reason)) return false;
    const std::optional<double> number = ParseNumber(word);
    if (!number) *reason = Quoted(word) + " is not a number";
    *value = number.value_or(0.0);
    return number.has_value();
  }

  bool TakeLength(ScalarType, std::uint64_t* length, std::string* reason) {
    std::string_view word;
    if (!TakeWordOrFail(&word, reason)) return false;
    const std::optional<std::uint64_t> count = ParseCount(word);
    if (!count) *reason = Quoted(word) + " is not the length of a list";
    *length = count.value_or(0);
    return count.has_value();
  }

  bool Skip(ScalarType, std::uint64_t num_values, std::string* reason) {
    std::string_view word;
    for (std::uint64_t i = 0; i < num_values; ++i) {
      if (!TakeWordOrFail(&word, reason)) return false;
    }
    return true;
  }

  bool EndRow(std::string* reason) {
    const std::string_view word = TakeWord(&line_);
    if (!word.empty()) *reason = Quoted(word) + " is one value too many";
    return word.empty();
  }

 private:
  bool TakeWordOrFail(std::string_view* word, std::string* reason) {
    *word = TakeWord(&line_);
    if (word->empty()) *reason = "has too few values; is the file truncated?";
    return !word->empty();
  }

  std::string_view text_;
  std::uint64_t num_lines_;
  std::string_view line_;
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_PLY_ROWS_H_
