// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/cloud_format.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>

#include "features/base/cloud_text.h"

namespace quatro {
namespace {

struct KnownEnding {
  std::string_view ending;
  CloudFormat format;
};

constexpr KnownEnding kKnownEndings[] = {{".bin", CloudFormat::kBin},
                                         {".ply", CloudFormat::kPly},
                                         {".pcd", CloudFormat::kPcd},
                                         {".npy", CloudFormat::kNpy},
                                         {".xyz", CloudFormat::kText},
                                         {".txt", CloudFormat::kText},
                                         {".csv", CloudFormat::kText}};

constexpr std::string_view kGzip = ".gz";

// The last ending of a name with its dot, in lower case; empty if there is
// none.
std::string LastEnding(std::string_view name) {
  const std::size_t dot = name.find_last_of('.');
  if (dot == std::string_view::npos) return "";
  std::string ending(name.substr(dot));
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending;
}

// "a.ply.gz" is split into ".ply" and ".gz".
struct Endings {
  std::string ending;
  bool is_gzip;
};

Endings EndingsOf(std::string_view path) {
  path.remove_prefix(path.find_last_of('/') + 1);
  std::string ending = LastEnding(path);
  if (ending != kGzip) return {ending, false};
  path.remove_suffix(kGzip.size());
  return {LastEnding(path), true};
}

}  // namespace

std::optional<CloudFileType> FindCloudFileType(const std::string& path) {
  const auto [ending, is_gzip] = EndingsOf(path);
  const auto found =
      std::find_if(std::begin(kKnownEndings),
                   std::end(kKnownEndings),
                   [&ending = ending](const KnownEnding& known) {
                     return known.ending == std::string_view(ending);
                   });
  if (found == std::end(kKnownEndings)) return std::nullopt;
  return CloudFileType{found->format, is_gzip};
}

std::string UnknownEnding(const std::string& path, const char* must_be) {
  const auto [ending, is_gzip] = EndingsOf(path);
  return "ending " + Quoted(ending + std::string(is_gzip ? kGzip : "")) +
         ": must be " + must_be;
}

}  // namespace quatro
