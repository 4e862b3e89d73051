// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What the geometry of two aligned scans says of their pose, as numbers without
// thresholds.
//
//   met structure     robust/verdict/overlap.h: how much of what stands is met
//   residual          |n_q . (R p + t - q)| of a met p and its nearest q
//   free space        robust/verdict/free_space.h: surfaces where a beam passed
//   weakest share     least eigenvalue of  1/N sum_i m_i m_i^T,             (1)
//                     m_i the horizontal part of the i-th met normal: what
//                     holds the pose along the weakest direction, 0 in a
//                     corridor and 1/2 where all directions are held alike
//   rival             robust/verdict/geometric_rival.h: where it would fit as
//   well
//
// All are the same with source and target swapped, but for rounding to cells.

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

// From how near on a point is met, and where rivals are looked for.
struct EvidenceOptions {
  double voxel_size = 0.3;  // Of the clouds [m].

  // A voxel's mean may be off by about its size; two of them by more.
  double max_distance_in_voxels = 5.0 / 3.0;

  GeometricRivalOptions rival;

  // The same [m].
  double MaxDistance() const { return max_distance_in_voxels * voxel_size; }

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Structure of either scan, in the ways in which the other is a scan.
struct FreeSpace {
  Eigen::Index num_contradicted = 0;
  Eigen::Index num_overlapping = 0;

  // Contradicted of both, in [0, 1]. Nullopt if nothing was tested.
  std::optional<double> ContradictedShare() const {
    const Eigen::Index num_tested = num_contradicted + num_overlapping;
    if (num_tested == 0) return std::nullopt;
    return static_cast<double>(num_contradicted) /
           static_cast<double>(num_tested);
  }
};

// What the clouds say for and against a pose.
struct GeometricEvidence {
  double structure_overlap = 0.0;  // In [0, 1].
  double median_residual = 0.0;    // Of met points [voxel sizes]; 0 if none.

  FreeSpace free_space;

  // Of equation (1), in the target's frame, z = 0 and its larger part > 0.
  Eigen::Vector3d weakest_direction = Eigen::Vector3d::UnitX();
  double weakest_share = 0.0;  // In [0, 1/2].

  GeometricRival rival;
  FreeSpace rival_free_space;  // A rival that is contradicted is none.

  // How much better the pose is than its rival, in [-1, 1].
  double Distinctness() const { return rival.overlap - rival.rival_overlap; }
};

// Nullopt where the overlap is. The answer is the same for any `num_threads`.
std::optional<GeometricEvidence> MeasureGeometricEvidence(
    const SurfaceCloud& source,
    const SurfaceCloud& target,
    const Rigid3& target_from_source,
    const EvidenceOptions& options,
    int num_threads);

// The same with the contacts at the pose at hand, within MaxDistance().
std::optional<GeometricEvidence> MeasureGeometricEvidence(
    const SurfaceCloud& source,
    const SurfaceCloud& target,
    const Rigid3& target_from_source,
    const MutualContacts& contacts,
    const EvidenceOptions& options,
    int num_threads);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_EVIDENCE_H_
