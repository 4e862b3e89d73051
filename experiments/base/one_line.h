// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Makes text safe to print in a one-line message. Quoted files, paths and flags
// may contain anything.

#ifndef QUATRO_EXPERIMENTS_BASE_ONE_LINE_H_
#define QUATRO_EXPERIMENTS_BASE_ONE_LINE_H_

#include <string>

namespace quatro {

// Replaces line breaks and all other control characters by "?".
inline std::string OneLine(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text;
}

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BASE_ONE_LINE_H_
