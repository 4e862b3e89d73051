// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The share of a cloud that shows a surface at a radius, rather than a line:
//
//   share(r) = mean_i [ |N_i| >= 5  and  lambda_2 > lambda_1 / 10 ],
//   N_i = { p_j : |p_j - p_i| <= r },   lambda_1 >= lambda_2 >= lambda_3 of the
//                                       scatter of N_i.
//
// A scan with few beams is dense along its rings and empty between them. If the
// radius does not reach from one ring to the next, the neighbors are on lines,
// which have no normal.

#ifndef QUATRO_FEATURES_SURFACE_SHARE_H_
#define QUATRO_FEATURES_SURFACE_SHARE_H_

#include "features/base/types.h"

namespace quatro {

// The share, in [0, 1], among at most 2000 points spread evenly over the
// indices. `radius` is in meters. Zero if there are no points, or if the cloud
// is wider than 2^20 radii.
double SurfaceShare(const Points& points, double radius);

}  // namespace quatro

#endif  // QUATRO_FEATURES_SURFACE_SHARE_H_
