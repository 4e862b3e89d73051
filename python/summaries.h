// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The results of the module's functions, as Python classes.

#ifndef QUATRO_PYTHON_SUMMARIES_H_
#define QUATRO_PYTHON_SUMMARIES_H_

#include <pybind11/pybind11.h>

#include <string>

#include "robust/estimators/pose_summary.h"
#include "robust/registration/registration.h"
#include "robust/verdict/verdict.h"
#include "solvers/local/local_alignment.h"

namespace quatro {

// The answer of solve(), from matched points.
struct Solution {
  std::string method;
  RegistrationSummary summary;
};

// The answer of register(), from clouds.
struct Registration {
  std::string method;
  RegistrationSummary summary;
  Eigen::Index num_source_dropped = 0;
  Eigen::Index num_target_dropped = 0;
};

// The answer of align().
struct Alignment {
  std::string method;
  AlignmentSummary summary;
};

// Adds Solution and Registration to the module.
void BindSummaries(pybind11::module_* module);

// Adds Alignment to the module.
void BindAlignment(pybind11::module_* module);

}  // namespace quatro

#endif  // QUATRO_PYTHON_SUMMARIES_H_
