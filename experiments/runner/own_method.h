// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// An estimator for matched points that is not among the methods of
// experiments/programs/methods.h. The program that runs an experiment supplies
// it.

#ifndef QUATRO_EXPERIMENTS_RUNNER_OWN_METHOD_H_
#define QUATRO_EXPERIMENTS_RUNNER_OWN_METHOD_H_

#include <functional>
#include <string>

#include "robust/estimators/pose_summary.h"
#include "robust/estimators/quatro.h"

namespace quatro {

struct OwnMethod {
  std::string name;         // Differs from known methods; no comma.
  std::string description;  // One line.

  // Makes the estimator with noise bound, seed and threads of the options, and
  // any other options that it can use.
  std::function<PoseSolver(const QuatroOptions& options)> make;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_OWN_METHOD_H_
