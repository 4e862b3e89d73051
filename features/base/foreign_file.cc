// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/base/foreign_file.h"

#include <algorithm>

namespace quatro {
namespace {

struct Signature {
  std::string_view start;
  std::string_view description;
};

using std::string_view_literals::operator""sv;

constexpr std::string_view kHtml =
    "is a web page; the download failed, repeat it";
constexpr std::string_view kUtf16 = "is UTF-16 text; save it as UTF-8";

constexpr Signature kSignatures[] = {
    {"version https://git-lfs"sv,
     "is a pointer of Git LFS, not the data; run git lfs pull"},
    {"<!DOCTYPE"sv, kHtml},
    {"<!doctype"sv, kHtml},
    {"<html"sv, kHtml},
    {"<HTML"sv, kHtml},
    {"<?xml"sv, "is XML; the download failed, repeat it"},
    {"\x1f\x8b\x08"sv, "is gzip-compressed; run gunzip"},
    {"PK\x03\x04"sv, "is a zip archive; unpack it"},
    {"BZh"sv, "is bzip2-compressed; run bunzip2"},
    {"\xfd"
     "7zXZ"sv,
     "is xz-compressed; run unxz"},
    {"\x28\xb5\x2f\xfd"sv, "is zstd-compressed; run unzstd"},
    {"\x93NUMPY"sv, "is a NumPy array; save it as text"},
    {"LASF"sv, "is a LAS file; convert it to .ply, .pcd or .bin"},
    {"\xff\xfe"sv, kUtf16},
    {"\xfe\xff"sv, kUtf16}};

}  // namespace

std::string_view DescribeForeignFile(std::string_view bytes) {
  const auto found = std::find_if(
      std::begin(kSignatures),
      std::end(kSignatures),
      [&](const Signature& known) { return bytes.starts_with(known.start); });
  return found == std::end(kSignatures) ? "" : found->description;
}

bool LooksLikeText(std::string_view bytes) {
  constexpr std::size_t kNumBytes = 512;
  const std::string_view start = bytes.substr(0, kNumBytes);
  return std::all_of(start.begin(), start.end(), [](char c) {
    return (c >= ' ' && c <= '~') || c == '\t' || c == '\n' || c == '\r';
  });
}

}  // namespace quatro
