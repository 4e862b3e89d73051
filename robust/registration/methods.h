// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The registry of methods, each with a name, a description, options and a
// solver. A new estimator is one file in robust/estimators/ and one line in
// methods.cc; it is then known to every program, table and figure, and to
// Python.

#ifndef QUATRO_ROBUST_REGISTRATION_METHODS_H_
#define QUATRO_ROBUST_REGISTRATION_METHODS_H_

#include <span>
#include <string>
#include <vector>

#include "robust/estimators/pose_summary.h"
#include "robust/registration/option_list.h"
#include "robust/registration/options.h"

namespace quatro {

// The input of a method.
enum class MethodInput {
  kMatches,        // Matched points, with or without clouds.
  kMatchedClouds,  // Matched points and the clouds that they come from.
  kClouds,         // Two clouds and a guess: local registration.
};

// Whether a method can use the attitudes of an INS. Methods that estimate roll
// and pitch cannot.
enum class InsUse { kRefused, kTaken, kNeeded };

// One line of the registry.
struct Method {
  const char* name;
  const char* description;
  MethodInput input;
  InsUse ins;

  // Whether other poses are searched if the solver's is not registered.
  bool searches;

  // The options that this method reads; any other is an error.
  OptionList (*options)(RegistrationOptions* options);

  // The solver, null for kClouds; `options` with shared values.
  PoseSolver (*make)(const RegistrationOptions& options);

  // Sets the options that define the method, for example the number of
  // iterations of ransac1k; null if there are none.
  void (*adjust)(RegistrationOptions* options);
};

// All methods, in the order of help texts and tables.
std::span<const Method> Methods();

// Names of the methods for this input.
std::vector<std::string> MethodNames(MethodInput input);

// Returns nullptr and sets *error for a name that is not in the registry.
const Method* FindMethod(const std::string& name, std::string* error);

// All options that the method reads, and no others: the common options; if
// there are clouds, those of the front end, the refinement and the search; its
// own options; those of the INS; and the bounds.
OptionList OptionsOf(const Method& method,
                     bool has_clouds,
                     RegistrationOptions* options);

// Returns false and sets *error if the method cannot use `ins`, or if it needs
// an INS and there is none.
bool CanUseIns(const Method& method, const InsOptions& ins, std::string* error);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_METHODS_H_
