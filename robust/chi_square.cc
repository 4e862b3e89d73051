// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/chi_square.h"

#include <glog/logging.h>

#include <cmath>

#include "robust/log_gamma.h"

namespace quatro {

// For whole n the tail is a finite sum of positive terms, with h = x / 2,
//
//   n even:  sum_{0 <= k < n/2}  e^-h h^k / Gamma(k + 1),
//   n odd:   erfc(sqrt h) + the same over k = 1/2, 3/2, ... < n/2.
double ChiSquareTail(double x, int degrees_of_freedom) {
  CHECK_GE(degrees_of_freedom, 1);
  CHECK_GE(x, 0.0);
  if (x == 0.0) return 1.0;
  const double h = 0.5 * x;
  const bool is_odd = degrees_of_freedom % 2 == 1;
  double tail = is_odd ? std::erfc(std::sqrt(h)) : 0.0;
  for (int i = 0; i < degrees_of_freedom / 2; ++i) {
    const double k = is_odd ? i + 0.5 : i;
    tail += std::exp(k * std::log(h) - h - LogGamma(k + 1.0));
  }
  return tail;
}

double ChiSquareQuantile(double probability, int degrees_of_freedom) {
  CHECK_GT(probability, 0.0);
  CHECK_LT(probability, 1.0);
  const double tail = 1.0 - probability;
  double lower = 0.0;
  double upper = degrees_of_freedom;
  while (ChiSquareTail(upper, degrees_of_freedom) > tail) {
    lower = upper;
    upper *= 2.0;
  }
  // The tail falls; halve until the two are neighbours.
  while (true) {
    const double middle = 0.5 * (lower + upper);
    if (middle <= lower || middle >= upper) return upper;
    if (ChiSquareTail(middle, degrees_of_freedom) > tail) {
      lower = middle;
    } else {
      upper = middle;
    }
  }
}

double ChiSquareBound(double probability, int degrees_of_freedom) {
  return std::sqrt(ChiSquareQuantile(probability, degrees_of_freedom));
}

}  // namespace quatro
