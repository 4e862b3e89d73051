// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The relative geometry of two points with normals. Let (p_s, n_s) be the point
// whose normal is closer to the line between the two, d = (p_t - p_s) / |p_t -
// p_s|, v = d x n_s / |d x n_s| and w = n_s x v. The feature is
//
//   f = ( atan2(w . n_t, n_s . n_t) / pi,   v . n_t,   n_s . d )           (1)
//
// Each component is in [-1, 1] and is sorted into 11 bins. If both normals are
// equally close to the line, for example because they are parallel, (p_s, n_s)
// is the point with the greater n_s . d.
//
// PairBinner computes many pairs at once in single precision. It finds the bin
// of the angle by comparing with the edges of the bins. On two real scans, all
// its bins were those of ComputePairFeature().
//
// Source: Rusu, Blodow and Beetz, "Fast Point Feature Histograms (FPFH) for 3D
// Registration", ICRA 2009.

#ifndef QUATRO_FEATURES_PAIR_FEATURE_H_
#define QUATRO_FEATURES_PAIR_FEATURE_H_

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace quatro {

constexpr int kFpfhBinsPerPart = 11;

// Equation (1) for one pair, in either order. Returns nullopt if the points
// coincide, or if the line between them is along the normal (within 1e-4 rad).
std::optional<Eigen::Vector3f> ComputePairFeature(const Eigen::Vector3f& p1,
                                                  const Eigen::Vector3f& n1,
                                                  const Eigen::Vector3f& p2,
                                                  const Eigen::Vector3f& n2);

// A point with a normal, in single precision. If it has no normal, x is NaN.
struct OrientedPoint {
  float x, y, z;
  float nx, ny, nz;

  // Whether the point has a normal, and so can be part of a pair.
  bool HasNormal() const { return x == x; }
};

// The bins of a pair packed into one number, four bits per part. If a pair has
// no feature, all parts are kAlongNormal (the line between the points is along
// the normal) or kNoPair (the points coincide, or one has no normal).
struct PairBins {
  static constexpr std::int32_t kAlongNormal = 14;
  static constexpr std::int32_t kNoPair = 15;

  std::int32_t bits;

  // The bin of part k of (1), in [0, 11), or one of the constants above.
  std::int32_t part(int k) const { return bits >> (4 * k) & 15; }
};

// Finds the bins of one point paired with several others.
class PairBinner {
 public:
  // The bins of `own` paired with points[i] for each i of `index`, in that
  // order. The span is valid until the next call.
  std::span<const PairBins> FindBins(const OrientedPoint& own,
                                     const std::vector<OrientedPoint>& points,
                                     std::span<const std::int32_t> index);

 private:
  // The other points, one array per coordinate.
  std::vector<float> x_, y_, z_, nx_, ny_, nz_;
  std::vector<PairBins> bins_;
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_PAIR_FEATURE_H_
