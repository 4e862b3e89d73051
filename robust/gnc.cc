// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/gnc.h"

#include <sstream>

namespace quatro {

bool GncOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (max_num_iterations < 1) {
    problem << "max_num_iterations = " << max_num_iterations
            << ", must be >= 1";
  } else if (!(mu_step > 1.0)) {
    problem << "mu_step = " << mu_step << ", must be > 1";
  } else if (!(binary_weight_tolerance >= 0.0)) {
    problem << "binary_weight_tolerance = " << binary_weight_tolerance
            << ", must be >= 0";
  } else if (!(relative_cost_tolerance >= 0.0)) {
    problem << "relative_cost_tolerance = " << relative_cost_tolerance
            << ", must be >= 0";
  }
  *error = problem.str();
  return error->empty();
}

}  // namespace quatro
