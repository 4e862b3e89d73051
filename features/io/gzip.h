// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Files compressed by gzip, if the library was built with zlib.

#ifndef QUATRO_FEATURES_IO_GZIP_H_
#define QUATRO_FEATURES_IO_GZIP_H_

#include <optional>
#include <string>
#include <string_view>

namespace quatro {

// Decompresses all members of the file, one after the other. Returns nullopt
// and sets *error, without a path, if `bytes` are not gzip, are truncated,
// damaged, without data or compressed twice, if the data do not fit in memory,
// or if the library was built without zlib.
std::optional<std::string> Gunzip(std::string_view bytes, std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_GZIP_H_
