// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The registry of estimators from matched points: a name, a description and a
// solver each. A new one is a line in methods.cc and then known to all
// programs.

#ifndef QUATRO_EXPERIMENTS_METHODS_H_
#define QUATRO_EXPERIMENTS_METHODS_H_

#include <string>
#include <vector>

#include "robust/quatro.h"
#include "robust/registration.h"

namespace quatro {

std::vector<std::string> MethodNames();

// One line a method, its name and what it does.
std::string DescribeMethods();

// The method with noise bound, seed, threads and all else that applies to it
// from `options`. Empty, with *error set, for a name that is not known.
PoseSolver MakeSolver(const std::string& name,
                      const QuatroOptions& options,
                      std::string* error);

// Sets *option by a flag's text: "on", "off", or empty for no change. For any
// other text returns false and sets *error, which names the flag.
bool ApplySwitch(const std::string& flag,
                 const std::string& text,
                 bool* option,
                 std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_METHODS_H_
