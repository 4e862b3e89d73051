// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/gnc/gnc.h"

#include <cmath>
#include <sstream>

namespace quatro {

bool GncOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (max_num_iterations < 1) {
    problem << "max_num_iterations = " << max_num_iterations
            << ", must be >= 1";
  } else if (!(mu_step > 1.0 && std::isfinite(mu_step))) {
    problem << "mu_step = " << mu_step << ", must be > 1 and finite";
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

std::string DescribeGnc(GncTermination termination,
                        std::size_t num_iterations) {
  const auto after = [&] {
    return std::to_string(num_iterations) + " iterations, then ";
  };
  switch (termination) {
    case GncTermination::kInvalidOptions:
      return "an option is out of range";
    case GncTermination::kUndetermined:
      return after() + "the remaining weights did not determine the estimate";
    case GncTermination::kAllInliers:
      return "all measurements are inliers of the plain fit";
    case GncTermination::kConverged:
      return after() + "the weights were binary or the cost converged";
    case GncTermination::kMaxNumIterations:
      break;
  }
  return after() + "max_num_iterations was reached";
}

}  // namespace quatro
