// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The flags that quatro_register and quatro_solve share, and what both programs
// do with them. Zero and empty flags mean the preset's value.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_REGISTRATION_FLAGS_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_REGISTRATION_FLAGS_H_

#include <gflags/gflags_declare.h>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/outputs.h"
#include "experiments/programs/json_report.h"
#include "experiments/programs/picture.h"
#include "robust/registration/options.h"
#include "robust/verdict/verdict.h"

DECLARE_uint64(seed);

namespace quatro {

// Whether the method works on clouds alone, from a guess.
bool StartsFromGuess(const std::string& method);

// Sets the options from the flags, including `method` and `refine`; `refine` is
// empty without clouds. Returns false and names the flag in *error if a value
// is invalid or cannot be used with the method.
bool ApplyFlags(const std::string& method,
                const std::string& refine,
                bool has_clouds,
                RegistrationOptions* options,
                std::string* error);

// Prints the list for --list_methods or --list_options and returns the exit
// code. Returns nullopt if neither flag is given.
std::optional<int> PrintLists(const std::string& method, bool has_clouds);

// Whether --json, --explain, --picture and `others` can be written. Returns
// false and sets *error if one of them cannot. A file of --guess is an input.
bool CanWriteAnswer(const std::vector<OutputFlag>& others,
                    std::vector<std::string> inputs,
                    std::string* error);

// "registered: 245 of 1109 matches are inliers; ..."
std::string VerdictLine(const Verdict& verdict);

// Writes `files`, the picture for --picture, the report for --json and its
// explanation for --explain. Returns the program's exit code.
int WriteAnswer(const Json& report,
                const RegistrationPicture& picture,
                const Verdict& verdict,
                std::vector<OutputFile> files);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_REGISTRATION_FLAGS_H_
