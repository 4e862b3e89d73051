// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/gzip.h"

#ifdef QUATRO_HAS_ZLIB
#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <limits>
#endif

namespace quatro {

#ifdef QUATRO_HAS_ZLIB
namespace {

constexpr char kNoMemory[] = "the decompressed data do not fit in memory";

// A stream of zlib, which is closed on destruction.
class Inflater {
 public:
  Inflater() {
    constexpr int kGzipOnly = 16;
    is_open_ = inflateInit2(&stream_, kGzipOnly + MAX_WBITS) == Z_OK;
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() {
    if (is_open_) inflateEnd(&stream_);
  }

  bool is_open() const { return is_open_; }
  z_stream* stream() { return &stream_; }

 private:
  z_stream stream_ = {};
  bool is_open_;
};

uInt AtOnce(std::size_t size) {
  return static_cast<uInt>(
      std::min<std::size_t>(size, std::numeric_limits<uInt>::max()));
}

}  // namespace

std::optional<std::string> Gunzip(std::string_view bytes,
                                  std::string* error) try {
  if (!bytes.starts_with("\x1f\x8b")) {
    *error = "is not gzip-compressed; remove .gz from its name";
    return std::nullopt;
  }
  Inflater inflater;
  if (!inflater.is_open()) {
    *error = "zlib cannot start: there is no memory";
    return std::nullopt;
  }
  z_stream* const stream = inflater.stream();
  std::string text;
  std::size_t size = 0;
  while (true) {
    if (size == text.size()) {
      text.resize(std::max<std::size_t>(4 * bytes.size(), 2 * size));
    }
    const uInt num_in = AtOnce(bytes.size());
    const uInt num_out = AtOnce(text.size() - size);
    // zlib does not write to its input.
    stream->next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream->avail_in = num_in;
    stream->next_out = reinterpret_cast<Bytef*>(text.data() + size);
    stream->avail_out = num_out;
    const int status = inflate(stream, Z_NO_FLUSH);
    bytes.remove_prefix(num_in - stream->avail_in);
    size += num_out - stream->avail_out;
    if (status == Z_STREAM_END) {
      // Zeros at the end are padding.
      if (bytes.find_first_not_of('\0') == std::string_view::npos) break;
      if (inflateReset(stream) == Z_OK) continue;
    }
    const bool has_moved =
        num_in != stream->avail_in || num_out != stream->avail_out;
    if (status == Z_OK && has_moved) continue;
    *error = status == Z_MEM_ERROR ? kNoMemory
             : bytes.empty() ? "the gzip data end early; is the file truncated?"
                             : "the gzip data are damaged; repeat the download";
    return std::nullopt;
  }
  text.resize(size);
  if (text.empty()) {
    *error =
        "is gzip-compressed, but contains no data; compress the file again";
    return std::nullopt;
  }
  if (text.starts_with("\x1f\x8b\x08")) {
    *error = "is gzip-compressed twice; run gunzip once";
    return std::nullopt;
  }
  return text;
} catch (const std::exception&) {  // std::bad_alloc or std::length_error.
  *error = kNoMemory;
  return std::nullopt;
}

#else

std::optional<std::string> Gunzip(std::string_view, std::string* error) {
  *error =
      "is gzip-compressed, and quatro was built without zlib; run gunzip, or "
      "install zlib and build again";
  return std::nullopt;
}

#endif

}  // namespace quatro
