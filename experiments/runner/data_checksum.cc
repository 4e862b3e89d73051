// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/runner/data_checksum.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "features/base/file.h"

namespace quatro {
namespace {

void SortUnique(std::vector<std::string>* names) {
  std::sort(names->begin(), names->end());
  names->erase(std::unique(names->begin(), names->end()), names->end());
}

}  // namespace

std::uint64_t Fnv1a(std::string_view bytes, std::uint64_t hash) {
  for (const char c : bytes) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3u;
  }
  return hash;
}

std::optional<DataSummary> SummarizeData(const std::string& folder,
                                         std::vector<std::string> scans,
                                         std::vector<std::string> lists,
                                         std::string* error) {
  namespace fs = std::filesystem;
  SortUnique(&scans);
  SortUnique(&lists);
  DataSummary summary;
  std::uint64_t hash = Fnv1a("");
  const auto add = [&](const std::string& name, const std::string& text) {
    ++summary.num_files;
    hash = Fnv1a(name + '\0' + text + '\0', hash);
  };
  for (const std::string& name : scans) {
    std::error_code code;
    const auto size = fs::file_size(fs::path(folder) / name, code);
    summary.num_missing += code ? 1 : 0;
    summary.num_bytes += code ? 0 : size;
    add(name, code ? "missing" : std::to_string(size));
  }
  for (const std::string& name : lists) {
    const auto text = ReadWholeFile((fs::path(folder) / name).string(), error);
    if (!text) return std::nullopt;
    summary.num_bytes += text->size();
    add(name, std::to_string(Fnv1a(*text)));
  }
  char digits[17];
  std::snprintf(
      digits, sizeof(digits), "%016llx", static_cast<unsigned long long>(hash));
  summary.checksum = digits;
  return summary;
}

}  // namespace quatro
