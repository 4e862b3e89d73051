// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/contact.h"

#include <cmath>

#include "features/parallel.h"

namespace quatro {
namespace {

constexpr double kMinNormalCosine = 0.8;

}  // namespace

bool NormalsAgree(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::abs(a.dot(b)) > kMinNormalCosine;
}

Contacts FindContacts(const SurfaceCloud& a,
                      const SurfaceCloud& b,
                      const Rigid3& b_from_a,
                      double max_distance,
                      int num_threads) {
  const Points& points = a.tree.points();
  Contacts contacts(static_cast<std::size_t>(points.cols()), kNoContact);
  const auto look = [&](Eigen::Index begin, Eigen::Index end) {
    for (Eigen::Index i = begin; i < end; ++i) {
      if (a.normals.col(i).isZero(0.0)) continue;
      const auto nearest = b.tree.NearestWithin(
          b_from_a * Eigen::Vector3d(points.col(i)), max_distance);
      if (!nearest) continue;
      contacts[static_cast<std::size_t>(i)] =
          static_cast<std::int32_t>(nearest->index);
    }
  };
  ParallelFor(num_threads, points.cols(), 512, look);
  return contacts;
}

MutualContacts FindMutualContacts(const SurfaceCloud& source,
                                  const SurfaceCloud& target,
                                  const Rigid3& target_from_source,
                                  double max_distance,
                                  int num_threads) {
  return {FindContacts(
              source, target, target_from_source, max_distance, num_threads),
          FindContacts(target,
                       source,
                       Inverse(target_from_source),
                       max_distance,
                       num_threads)};
}

}  // namespace quatro
