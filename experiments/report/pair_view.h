// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What the 3D view of a report shows of a pair, as JSON: both clouds thinned,
// the matches, and of each method which matches outlived which stage,
//
//   pair, files      its name; the source's and the target's
//   source, target   points: how many there are; origin [m], step [m], xyz:
//   some
//                    of them (quantized_points.h), in base64
//   truth            4 x 4 rows, or null
//   matches          source, target: as xyz above, in the cloud's own grid
//   methods          name, status, reason, pose (4 x 4 rows or null), notes,
//                    features (of the verdict), and stages
//
// with, of `stages`, which is null for a method that has other matches than the
// first one, or none,
//
//   fate     a byte a match: 1 in the consistent set, 2 agrees with the pose
//   weight   a byte a match, 255 for 1: PoseSummary::match_weights; null if the
//            method has none
//   counts   matches, consistent, weighted (of weight 0.5 or more), agreeing:
//   of
//            all matches, not of those that are drawn alone
//   right    how many of each are within the noise bound of the truth; or null
//
// Agreeing matches need not be consistent: the pose is judged on all of them.
// No times: the same run gives the same view, byte for byte.

#ifndef QUATRO_EXPERIMENTS_REPORT_PAIR_VIEW_H_
#define QUATRO_EXPERIMENTS_REPORT_PAIR_VIEW_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "robust/registration/registration.h"

namespace quatro {

struct ViewOptions {
  Eigen::Index max_points = 2000;  // Of each cloud.

  // At most three quarters of them of matches that any method kept.
  Eigen::Index max_matches = 600;

  std::uint64_t seed = 0;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// For so many pairs on one page, of 25 MB or so at most: the fewer, the finer.
ViewOptions MakeViewOptions(std::size_t num_pairs, std::size_t num_methods);

struct ViewedPair {
  std::string name;
  std::string source_file;
  std::string target_file;
  Points source;  // [m], each in its own frame.
  Points target;
  std::optional<Rigid3> true_target_from_source;
  double noise_bound = 0.3;  // [m], of a right match on each axis.
};

struct MethodAnswer {
  std::string method;
  RegistrationSummary summary;
};

// Options must be valid, and the points finite.
std::string FormatPairView(const ViewedPair& pair,
                           const std::vector<MethodAnswer>& answers,
                           const ViewOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_REPORT_PAIR_VIEW_H_
