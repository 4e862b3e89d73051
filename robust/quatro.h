// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Quatro: the motion of a vehicle on the ground from matched points, most of
// them wrong,
//
//   q_i = R_z(yaw) p_i + t + noise,                                        (1)
//
// in four stages, each with an answer of its own:
//
//   matches -> largest consistent set (robust/max_clique.h)
//           -> differences of points (robust/tims.h)
//           -> yaw by graduated non-convexity (robust/gnc.h)
//           -> translation axis by axis (solvers/translation.h)
//
// One difference, hence two consistent matches, is enough for a yaw. Roll and
// pitch are left at zero.
//
// The answer depends on the set of matches: neither on their order nor on how
// often one is repeated, bit for bit.
//
// Source: Lim et al., "A Single Correspondence Is Enough: Robust Global
// Registration to Avoid Degeneracy in Urban Environments", ICRA 2022.

#ifndef QUATRO_ROBUST_QUATRO_H_
#define QUATRO_ROBUST_QUATRO_H_

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "features/stopwatch.h"
#include "features/types.h"
#include "robust/consistency_graph.h"
#include "robust/gnc.h"
#include "robust/tims.h"
#include "solvers/rigid3.h"
#include "solvers/yaw.h"

namespace quatro {

enum class Pruning {
  kCliqueHeuristic,  // The paper's MCIS-heuristic.
  kMaxCore,
  kNone,
};

enum class SurrogateType { kTruncatedLeastSquares, kGemanMcClure };

struct QuatroOptions {
  // How far a right match may be off [m].
  double noise_bound = 0.3;

  // A difference of two matches has the noise of both; its bound is this times
  // noise_bound. 1 in the paper.
  double tim_bound_factor = 2.0;

  // Its bound is 2 * noise_bound.
  ConsistencyTest consistency_test = ConsistencyTest::kLength;
  double max_tilt = 0.035;  // [rad], for ConsistencyTest::kPlanarAndHeight.

  Pruning pruning = Pruning::kCliqueHeuristic;

  TimLayout tim_layout = TimLayout::kRing;
  Eigen::Index num_random_tims = 5000;  // For TimLayout::kRandom.

  SurrogateType surrogate = SurrogateType::kTruncatedLeastSquares;
  GncOptions gnc;

  std::uint64_t seed = 0;
  int num_threads = 1;  // 0: all cores. Never changes the answer.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

enum class QuatroTermination {
  kInvalidInput,  // Options out of range or points that are not finite.
  kInsufficient,  // Fewer than two matches hold together: no difference left.
  kDegenerate,    // The differences hold no heading, e.g. all are vertical.
  kSolved,
};

struct QuatroSummary {
  QuatroTermination termination = QuatroTermination::kInvalidInput;
  std::string message = "SolveQuatro was not called.";

  // Set iff termination is kSolved; whether it is right is another question
  // (robust/verdict.h).
  std::optional<Rigid3> target_from_source;

  // Columns of the matches given, in ascending order. Copies of one match are
  // kept or left out together, and count once.
  std::vector<Eigen::Index> consistent;           // After pruning.
  std::vector<Eigen::Index> translation_inliers;  // Of those, within the bound.
  Eigen::Index num_distinct = 0;
  Eigen::Index num_consistent = 0;
  Eigen::Index num_tims = 0;
  Eigen::Index num_rotation_inliers = 0;  // TIMs within their bound.
  Eigen::Index num_translation_inliers = 0;

  GncSummary<YawEstimate> gnc;
  std::vector<StageTime> stage_times;

  bool IsUsable() const { return target_from_source.has_value(); }
};

// Column i of `source` is matched with column i of `target` [m].
QuatroSummary SolveQuatro(const PointsRef& source,
                          const PointsRef& target,
                          const QuatroOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_QUATRO_H_
