// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/experiment_program.h"

int main(int argc, char** argv) {
  return quatro::RunExperimentProgram(argc, argv);
}
