// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/gnc/chi_square.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

namespace quatro {

double ChiSquareQuantile(double probability, int degrees_of_freedom) {
  const boost::math::chi_squared distribution(degrees_of_freedom);
  return boost::math::quantile(distribution, probability);
}

double ChiSquareBound(double probability, int degrees_of_freedom) {
  return std::sqrt(ChiSquareQuantile(probability, degrees_of_freedom));
}

}  // namespace quatro
