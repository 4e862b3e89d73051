// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/ply_header.h"

#include <utility>

#include "features/base/cloud_text.h"

namespace quatro {
namespace {

std::optional<ScalarType> ParsePlyType(std::string_view name) {
  if (name == "char" || name == "int8") return ScalarType::kInt8;
  if (name == "uchar" || name == "uint8") return ScalarType::kUint8;
  if (name == "short" || name == "int16") return ScalarType::kInt16;
  if (name == "ushort" || name == "uint16") return ScalarType::kUint16;
  if (name == "int" || name == "int32") return ScalarType::kInt32;
  if (name == "uint" || name == "uint32") return ScalarType::kUint32;
  if (name == "int64") return ScalarType::kInt64;
  if (name == "uint64") return ScalarType::kUint64;
  if (name == "float" || name == "float32") return ScalarType::kFloat32;
  if (name == "double" || name == "float64") return ScalarType::kFloat64;
  return std::nullopt;
}

bool IsFloat(ScalarType type) {
  return type == ScalarType::kFloat32 || type == ScalarType::kFloat64;
}

// The words after "property".
std::optional<PlyProperty> ParseProperty(std::string_view words) {
  std::string_view type_name = TakeWord(&words);
  PlyProperty property = {};
  if (type_name == "list") {
    property.length_type = ParsePlyType(TakeWord(&words));
    if (!property.length_type || IsFloat(*property.length_type)) {
      return std::nullopt;
    }
    type_name = TakeWord(&words);
  }
  const std::optional<ScalarType> type = ParsePlyType(type_name);
  property.name = TakeWord(&words);
  if (!type || property.name.empty() || !TakeWord(&words).empty()) {
    return std::nullopt;
  }
  property.type = *type;
  return property;
}

bool ParseHeaderLine(std::string_view line, PlyHeader* header) {
  const std::string_view keyword = TakeWord(&line);
  if (keyword == "comment" || keyword == "obj_info") return true;
  if (keyword == "format") {
    header->format = TakeWord(&line);
    return (header->format == "ascii" ||
            header->format == "binary_little_endian" ||
            header->format == "binary_big_endian") &&
           TakeWord(&line) == "1.0";
  }
  if (keyword == "element") {
    PlyElement element;
    element.name = TakeWord(&line);
    const std::optional<std::uint64_t> num_rows = ParseCount(TakeWord(&line));
    if (!num_rows) return false;
    element.num_rows = *num_rows;
    header->elements.push_back(std::move(element));
    return true;
  }
  if (keyword == "property" && !header->elements.empty()) {
    const std::optional<PlyProperty> property = ParseProperty(line);
    if (!property) return false;
    header->elements.back().properties.push_back(*property);
    return true;
  }
  return keyword.empty();
}

}  // namespace

std::optional<PlyHeader> TakePlyHeader(std::string_view* bytes,
                                       std::string* error) {
  HeaderLines lines(bytes);
  const std::string_view first = lines.Take();
  std::string_view magic = first;
  if (TakeWord(&magic) != "ply" || !TakeWord(&magic).empty()) {
    *error = "line 1: is " + Quoted(first) + ", must be 'ply'";
    return std::nullopt;
  }
  PlyHeader header;
  for (int line_number = 2; !bytes->empty(); ++line_number) {
    const std::string_view line = lines.Take();
    std::string_view words = line;
    if (TakeWord(&words) == "end_header") {
      if (!header.format.empty()) return header;
      *error = "header: has no format line";
      return std::nullopt;
    }
    if (!ParseHeaderLine(line, &header)) {
      *error = "line " + std::to_string(line_number) +
               ": is not understood: " + Quoted(line);
      return std::nullopt;
    }
  }
  *error = "header: has no end_header; is the file truncated?";
  return std::nullopt;
}

}  // namespace quatro
