// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Makes text safe to print in a one-line message. Quoted files, paths and flags
// may contain anything.

#ifndef QUATRO_EXPERIMENTS_BASE_ONE_LINE_H_
#define QUATRO_EXPERIMENTS_BASE_ONE_LINE_H_

#include <string>
#include <string_view>

namespace quatro {

// Replaces line breaks, all other control characters and bytes that are not
// UTF-8 by "?". Words of more than 200 characters and lines of more than 2000
// bytes are shortened with "...".
std::string OneLine(std::string_view text);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BASE_ONE_LINE_H_
