// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What the geometry of two aligned scans says about their pose, as numbers
// without thresholds.
//
//   structure overlap  the share of the structure of each scan that overlaps
//                      the other scan (robust/verdict/overlap.h)
//   residual           |n_q . (R p + t - q)| of an overlapping point p and its
//                      nearest point q
//   free space         surfaces in space that the other scan saw to be free
//                      (robust/verdict/free_space.h)
//   weakest share      the least eigenvalue of  1/N sum_i m_i m_i^T,        (1)
//                      with m_i the horizontal part of the i-th overlapping
//                      normal: how well the least observable direction is
//                      constrained. 0 in a corridor, 1/2 if all directions are
//                      constrained alike.
//   rival              another pose at which the scans overlap as well
//                      (robust/verdict/geometric_rival.h)
//   guided matches     of poses that were searched for: the inliers among
//                      matches near the pose (features/guided_matching.h)
//
// Both clouds are level: z is up. All numbers are the same with source and
// target swapped, except for rounding to cells.

#ifndef QUATRO_ROBUST_VERDICT_EVIDENCE_H_
#define QUATRO_ROBUST_VERDICT_EVIDENCE_H_

#include <Eigen/Core>
#include <optional>
#include <string>

#include "features/base/rigid3.h"
#include "robust/verdict/contact.h"
#include "robust/verdict/geometric_rival.h"
#include "robust/verdict/overlap.h"

namespace quatro {

// When points overlap, and how rivals are searched for.
struct EvidenceOptions {
  // A point overlaps if the other scan has a point within this many voxel
  // sizes: the mean of a voxel may be off by about the size of the voxel, and
  // the distance between two means by more.
  double max_distance_in_voxels = 5.0 / 3.0;

  GeometricRivalOptions rival;

  // The distance [m] within which points overlap.
  double MaxDistance(double voxel_size) const {
    return max_distance_in_voxels * voxel_size;
  }

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The numbers of structure points of both clouds. The points of a cloud count
// only if the other cloud is a scan.
struct FreeSpace {
  Eigen::Index num_contradicted = 0;
  Eigen::Index num_overlapping = 0;

  // The share of contradicted points, in [0, 1]; nullopt if none was tested.
  std::optional<double> ContradictedShare() const {
    const Eigen::Index num_tested = num_contradicted + num_overlapping;
    if (num_tested == 0) return std::nullopt;
    return static_cast<double>(num_contradicted) /
           static_cast<double>(num_tested);
  }
};

// Evidence for a pose that was searched for, or estimated after another one was
// not registered.
struct SearchEvidence {
  Eigen::Index num_guided_matches = 0;
  Eigen::Index num_guided_inliers = 0;

  // The log-likelihood ratio of the segments of the scans for the candidate
  // (robust/registration/segment_consensus.h) [nat]; 0 without segments.
  double segment_ratio = 0.0;

  // Whether the pose is from the first search, at rung 1, at the first scale
  // and with the first vertical. The more searches, the more hypotheses were
  // tried.
  bool is_first = true;
};

// The evidence that two clouds give for and against a pose.
struct GeometricEvidence {
  double structure_overlap = 0.0;  // In [0, 1].
  // Median over the overlapping points [voxel sizes]; 0 if there are none.
  double median_residual = 0.0;

  FreeSpace free_space;

  // The eigenvector of (1), in the target's frame, with z = 0 and its larger
  // coordinate > 0.
  Eigen::Vector3d weakest_direction = Eigen::Vector3d::UnitX();
  double weakest_share = 0.0;  // In [0, 1/2].

  GeometricRival rival;
  FreeSpace rival_free_space;  // Evidence against the rival.

  // Only for poses that were searched for (robust/registration/ladder.h).
  std::optional<SearchEvidence> search;

  // How much better the pose is than its rival, in [-1, 1].
  double Distinctness() const { return rival.overlap - rival.rival_overlap; }
};

// `contacts` are those at this pose within options.MaxDistance(voxel_size);
// `voxel_size` is that of the clouds [m]. Returns nullopt if the overlap cannot
// be measured. The result is the same for any `num_threads`.
std::optional<GeometricEvidence> MeasureGeometricEvidence(
    const DescribedCloud& source,
    const DescribedCloud& target,
    const Rigid3& target_from_source,
    const MutualContacts& contacts,
    double voxel_size,
    const EvidenceOptions& options,
    int num_threads);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_EVIDENCE_H_
