// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Matched points as text, one match per line: sx,sy,sz,tx,ty,tz [m].
//
// Separators are commas, spaces or tabs. A header line, empty lines and lines
// that start with # are ignored.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_MATCHES_CSV_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_MATCHES_CSV_H_

#include <optional>
#include <string>

#include "features/base/types.h"
#include "features/matching.h"

namespace quatro {

// Returns nullopt and says file, line, column and reason in *error for anything
// but six finite numbers a line, and for an empty file; "-" is standard input.
// A file that has a line of names and no matches is read as no matches.
std::optional<MatchedPoints> ReadMatches(const std::string& path,
                                         std::string* error);

// Writes a header line. Reading the text back recovers every number bit for
// bit.
std::string FormatMatches(const PointsRef& source, const PointsRef& target);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_MATCHES_CSV_H_
