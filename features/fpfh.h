// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Fast point feature histograms: how the surface bends around each point.
//
// SPFH(p) is the histogram of the features of its pairs with its neighbours
// (features/pair_feature.h), each of three parts of 11 bins summing to 1, and
//
//   FPFH(p) = SPFH(p) + 1/k sum_j SPFH(p_j) / |p_j - p|,                    (2)
//
// each part then scaled to sum to 100.
//
// Source: Rusu, Blodow and Beetz, "Fast Point Feature Histograms (FPFH) for 3D
// Registration", ICRA 2009. (The weight is by distance as there; PCL and Open3D
// divide by its square, and PCL leaves out SPFH(p).)

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

// `neighborhoods` are those of `points` at the FPFH radius, indices ascending,
// each point in the row of its neighbours. A column is zero
// where the point has no normal or no neighbour with one.
Fpfh ComputeFpfh(const PointsRef& points,
                 const PointsRef& normals,
                 const Neighborhoods& neighborhoods,
                 int num_threads);

}  // namespace quatro

#endif  // QUATRO_FEATURES_FPFH_H_
