// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// RANSAC on matched points: the pose of the lowest cost among the poses of
// minimal samples (robust/estimators/minimal_pose.h),
//
//   R, t = argmin  sum_i min( |q_i - R p_i - t|^2 / b^2, 1 ),              (1)
//
// followed by least squares on its inliers, |q_i - R p_i - t| <= b, until these
// do not change (at most ten times). A refit is kept if it lowers (1). (1) is
// the cost of MSAC, which unlike the number of inliers also ranks poses with
// equal numbers.
//
// If I of N matches are inliers, a sample of m matches has no outlier with
// probability I (I - 1) .. / (N (N - 1) ..), with m factors each. The search
// stops after k samples once the probability that all of them had an outlier is
// at most 1 - confidence,
//
//   ( 1 - prod_{j < m} (I - j) / (N - j) )^k <= 1 - confidence,            (2)
//
// where I is the number of inliers of the best pose so far. Samples that fail
// their edge test also count.
//
// Sample k is a function of the seed and k, over the distinct matches in the
// order of robust/estimators/distinct_matches.h. So the result does not depend
// on the number of threads or on the order and repetition of matches, bit for
// bit. kPointAndNormal takes each match once and then stops. There is no pose
// if no sample gives one with as many inliers as a sample has matches, or if
// the inliers do not constrain it.
//
// Sources: Fischler and Bolles, CACM 1981; Torr and Zisserman, "MLESAC", CVIU
// 2000 (MSAC); Chum, Matas and Kittler, "Locally Optimized RANSAC", DAGM 2003,
// with the shrinking bound of Lebeda, Matas and Chum, BMVC 2012.

#ifndef QUATRO_ROBUST_ESTIMATORS_RANSAC_H_
#define QUATRO_ROBUST_ESTIMATORS_RANSAC_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "features/base/types.h"
#include "robust/estimators/minimal_pose.h"
#include "robust/estimators/pose_summary.h"

namespace quatro {

// The samples, and when enough have been drawn.
struct RansacOptions {
  MinimalPoseOptions minimal;  // Includes the noise bound b, a radius [m].

  std::int64_t max_iterations = 10'000;  // Largest number of samples.
  double confidence = 0.999;  // See (2). 1: stop early only without outliers.

  // Refit every new best pose while the bound shrinks from 3 b to b, and keep
  // the refit if its cost is lower.
  bool local_optimization = true;

  std::uint64_t seed = 0;
  int num_threads = 1;  // 0: all cores. Does not change the result.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The pose, and the counts of the search.
struct RansacSummary : PoseSummary {
  std::int64_t num_iterations = 0;    // Samples drawn.
  std::int64_t num_hypotheses = 0;    // Samples that gave a pose to score.
  std::int64_t num_improvements = 0;  // New best poses.
  bool is_confident = false;          // (2) holds, or each match was a sample.
  double cost = 0.0;                  // (1) at the pose.
};

// Column i of `source` is matched with column i of `target` [m]. kThreePoints
// needs three matches, kTwoPoints two, kPointAndNormal one and `normals`.
RansacSummary SolveRansac(const PointsRef& source,
                          const PointsRef& target,
                          const RansacOptions& options,
                          const MatchedNormals* normals = nullptr);

// The smallest k that satisfies (2). Infinite if there are fewer inliers than
// matches in a sample, or if confidence is 1 and not all matches are inliers.
double NumIterationsFor(double confidence,
                        Eigen::Index num_inliers,
                        Eigen::Index num_matches,
                        int sample_size);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_RANSAC_H_
