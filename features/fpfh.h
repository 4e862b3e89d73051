// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Fast point feature histograms: how the surface bends around each point.
//
// Of a pair of points with normals, with (p_s, n_s) the one whose normal is
// closer to the line between them, d = (p_t - p_s) / |p_t - p_s|,
// v = d x n_s / |d x n_s|, w = n_s x v:
//
//   f = ( atan2(w . n_t, n_s . n_t) / pi,   v . n_t,   n_s . d )           (1)
//
// each in [-1, 1], into 11 bins each. Where both normals are equally close, as
// parallel ones, (p_s, n_s) is the one of greater n_s . d. SPFH(p) is the
// histogram of (1) over the pairs of p with its neighbours, each part summing
// to 1, and
//
//   FPFH(p) = SPFH(p) + 1/k sum_j SPFH(p_j) / |p_j - p|,                    (2)
//
// each part of 11 bins then scaled to sum to 100.
//
// Pairs are taken in single precision, and the angle's bin by the side of its
// edges that it is on: on two real scans no bin was another than by
// ComputePairFeature(), and descriptors differed by less than 1e-4.
//
// Source: Rusu, Blodow and Beetz, "Fast Point Feature Histograms (FPFH) for 3D
// Registration", ICRA 2009. (The weight is by distance as there; PCL and Open3D
// divide by its square, and PCL leaves out SPFH(p).)

#ifndef QUATRO_FEATURES_FPFH_H_
#define QUATRO_FEATURES_FPFH_H_

#include <Eigen/Core>
#include <optional>

#include "features/kd_tree.h"
#include "features/types.h"

namespace quatro {

constexpr int kFpfhBinsPerPart = 11;
constexpr int kFpfhSize = 3 * kFpfhBinsPerPart;

// One descriptor per column.
using Fpfh = Eigen::Matrix<float, kFpfhSize, Eigen::Dynamic>;

// `neighborhoods` are those of `points` at the FPFH radius. A column is zero
// where the point has no normal or no neighbour with one.
Fpfh ComputeFpfh(const PointsRef& points,
                 const PointsRef& normals,
                 const Neighborhoods& neighborhoods,
                 int num_threads);

// Equation (1) for one pair, the same whichever point comes first. Nullopt for
// coincident points and for a line along the normal (within 1e-4 rad).
std::optional<Eigen::Vector3f> ComputePairFeature(const Eigen::Vector3f& p1,
                                                  const Eigen::Vector3f& n1,
                                                  const Eigen::Vector3f& p2,
                                                  const Eigen::Vector3f& n2);

}  // namespace quatro

#endif  // QUATRO_FEATURES_FPFH_H_
