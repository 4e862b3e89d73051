// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Proposes many poses and lets the geometry of both scans choose among them:
//
//   matches -> consensus search (robust/estimators/consensus_search.h), once
//              with the given vertical and, if the walls of either scan are
//              inclined against it, once with the vertical of the walls
//              (robust/registration/vertical.h); and the poses of cliques
//              (robust/registration/clique_proposals.h)
// scans   -> walls, poles and clusters, and the poses on which many of these
//              agree (robust/registration/segment_consensus.h)
//           -> geometric score of each proposal, the best are kept
//           -> VG-ICP in SE(3) from each of these (solvers/local/vgicp.h)
//           -> geometric score again: candidates, the best first
//
// If the scans are far apart, one match in a hundred is correct, and chance
// produces a consensus as large as that of the correct pose. The overlap of
// structure distinguishes the two. Candidates are ordered by
//
//   score(T) * sqrt(log-likelihood ratio),                                 (1)
//
// where the second factor is about the number of standard deviations by which
// the consensus of the matches and of the segments exceeds chance.

#ifndef QUATRO_ROBUST_REGISTRATION_POSE_SEARCH_H_
#define QUATRO_ROBUST_REGISTRATION_POSE_SEARCH_H_

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "features/described_cloud.h"
#include "robust/estimators/consensus_search.h"
#include "robust/estimators/pose_bounds.h"
#include "robust/estimators/proposal.h"
#include "robust/registration/segment_consensus.h"
#include "robust/verdict/geometric_score.h"
#include "solvers/local/local_alignment.h"

namespace quatro {

// How far the search goes.
struct PoseSearchOptions {
  // The rungs above the estimator's own pose that are tried until a pose is
  // registered (robust/registration/ladder.h), in [0, 3].
  int max_rung = 3;

  // Register() multiplies all lengths by each of these factors in turn
  // (ScaledBy() in robust/registration/options.h) and tries all rungs, until a
  // pose is registered. RegisterMatched() ignores them, because its matches
  // have one scale.
  std::vector<double> scale_factors = {1.0};

  // Whether no other lengths and no other verticals were tried before. Set by
  // Register() and RegisterByAnyVertical().
  bool is_first_try = true;

  // Whether a candidate may turn a scan upside down, because the verticals were
  // found and not stated. Set by RegisterByAnyVertical().
  bool allows_upside_down = false;

  // No rung or scale is started after this time [s]. If it is finite, the
  // result depends on the speed of the machine.
  double time_limit_seconds = std::numeric_limits<double>::infinity();

  int max_num_proposals = 128;
  int num_aligned = 16;  // Proposals from which VG-ICP starts.

  // The tilt between the scans that the consensus search allows for [rad].
  double max_tilt = 0.1;

  // The largest residual of an inlier of a candidate, in noise bounds.
  double bound_factor = 2.0;

  // The sources of proposals that are used. If `segments` is set, the walls,
  // poles and clusters of the scans also support the other proposals.
  bool consensus = true;
  bool cliques = true;
  bool segments = true;

  // Whether the geometry chooses among the proposals. If not, the order is that
  // of the log-likelihood ratio.
  bool geometric_choice = true;

  // Whether the clouds are matched again near a candidate
  // (features/guided_matching.h), for the covariance and the verdict.
  bool guided_matching = true;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// A candidate pose, its origin, and the evidence for it.
struct PoseCandidate {
  Rigid3 target_from_source;
  std::string origin;  // The rung and the vertical of its proposal.

  // The sum of that of the matches and that of the segments [nat].
  double log_likelihood_ratio = 0.0;
  GeometricScore geometry;

  // (1)
  double Score() const;
};

// The search between two scans, whose grids are built once. The clouds must
// outlive the search; z is up. Points within `max_distance` overlap;
// `voxel_size` is that of the clouds and `noise_bound` that of the matches, all
// in [m].
class PoseSearch {
 public:
  // Builds the grids and the voxels of VG-ICP.
  PoseSearch(const DescribedCloud& source,
             const DescribedCloud& target,
             double max_distance,
             double voxel_size,
             double noise_bound,
             const PoseSearchOptions& options,
             int num_threads);
  ~PoseSearch();

  // The candidates within the bounds, the best first, no two alike, from the
  // consensus search and from `more` poses. Column i of `matched_source` is
  // matched with column i of `matched_target` [m].
  std::vector<PoseCandidate> Find(const PointsRef& matched_source,
                                  const PointsRef& matched_target,
                                  const std::string& origin,
                                  const std::vector<ProposedPose>& more,
                                  const PoseBounds& bounds) const;

  // Finds the segments of the scans. From now on, Find() uses them.
  void UseSegments();

  // The pose aligned with the clouds by VG-ICP in SE(3), starting from any
  // pose.
  Rigid3 Align(const Rigid3& target_from_source) const;

  // How well the segments support any pose, by
  // robust/registration/segment_consensus.h [nat]; 0 without UseSegments().
  double SegmentRatio(const Rigid3& target_from_source) const;

  // The score of any pose.
  GeometricScore ScoreOf(const Rigid3& target_from_source) const {
    return scorer_.At(target_from_source);
  }

 private:
  struct Aligner;

  // Find() on matches that can be inliers within the bounds.
  std::vector<PoseCandidate> FindAmong(const PointsRef& matched_source,
                                       const PointsRef& matched_target,
                                       const std::string& origin,
                                       const std::vector<ProposedPose>& more,
                                       const PoseBounds& bounds) const;

  // Rotations from the clouds to frames whose z is up.
  struct Level {
    Eigen::Matrix3d from_source = Eigen::Matrix3d::Identity();
    Eigen::Matrix3d from_target = Eigen::Matrix3d::Identity();
    std::string origin;  // How z was found.
  };

  // The consensus search in level frames, without matches.
  ConsensusSearchOptions ConsensusOptions(const Level& level) const;

  // Adds the proposals of the matches in level frames.
  void Propose(const PointsRef& matched_source,
               const PointsRef& matched_target,
               const std::string& origin,
               const Level& level,
               std::vector<PoseCandidate>* candidates) const;

  // The poses of the segments, in the frames of the clouds.
  std::vector<ProposedPose> SegmentPoses() const;

  const DescribedCloud& source_;
  const DescribedCloud& target_;
  double voxel_size_;
  double noise_bound_;
  PoseSearchOptions options_;
  int num_threads_;
  GeometricScorer scorer_;
  std::unique_ptr<Aligner> aligner_;

  // The frames with the given vertical and, if the walls of a scan are inclined
  // against it, those with the vertical of the walls.
  std::vector<Level> levels_;

  // In each of these frames, relative to the sensors. Empty without
  // UseSegments().
  std::vector<SegmentConsensus> segments_;
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_POSE_SEARCH_H_
