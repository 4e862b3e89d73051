// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "features/base/parallel.h"
#include "features/nearest_within.h"

namespace quatro {
namespace {

constexpr double kMinNormalCosine = 0.8;

static_assert(kNoContact == kNoneWithin);

}  // namespace

bool AreNormalsAligned(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::abs(a.dot(b)) > kMinNormalCosine;
}

Contacts FindContacts(const DescribedCloud& a,
                      const DescribedCloud& b,
                      const Rigid3& b_from_a,
                      double max_distance,
                      int num_threads) {
  // Points without a normal become NaN, which has no contact.
  const Points& points = a.points();
  Points places(3, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (a.normals.col(i).isZero(0.0)) {
      places.col(i).setConstant(std::numeric_limits<double>::quiet_NaN());
    } else {
      places.col(i) = b_from_a * Eigen::Vector3d(points.col(i));
    }
  }
  return FindNearestWithin(*b.tree, places, max_distance, num_threads);
}

MutualContacts FindMutualContacts(const DescribedCloud& source,
                                  const DescribedCloud& target,
                                  const Rigid3& target_from_source,
                                  double max_distance,
                                  int num_threads) {
  MutualContacts contacts;
  // The two searches run in parallel, so that their serial parts overlap.
  const int num_threads_each = std::max(1, NumThreadsToUse(num_threads) / 2);
  ParallelDo(
      num_threads,
      [&] {
        contacts.of_source = FindContacts(
            source, target, target_from_source, max_distance, num_threads_each);
      },
      [&] {
        contacts.of_target = FindContacts(target,
                                          source,
                                          Inverse(target_from_source),
                                          max_distance,
                                          num_threads_each);
      });
  return contacts;
}

}  // namespace quatro
