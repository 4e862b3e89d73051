// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The answer in plain words: what each stage was given and kept, why it
// stopped, how far the answer can be trusted, and what to change if it cannot.
// Made from the JSON report and from nothing else, so that the two never
// differ.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_EXPLAIN_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_EXPLAIN_H_

#include <string>

#include "experiments/programs/json_report.h"

namespace quatro {

// A line or two per stage, wrapped at 79 columns. `report` is quatro_register's
// or quatro_solve's; stages that were not run are left out.
std::string Explain(const Json& report);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_EXPLAIN_H_
