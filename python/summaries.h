// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The Python classes that the functions of the module return.

#ifndef QUATRO_PYTHON_SUMMARIES_H_
#define QUATRO_PYTHON_SUMMARIES_H_

#include <pybind11/pybind11.h>

#include <string>

#include "robust/estimators/pose_summary.h"
#include "robust/registration/registration.h"
#include "robust/verdict/verdict.h"
#include "solvers/local/local_alignment.h"

namespace quatro {

// The result for matched points.
struct Solution {
  std::string method;
  PoseSummary solution;
  Verdict verdict;
  double total_seconds = 0.0;
};

// The result for clouds.
struct Registration {
  std::string method;
  RegistrationSummary summary;
  Eigen::Index num_source_dropped = 0;
  Eigen::Index num_target_dropped = 0;
};

// The result of local alignment.
struct Alignment {
  std::string method;
  AlignmentSummary summary;
};

void BindSummaries(pybind11::module_* module);

}  // namespace quatro

#endif  // QUATRO_PYTHON_SUMMARIES_H_
