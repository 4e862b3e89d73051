// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Flags in files, --flagfile=FILE. gflags would read any file without end,
// crash if one includes itself, and ignore misspelled flags in it.

#ifndef QUATRO_EXPERIMENTS_BASE_FLAG_FILES_H_
#define QUATRO_EXPERIMENTS_BASE_FLAG_FILES_H_

#include <optional>
#include <string>
#include <vector>

namespace quatro {

// Replaces each --flagfile before "--" by the lines of its files, one flag per
// line. Empty lines and lines that start with # are skipped. `arguments` do not
// include the program's name. Returns nullopt and sets *error if a file cannot
// be read or contains anything else, if a file includes itself, or for
// --fromenv and --tryfromenv.
std::optional<std::vector<std::string>> ExpandFlagFiles(
    const std::vector<std::string>& arguments, std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BASE_FLAG_FILES_H_
