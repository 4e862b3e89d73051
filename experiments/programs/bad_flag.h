// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Messages for invalid flags: an unknown flag (with the flag that was probably
// meant, or the program that has it), a value that does not have the type of
// its flag, a flag that is given twice, and an argument that is no flag.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_BAD_FLAG_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_BAD_FLAG_H_

#include <optional>
#include <string>
#include <vector>

namespace quatro {

// Describes the first argument that is an unknown flag, has a value of the
// wrong type or repeats a flag, as --a and --noa do. Returns nullopt if there
// is none, or none before an --undefok. Sets the flags before it. `arguments`
// do not include the program's name.
std::optional<std::string> TellBadFlag(
    const std::vector<std::string>& arguments);

// Describes an argument that is not a flag: a file without the name of its
// flag, or a flag that starts with a long dash, as copied from a formatted
// text.
std::string TellNoFlag(const std::string& argument);

// The name that was probably meant: part of it is missing or added, or it is
// misspelled. Empty if none is similar.
std::string NearestName(const std::string& name,
                        const std::vector<std::string>& names);

// Replaces the names of options in a message of the library by the flags of
// this program, if it has them: "voxel_size = -1, must be > 0" becomes
// "--voxel_size=-1, must be > 0", and "method fgr works" becomes
// "--method=fgr works". "num_pairs = 0" becomes "--pairs=0" if there is no flag
// --num_pairs. A message that begins with a flag is about its value, and keeps
// "name = ".
std::string SpellAsFlags(std::string message);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_BAD_FLAG_H_
