// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Whether an answer can be relied on.
//
// A consensus is doubted until chance is ruled out as its cause. Of N matches,
// k agree with the pose, |q_i - (R p_i + t)| <= bound on each axis. Were
// sources and targets matched at random, one match would agree with probability
// p, which is measured on the spot: the share of agreement among the N (N - 1)
// pairings of a source with the target of another. Any two matches could have
// given the pose, so the expected number of poses this good by chance, the
// number of false alarms, is
//
//   NFA = N (N - 1) / 2 * P[ Binomial(N - 2, p) >= k - 2 ].                (1)
//
// Measuring p by re-pairing accounts for what all scenes share: everything lies
// near one plane, dense near the sensor, and crowded on few surfaces.
//
// Source: Desolneux, Moisan and Morel, "From Gestalt Theory to Image Analysis",
// 2008; Moisan and Stival, "A Probabilistic Criterion to Detect Rigid Point
// Matches Between Two Images and Estimate the Fundamental Matrix", IJCV 2004.

#ifndef QUATRO_ROBUST_VERDICT_H_
#define QUATRO_ROBUST_VERDICT_H_

#include <Eigen/Core>
#include <optional>
#include <string>

#include "features/types.h"
#include "robust/evidence.h"
#include "robust/pose_summary.h"
#include "solvers/rigid3.h"

namespace quatro {

enum class Status {
  kRegistered,    // There is an answer and chance is ruled out.
  kAmbiguous,     // There is an answer that chance could have given as well.
  kDegenerate,    // The consistent matches do not hold the pose.
  kInsufficient,  // There are too few consistent matches to try.
};

// "registered", "ambiguous", "degenerate" or "insufficient".
const char* StatusName(Status status);

struct VerdictOptions {
  // Registered iff log10 of (1) is no larger: -3 stands for one accident in a
  // thousand problems.
  double max_log10_false_alarms = -3.0;

  // And, where clouds are at hand, if at least this share of their structure
  // is met (robust/overlap.h, which says what was seen of right and wrong).
  double min_structure_overlap = 0.25;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

struct Verdict {
  Status status = Status::kInsufficient;
  std::string reason = "no registration was tried";

  Eigen::Index num_matches = 0;      // N, copies counted once.
  Eigen::Index num_agreeing = 0;     // k
  double chance_of_agreement = 0.0;  // p
  double log10_false_alarms = 0.0;   // log10 of (1); 0 where there is no pose.
  std::optional<double> structure_overlap;    // robust/overlap.h.
  std::optional<GeometricEvidence> geometry;  // Where clouds are at hand.

  bool IsRegistered() const { return status == Status::kRegistered; }
};

// The verdict on a pose found from these matches; `noise_bound` [m].
Verdict JudgeConsensus(const PointsRef& source,
                       const PointsRef& target,
                       const Rigid3& target_from_source,
                       double noise_bound,
                       const VerdictOptions& options);

// The same for what an estimator reports, also without an answer.
Verdict JudgeSummary(const PointsRef& source,
                     const PointsRef& target,
                     const PoseSummary& summary,
                     double noise_bound,
                     const VerdictOptions& options);

// Takes the geometric evidence into a verdict: too small an overlap turns
// registered into ambiguous. No overlap to speak of changes nothing.
void AddOverlap(const std::optional<double>& structure_overlap,
                const VerdictOptions& options,
                Verdict* verdict);

// log10 P[ Binomial(n, p) >= k ].
double Log10BinomialTail(Eigen::Index n, Eigen::Index k, double p);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_H_
