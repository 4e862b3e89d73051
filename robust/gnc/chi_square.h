// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The chi-square bound on the norm of a residual. If its n entries are
// independent and standard normal (whitened), then
//
//   P( |r|^2 <= q ) = p,   q = ChiSquareQuantile(p, n),                     (1)
//
// so a share p of the inliers has |r| <= sqrt(q). For p = 0.99 the bound
// sqrt(q) is 2.58 for n = 1, 3.37 for n = 3 and 4.10 for n = 6.

#ifndef QUATRO_ROBUST_GNC_CHI_SQUARE_H_
#define QUATRO_ROBUST_GNC_CHI_SQUARE_H_

namespace quatro {

// q of equation (1). Requires 0 < probability < 1 and degrees_of_freedom >= 1.
double ChiSquareQuantile(double probability, int degrees_of_freedom);

// sqrt(q) of equation (1): the largest |r| of an inlier.
double ChiSquareBound(double probability, int degrees_of_freedom);

}  // namespace quatro

#endif  // QUATRO_ROBUST_GNC_CHI_SQUARE_H_
