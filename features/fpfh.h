// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Fast point feature histograms describe the shape of the surface around a
// point.
//
// SPFH(p) is the histogram of the features (1) of the pairs of p and its
// neighbors (features/pair_feature.h). It has three parts of 11 bins, and each
// part sums to 1. Then
//
//   FPFH(p) = SPFH(p) + 1/k sum_j SPFH(p_j) / |p_j - p|,                    (2)
//
// over the k neighbors p_j != p that have a normal. Each part is scaled to sum
// to 100.
//
// Source: Rusu, Blodow and Beetz, "Fast Point Feature Histograms (FPFH) for 3D
// Registration", ICRA 2009. The weight is the inverse distance, as in the
// paper. PCL and Open3D use the inverse squared distance, and PCL omits
// SPFH(p).

#ifndef QUATRO_FEATURES_FPFH_H_
#define QUATRO_FEATURES_FPFH_H_

#include <Eigen/Core>

#include "features/base/types.h"
#include "features/neighborhoods.h"
#include "features/pair_feature.h"

namespace quatro {

constexpr int kFpfhSize = 3 * kFpfhBinsPerPart;

// One descriptor per column.
using Fpfh = Eigen::Matrix<float, kFpfhSize, Eigen::Dynamic>;

// `points` [m] and `normals` are 3xN; a point without a normal has a zero
// normal. `neighborhoods` are those of `points` at the FPFH radius: indices
// ascend, and if j is in the row of i, then i is in the row of j. A column is
// zero if its point has no normal or no neighbor with a normal.
Fpfh ComputeFpfh(const PointsRef& points,
                 const PointsRef& normals,
                 const Neighborhoods& neighborhoods,
                 int num_threads);

}  // namespace quatro

#endif  // QUATRO_FEATURES_FPFH_H_
