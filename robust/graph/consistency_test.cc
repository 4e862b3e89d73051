// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/graph/consistency_test.h"

#include <cmath>
#include <sstream>

namespace quatro {

bool ConsistencyOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(bound > 0.0)) {
    problem << "consistency.bound = " << bound << ", must be > 0";
  } else if (!(max_tilt >= 0.0 && max_tilt <= M_PI / 2)) {
    problem << "consistency.max_tilt = " << max_tilt
            << ", must be in [0, pi/2]";
  }
  *error = problem.str();
  return error->empty();
}

}  // namespace quatro
