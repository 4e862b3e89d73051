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

// Reads a file, or standard input if `path` is "-". Returns nullopt, with file,
// line, column and reason in *error, if a line does not have six finite
// numbers, if the file has neither a header nor a match, or if it is a cloud by
// its name. A file with only a header line has no matches; FormatMatches()
// writes it.
std::optional<MatchedPoints> ReadMatches(const std::string& path,
                                         std::string* error);

// Writes a header line. Reading the text back recovers every number bit for
// bit.
std::string FormatMatches(const PointsRef& source, const PointsRef& target);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_MATCHES_CSV_H_
