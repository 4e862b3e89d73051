// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// How two points with normals stand to each other. With (p_s, n_s) the one
// whose normal is closer to the line between them, d = (p_t - p_s) / |p_t -
// p_s|, v = d x n_s / |d x n_s|, w = n_s x v:
//
//   f = ( atan2(w . n_t, n_s . n_t) / pi,   v . n_t,   n_s . d )           (1)
//
// each in [-1, 1], into 11 bins each. Where both normals are equally close, as
// parallel ones, (p_s, n_s) is the one of greater n_s . d.
//
// Many pairs at once are taken in single precision, and the angle's bin by the
// side of its edges that it is on: on two real scans no bin was another than by
// ComputePairFeature().
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

// Equation (1) for one pair, the same whichever point comes first. Nullopt for
// coincident points and for a line along the normal (within 1e-4 rad).
std::optional<Eigen::Vector3f> ComputePairFeature(const Eigen::Vector3f& p1,
                                                  const Eigen::Vector3f& n1,
                                                  const Eigen::Vector3f& p2,
                                                  const Eigen::Vector3f& n2);

// A point in single precision. One without a normal is nowhere.
struct OrientedPoint {
  float x, y, z;  // x is not a number of one that is nowhere.
  float nx, ny, nz;

  // Whether it can be of a pair.
  bool HasNormal() const { return x == x; }
};

// The bins of a pair in one number, four bits a part. What has no feature is in
// a bin past the others, the same in each part: a line along the normal, and
// what is no pair, points at one place or one without a normal.
struct PairBins {
  static constexpr std::int32_t kAlongNormal = 14;
  static constexpr std::int32_t kNoPair = 15;

  std::int32_t bits;

  // The bin of part k of (1), in [0, 11), or one of those above.
  std::int32_t part(int k) const { return bits >> (4 * k) & 15; }
};

// Of one point and several others.
class PairBinner {
 public:
  // In the order of `index`, which is into `points`. Valid until the next call.
  std::span<const PairBins> FindBins(const OrientedPoint& own,
                                     const std::vector<OrientedPoint>& points,
                                     std::span<const std::int32_t> index);

 private:
  // The others, coordinate by coordinate.
  std::vector<float> x_, y_, z_, nx_, ny_, nz_;
  std::vector<PairBins> bins_;
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_PAIR_FEATURE_H_
