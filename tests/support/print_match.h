// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// How failed tests print a match. All tests of a program that print matches
// include this, because the program has one such function.

#ifndef QUATRO_TESTS_SUPPORT_PRINT_MATCH_H_
#define QUATRO_TESTS_SUPPORT_PRINT_MATCH_H_

#include <ostream>

#include "features/matching.h"

namespace quatro {

inline void PrintTo(const Match& match, std::ostream* os) {
  *os << match.source << "-" << match.target;
}

}  // namespace quatro

#endif  // QUATRO_TESTS_SUPPORT_PRINT_MATCH_H_
