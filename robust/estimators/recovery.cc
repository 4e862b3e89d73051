// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/recovery.h"

#include <glog/logging.h>

#include <cmath>
#include <limits>
#include <vector>

#include "robust/estimators/consensus.h"
#include "solvers/closed_form/translation.h"

namespace quatro {
namespace {

Eigen::VectorXd Selected(const Eigen::VectorXd& values,
                         const std::vector<Eigen::Index>& indices) {
  Eigen::VectorXd selected(static_cast<Eigen::Index>(indices.size()));
  Eigen::Index k = 0;
  for (const Eigen::Index i : indices) selected[k++] = values[i];
  return selected;
}

}  // namespace

Rigid3 RecoverTranslation(const PointsRef& source,
                          const PointsRef& target,
                          const Rigid3& target_from_source,
                          double noise_bound) {
  CHECK_EQ(source.cols(), target.cols());
  if (source.cols() == 0) return target_from_source;
  const Points offset = target - target_from_source.rotation * source;
  const auto consensus = [&](int axis,
                             const std::vector<Eigen::Index>& indices) {
    const Eigen::VectorXd values =
        Selected(offset.row(axis).transpose(), indices);
    return EstimateConsensus(
        values, Eigen::VectorXd::Constant(values.size(), noise_bound));
  };
  // The indices whose offset on the axis is within the noise bound of the
  // value.
  const auto near =
      [&](int axis, double value, const std::vector<Eigen::Index>& indices) {
        std::vector<Eigen::Index> kept;
        for (const Eigen::Index i : indices) {
          if (std::abs(offset(axis, i) - value) <= noise_bound)
            kept.push_back(i);
        }
        return kept;
      };
  std::vector<Eigen::Index> all(static_cast<std::size_t>(source.cols()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = static_cast<Eigen::Index>(i);
  }

  std::vector<Rigid3> candidates = {target_from_source};
  const auto add_with_height_for = [&](double x, double y) {
    const auto inliers = near(1, y, near(0, x, all));
    if (const auto z = consensus(2, inliers)) {
      candidates.push_back(
          {target_from_source.rotation, Eigen::Vector3d(x, y, z->value)});
    }
  };
  add_with_height_for(target_from_source.translation.x(),
                      target_from_source.translation.y());
  add_with_height_for(consensus(0, all)->value, consensus(1, all)->value);

  Rigid3 best;
  double least = std::numeric_limits<double>::infinity();
  for (const Rigid3& candidate : candidates) {
    const double cost = ConsensusCost(source, target, candidate, noise_bound);
    if (cost < least) {
      least = cost;
      best = candidate;
    }
  }
  return best;
}

}  // namespace quatro
