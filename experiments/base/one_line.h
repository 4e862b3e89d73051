// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Messages that quote a file, a path or a flag, which may hold anything.

#ifndef QUATRO_EXPERIMENTS_BASE_ONE_LINE_H_
#define QUATRO_EXPERIMENTS_BASE_ONE_LINE_H_

#include <string>

namespace quatro {

// With "?" for line breaks and all else that a terminal would act upon.
inline std::string OneLine(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text;
}

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BASE_ONE_LINE_H_
