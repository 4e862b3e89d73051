// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Where two aligned scans touch: of each point p of one the nearest of the
// other,
//
//   argmin_q |R p + t - q|,   if that is no more than max_distance.

#ifndef QUATRO_ROBUST_VERDICT_CONTACT_H_
#define QUATRO_ROBUST_VERDICT_CONTACT_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "features/base/rigid3.h"
#include "robust/verdict/structure.h"

namespace quatro {

// Of each point of a the index of b's nearest, or kNoContact; none for points
// without a normal.
constexpr std::int32_t kNoContact = -1;
using Contacts = std::vector<std::int32_t>;

// At one pose, of a's points in b.
Contacts FindContacts(const DescribedCloud& a,
                      const DescribedCloud& b,
                      const Rigid3& b_from_a,
                      double max_distance,
                      int num_threads);

// At one pose, of either scan in the other.
struct MutualContacts {
  Contacts of_source;
  Contacts of_target;
};
MutualContacts FindMutualContacts(const DescribedCloud& source,
                                  const DescribedCloud& target,
                                  const Rigid3& target_from_source,
                                  double max_distance,
                                  int num_threads);

// Whether the normals of two points in contact, in one frame, are within 37 deg
// of each other or of opposites.
bool AreNormalsAligned(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_CONTACT_H_
