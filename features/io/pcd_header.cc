// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/pcd_header.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>

#include "features/base/cloud_text.h"

namespace quatro {
namespace {

using Words = std::vector<std::string_view>;
using Entries = std::map<std::string_view, Words>;

Words SplitWords(std::string_view line) {
  Words words;
  while (true) {
    const std::string_view word = TakeWord(&line);
    if (word.empty()) return words;
    words.push_back(word);
  }
}

// Reads the entries up to and including DATA.
std::optional<Entries> TakeEntries(std::string_view* bytes,
                                   std::string* error) {
  constexpr std::array<std::string_view, 10> kNames = {"VERSION",
                                                       "FIELDS",
                                                       "SIZE",
                                                       "TYPE",
                                                       "COUNT",
                                                       "WIDTH",
                                                       "HEIGHT",
                                                       "VIEWPOINT",
                                                       "POINTS",
                                                       "DATA"};
  Entries entries;
  HeaderLines lines(bytes);
  for (int line_number = 1; !bytes->empty(); ++line_number) {
    std::string_view line = lines.Take();
    std::string_view name = TakeWord(&line);
    if (name == "COLUMNS") name = "FIELDS";  // Its name in version 0.5.
    if (name.empty() || name.starts_with('#')) continue;
    if (std::find(kNames.begin(), kNames.end(), name) == kNames.end() ||
        !entries.emplace(name, SplitWords(line)).second) {
      *error = "line " + std::to_string(line_number) + ": " + Quoted(name) +
               " does not belong in a PCD header, or not twice";
      return std::nullopt;
    }
    if (name == "DATA") return entries;
  }
  *error = "header: has no DATA line; is the file truncated?";
  return std::nullopt;
}

// PCL accepts lower case, too.
std::optional<ScalarType> ParsePcdType(std::string_view type,
                                       std::string_view size) {
  if (type == "f") type = "F";
  if (type == "i") type = "I";
  if (type == "u") type = "U";
  if (type == "F" && size == "4") return ScalarType::kFloat32;
  if (type == "F" && size == "8") return ScalarType::kFloat64;
  if (type == "I" && size == "1") return ScalarType::kInt8;
  if (type == "I" && size == "2") return ScalarType::kInt16;
  if (type == "I" && size == "4") return ScalarType::kInt32;
  if (type == "I" && size == "8") return ScalarType::kInt64;
  if (type == "U" && size == "1") return ScalarType::kUint8;
  if (type == "U" && size == "2") return ScalarType::kUint16;
  if (type == "U" && size == "4") return ScalarType::kUint32;
  if (type == "U" && size == "8") return ScalarType::kUint64;
  return std::nullopt;
}

// Parses FIELDS, SIZE, TYPE and COUNT. Without the last three, all fields are
// single float32 numbers.
bool ParseFields(Entries* entries, PcdHeader* header, std::string* error) {
  const Words& names = (*entries)["FIELDS"];
  Words& sizes = (*entries)["SIZE"];
  Words& types = (*entries)["TYPE"];
  Words& counts = (*entries)["COUNT"];
  if (sizes.empty()) sizes.assign(names.size(), "4");
  if (types.empty()) types.assign(names.size(), "F");
  if (counts.empty()) counts.assign(names.size(), "1");
  if (names.size() != sizes.size() || names.size() != types.size() ||
      names.size() != counts.size()) {
    *error = "FIELDS: " + std::to_string(names.size()) + " names for " +
             std::to_string(sizes.size()) + " SIZE, " +
             std::to_string(types.size()) + " TYPE and " +
             std::to_string(counts.size()) + " COUNT entries";
    return false;
  }

  constexpr std::uint64_t kMaxRowSize =
      std::numeric_limits<std::uint32_t>::max();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string place = "FIELDS " + Quoted(names[i]) + ": ";
    const std::optional<ScalarType> type = ParsePcdType(types[i], sizes[i]);
    if (!type) {
      *error = place + "there is no TYPE " + Quoted(types[i]) + " of SIZE " +
               Quoted(sizes[i]);
      return false;
    }
    const std::optional<std::uint64_t> count = ParseCount(counts[i]);
    if (!count || *count > (kMaxRowSize - header->row_size) / SizeOf(*type)) {
      *error = place + "COUNT " + Quoted(counts[i]) +
               " is not a number from 0 to what fits a point of 4 GiB";
      return false;
    }
    header->fields.push_back({names[i], *type, *count, header->row_size});
    header->row_size += *count * SizeOf(*type);
  }
  return true;
}

// The number after WIDTH, HEIGHT or POINTS. Returns nullopt without setting
// *error if the entry is missing.
std::optional<std::uint64_t> FindCount(const Entries& entries,
                                       std::string_view name,
                                       std::string* error) {
  const auto entry = entries.find(name);
  if (entry == entries.end()) return std::nullopt;
  const Words& words = entry->second;
  std::optional<std::uint64_t> count;
  if (words.size() == 1) count = ParseCount(words[0]);
  if (!count) {
    *error = std::string(name) + ": " +
             Quoted(words.empty() ? "" : words.back()) +
             " is not a number of points";
  }
  return count;
}

// Parses WIDTH, HEIGHT and POINTS. A WIDTH or HEIGHT of 0 counts as missing. A
// missing HEIGHT is 1. Either WIDTH or POINTS may be missing.
std::optional<std::uint64_t> ParseNumPoints(const Entries& entries,
                                            std::string* error) {
  error->clear();
  const std::uint64_t width = FindCount(entries, "WIDTH", error).value_or(0);
  std::uint64_t height = FindCount(entries, "HEIGHT", error).value_or(0);
  const auto points = FindCount(entries, "POINTS", error);
  if (!error->empty()) return std::nullopt;
  if (width == 0) {
    if (!points) *error = "POINTS: is missing, and so is WIDTH";
    return points;
  }
  if (height == 0) height = 1;

  const std::string product = "WIDTH x HEIGHT = " + std::to_string(width) +
                              " x " + std::to_string(height);
  if (width > std::numeric_limits<std::uint64_t>::max() / height) {
    *error = product + ": is too large";
    return std::nullopt;
  }
  if (points && *points != width * height) {
    *error = "POINTS: " + std::to_string(*points) + " is not " + product;
    return std::nullopt;
  }
  return width * height;
}

}  // namespace

std::optional<PcdHeader> TakePcdHeader(std::string_view* bytes,
                                       std::string* error) {
  std::optional<Entries> entries = TakeEntries(bytes, error);
  if (!entries) return std::nullopt;

  const auto is_one_of = [&](std::string_view name, const Words& values) {
    const Words& words = (*entries)[name];
    if (words.size() == 1 &&
        std::find(values.begin(), values.end(), words[0]) != values.end()) {
      return true;
    }
    *error = std::string(name) + ": " +
             (words.empty() ? "is missing" : Quoted(words[0]) + " is unknown");
    return false;
  };
  PcdHeader header;
  if ((entries->contains("VERSION") &&
       !is_one_of("VERSION", {"0.5", ".5", "0.6", ".6", "0.7", ".7"})) ||
      !is_one_of("DATA", {"ascii", "binary", "binary_compressed"}) ||
      !ParseFields(&*entries, &header, error)) {
    return std::nullopt;
  }
  const std::optional<std::uint64_t> num_points =
      ParseNumPoints(*entries, error);
  if (!num_points) return std::nullopt;
  header.num_points = *num_points;
  header.data = (*entries)["DATA"][0];
  return header;
}

}  // namespace quatro
