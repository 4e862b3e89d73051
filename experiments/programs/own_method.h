// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// An estimator from matched points that is not in the registry of
// experiments/programs/methods.h: a value, brought along by whoever runs an
// experiment.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_OWN_METHOD_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_OWN_METHOD_H_

#include <functional>
#include <string>

#include "robust/estimators/pose_summary.h"
#include "robust/estimators/quatro.h"

namespace quatro {

struct OwnMethod {
  std::string name;         // None of the registry's; no comma.
  std::string description;  // One line.

  // The estimator with noise bound, seed and threads of the options, and what
  // else it can use of them.
  std::function<PoseSolver(const QuatroOptions& options)> make;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_OWN_METHOD_H_
