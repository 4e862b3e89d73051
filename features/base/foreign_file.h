// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Recognizes files whose names do not match their contents, by their first
// bytes: a failed download, a pointer of Git LFS, a compressed file.

#ifndef QUATRO_FEATURES_BASE_FOREIGN_FILE_H_
#define QUATRO_FEATURES_BASE_FOREIGN_FILE_H_

#include <string_view>

namespace quatro {

// A description of the file and what to do about it, as the end of an error
// message: "is gzip-compressed; run gunzip". Empty if the file is not
// recognized.
std::string_view DescribeForeignFile(std::string_view bytes);

// Whether all of the first 512 bytes are printable ASCII or white space.
bool LooksLikeText(std::string_view bytes);

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_FOREIGN_FILE_H_
