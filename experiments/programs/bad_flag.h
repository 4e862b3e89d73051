// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A flag that a program does not have, with the one that may have been meant,
// and a value that is not of its flag's type.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_BAD_FLAG_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_BAD_FLAG_H_

#include <optional>
#include <string>
#include <vector>

namespace quatro {

// Describes the first argument that is no flag of gflags or has a value of
// another type. Returns nullopt if there is none, or if --undefok is among
// them. Sets the flags before it. `arguments` are without the program's name.
std::optional<std::string> TellBadFlag(
    const std::vector<std::string>& arguments);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_BAD_FLAG_H_
