// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/gnc/ceres_gnc_options.h"

#include <cmath>
#include <sstream>

namespace quatro {
namespace {

bool IsPositive(double x) { return x > 0.0 && std::isfinite(x); }

}  // namespace

bool CeresGncOptions::IsValid(std::string* error) const {
  if (!gnc.IsValid(error) || !solver.IsValid(error)) return false;
  if (plain_fit && !plain_fit->IsValid(error)) return false;
  if (loose && !loose->IsValid(error)) return false;
  std::ostringstream problem;
  if (!(inlier_probability > 0.0 && inlier_probability < 1.0)) {
    problem << "inlier_probability = " << inlier_probability
            << ", must be > 0 and < 1";
  } else if (bound && !IsPositive(*bound)) {
    problem << "bound = " << *bound << ", must be > 0 and finite";
  }
  for (const auto& [id, block_bound] : bounds) {
    if (IsPositive(block_bound)) continue;
    problem.str("");
    problem << "bounds contains " << block_bound << ", must be > 0 and finite";
  }
  *error = problem.str();
  return error->empty();
}

}  // namespace quatro
