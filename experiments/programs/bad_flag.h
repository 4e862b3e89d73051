// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A flag that a program does not have, with the one that may have been meant, a
// value that is not of its flag's type, and a flag that is given twice.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_BAD_FLAG_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_BAD_FLAG_H_

#include <optional>
#include <string>
#include <vector>

namespace quatro {

// Describes the first argument that is no flag of gflags, has a value of
// another type or repeats a flag, as --a and --noa do. Returns nullopt if there
// is none, or if --undefok is among them. Sets the flags before it. `arguments`
// are without the program's name.
std::optional<std::string> TellBadFlag(
    const std::vector<std::string>& arguments);

// A message of the library with its options spelled as flags of this program,
// if it has them: "voxel_size = -1, must be > 0" begins with --voxel_size=-1,
// and "method fgr works" with --method=fgr.
std::string SpellAsFlags(std::string message);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_BAD_FLAG_H_
