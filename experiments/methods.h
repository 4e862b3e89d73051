// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The registry of estimators from matched points: a name, a description and a
// solver each. A new one is a line in methods.cc and then known to all
// programs.

#ifndef QUATRO_EXPERIMENTS_METHODS_H_
#define QUATRO_EXPERIMENTS_METHODS_H_

#include <string>
#include <vector>

#include "robust/ins.h"
#include "robust/quatro.h"
#include "robust/registration.h"

namespace quatro {

std::vector<std::string> MethodNames();

// One line a method, its name and what it does.
std::string DescribeMethods();

// The method with noise bound, seed, threads and all else that applies to it
// from `options`. Empty, with *error set, for a name that is not known, and for
// quatro_ins, which needs an INS.
PoseSolver MakeSolver(const std::string& name,
                      const QuatroOptions& options,
                      std::string* error);

// The same in the level frames of `ins`. Empty, too, for a method that finds
// roll and pitch by itself and has no use for an INS.
PoseSolver MakeSolver(const std::string& name,
                      const QuatroOptions& options,
                      const InsOptions& ins,
                      std::string* error);

// The same for RegistrationOptions::solver beside this `ins`: it leaves the
// turning of the matches to Register().
PoseSolver MakeLevelSolver(const std::string& name,
                           const QuatroOptions& options,
                           const InsOptions& ins,
                           std::string* error);

// Sets *option by a flag's text: "on", "off", or empty for no change. For any
// other text returns false and sets *error, which names the flag.
bool ApplySwitch(const std::string& flag,
                 const std::string& text,
                 bool* option,
                 std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_METHODS_H_
