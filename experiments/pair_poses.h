// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What another program found for pairs of clouds: a pair a line, its name and
// the rows of the 4x4 matrix that moves the source onto the target,
//
//   pair,m00,m01,m02,m03,m10,...,m33
//
// Commas, blanks or tabs separate the numbers; a comma ends the name, which may
// hold blanks. Empty lines and those that start with # are passed over. A pair
// that the program has no answer for is left out.

#ifndef QUATRO_EXPERIMENTS_PAIR_POSES_H_
#define QUATRO_EXPERIMENTS_PAIR_POSES_H_

#include <map>
#include <optional>
#include <string>

#include "solvers/rigid3.h"

namespace quatro {

// Pair -> target_from_source. Strict: nullopt and one line in *error, which
// names file, line and reason, for anything else than a name and 16 finite
// numbers that make a rigid motion, for a pair that comes twice, and for a file
// without any.
std::optional<std::map<std::string, Rigid3>> ReadPairPoses(
    const std::string& path, std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PAIR_POSES_H_
