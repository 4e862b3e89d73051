// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/metrics/kitti_metrics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "features/base/degree.h"

namespace quatro {
namespace {

// Equation (1).
Rigid3 RelativeError(const std::vector<Rigid3>& truth,
                     const std::vector<Rigid3>& estimate,
                     std::size_t first,
                     std::size_t last) {
  return Inverse(Inverse(estimate[first]) * estimate[last]) *
         (Inverse(truth[first]) * truth[last]);
}

double Angle(const Rigid3& error) {
  return AngleBetween(Eigen::Matrix3d::Identity(), error.rotation);
}

std::vector<double> PathLengths(const std::vector<Rigid3>& poses) {
  std::vector<double> lengths = {0.0};
  for (std::size_t i = 1; i < poses.size(); ++i) {
    lengths.push_back(lengths.back() +
                      (poses[i].translation - poses[i - 1].translation).norm());
  }
  return lengths;
}

}  // namespace

bool KittiDriftOptions::IsValid(std::string* error) const {
  error->clear();
  if (step < 1) {
    *error = "step = " + std::to_string(step) + ", must be >= 1";
  } else if (lengths.empty() ||
             !std::all_of(lengths.begin(), lengths.end(), [](double length) {
               return length > 0.0 && std::isfinite(length);
             })) {
    *error = "lengths must be a nonempty list of finite numbers > 0";
  }
  return error->empty();
}

std::optional<KittiDrift> ComputeKittiDrift(
    const std::vector<Rigid3>& true_poses,
    const std::vector<Rigid3>& estimated_poses,
    const KittiDriftOptions& options,
    std::string* error) {
  if (!options.IsValid(error)) return std::nullopt;
  if (true_poses.empty() || true_poses.size() != estimated_poses.size()) {
    *error = std::to_string(true_poses.size()) + " true poses and " +
             std::to_string(estimated_poses.size()) +
             " estimated poses; the numbers must be equal and > 0";
    return std::nullopt;
  }
  const std::vector<double> path = PathLengths(true_poses);
  KittiDrift drift;
  double translation_sum = 0.0;
  double rotation_sum = 0.0;
  for (std::size_t first = 0; first < true_poses.size();
       first += static_cast<std::size_t>(options.step)) {
    for (const double length : options.lengths) {
      const auto end =
          std::upper_bound(path.begin() + static_cast<std::ptrdiff_t>(first),
                           path.end(),
                           path[first] + length);
      if (end == path.end()) continue;
      const auto last = static_cast<std::size_t>(end - path.begin());
      const Rigid3 relative =
          RelativeError(true_poses, estimated_poses, first, last);
      drift.segments.push_back({first,
                                last,
                                length,
                                relative.translation.norm() / length,
                                Angle(relative) / length});
      translation_sum += drift.segments.back().translation_error;
      rotation_sum += drift.segments.back().rotation_error;
    }
  }
  // 0 / 0 is NaN, as intended.
  const auto n = static_cast<double>(drift.segments.size());
  drift.translation_percent = 100.0 * translation_sum / n;
  drift.rotation_deg_per_100m = 100.0 * rotation_sum / n / kDegree;

  const Rigid3 end =
      RelativeError(true_poses, estimated_poses, 0, true_poses.size() - 1);
  drift.path_length = path.back();
  drift.end_translation_error = end.translation.norm();
  drift.end_rotation_error = Angle(end);
  return drift;
}

}  // namespace quatro
