// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Explains a result in plain words: the input and output of each stage, why it
// stopped, how reliable the pose is, and what to change if it is not. It uses
// only the JSON report, so that the two never differ.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_EXPLAIN_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_EXPLAIN_H_

#include <string>

#include "experiments/programs/json_report.h"

namespace quatro {

// One or two lines per stage, wrapped at 79 columns. `report` comes from
// quatro_register or quatro_solve. Stages that did not run are left out.
std::string Explain(const Json& report);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_EXPLAIN_H_
