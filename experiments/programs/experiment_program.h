// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// quatro_experiment as a function, so that a user's program can run the same
// experiments with its own estimators in addition to those of quatro:
//
//   int main(int argc, char** argv) {
//     return quatro::RunExperimentProgram(argc, argv, {{"mine", "...", Make}});
//   }
//
// See docs/own_estimator.md for an example.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_EXPERIMENT_PROGRAM_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_EXPERIMENT_PROGRAM_H_

#include <vector>

#include "experiments/runner/own_method.h"

namespace quatro {

// Returns the program's exit code; --helpshort describes the flags.
int RunExperimentProgram(int argc,
                         char** argv,
                         const std::vector<OwnMethod>& own = {});

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_EXPERIMENT_PROGRAM_H_
