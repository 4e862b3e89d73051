// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Contacts of two aligned scans: for each point p of one scan the nearest point
// of the other,
//
//   argmin_q |R p + t - q|,   if its distance is at most max_distance.

#ifndef QUATRO_ROBUST_VERDICT_CONTACT_H_
#define QUATRO_ROBUST_VERDICT_CONTACT_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "features/base/rigid3.h"
#include "robust/verdict/structure.h"

namespace quatro {

// For each point of a, the index of the nearest point of b, or kNoContact.
// Points without a normal have no contact.
constexpr std::int32_t kNoContact = -1;
using Contacts = std::vector<std::int32_t>;

// Finds the contacts of a's points in b at one pose. `max_distance` is in [m].
Contacts FindContacts(const DescribedCloud& a,
                      const DescribedCloud& b,
                      const Rigid3& b_from_a,
                      double max_distance,
                      int num_threads);

// The contacts of each scan in the other at one pose.
struct MutualContacts {
  Contacts of_source;
  Contacts of_target;
};
MutualContacts FindMutualContacts(const DescribedCloud& source,
                                  const DescribedCloud& target,
                                  const Rigid3& target_from_source,
                                  double max_distance,
                                  int num_threads);

// Whether two normals, in one frame, are parallel or antiparallel up to 37 deg.
bool AreNormalsAligned(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_CONTACT_H_
