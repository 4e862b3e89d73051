// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// How long a residual may be by chance. If its n numbers are independent and
// standard normal (whitened), then
//
//   P( |r|^2 <= q ) = p,   q = ChiSquareQuantile(p, n),                     (1)
//
// so sqrt(q) is the bound that a share p of the right ones keep. It depends on
// n: at p = 0.99 it is 2.58 for one number, 3.37 for three, 4.10 for six.

#ifndef QUATRO_ROBUST_GNC_CHI_SQUARE_H_
#define QUATRO_ROBUST_GNC_CHI_SQUARE_H_

namespace quatro {

// The share of chi-squares of n degrees of freedom that are above x >= 0.
double ChiSquareTail(double x, int degrees_of_freedom);

// (1). 0 < probability < 1, degrees_of_freedom >= 1.
double ChiSquareQuantile(double probability, int degrees_of_freedom);

// sqrt of (1): the largest |r| of an inlier.
double ChiSquareBound(double probability, int degrees_of_freedom);

}  // namespace quatro

#endif  // QUATRO_ROBUST_GNC_CHI_SQUARE_H_
