// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The data of a pair for the 3D view of a report, as JSON: both thinned clouds,
// the matches, and for each method the stages that each match passed,
//
//   pair, files      name; files of source and target
//   source, target   points: their number; origin [m], step [m], xyz: some of
//                    them (quantized_points.h), in base64
//   truth            4 x 4 rows, or null
//   matches          source, target: like xyz above, on the cloud's own grid
//   methods          name, status, reason, pose (4 x 4 rows or null), notes,
//                    features (of the verdict), rung, candidates and stages
//
// `candidates` are at most five poses of the search, the best first: origin,
// score, overlap, contradicted (share), likelihood (log ratio), and the
// differences shift_m and turn_deg from the answer, null if there is none.
//
// `stages` is null for a method without matches or with other matches than the
// first method. Otherwise it has
//
//   fate     one byte per match: 1 if it is in the consistent set, plus 2 if it
//            is an inlier
//   weight   one byte per match, 255 for 1: PoseSummary::match_weights; null if
//            the method has none
//   counts   numbers of matches, consistent, weighted (weight >= 0.5) and
//            inliers among all matches, not only the drawn ones
//   right    the same numbers among the matches that are within the noise bound
//            of the true pose; null if there is no true pose
//
// Inliers need not be in the consistent set, because the pose is evaluated on
// all matches. There are no times: the same run gives the same view, byte for
// byte.

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
  Eigen::Index max_points = 2000;  // Per cloud.

  // At most three quarters of these are matches that some method kept, unless
  // there are too few other matches.
  Eigen::Index max_matches = 600;

  std::uint64_t seed = 0;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Options for this many pairs on one page of at most about 25 MB; fewer pairs
// get more detail.
ViewOptions MakeViewOptions(std::size_t num_pairs, std::size_t num_methods);

struct ViewedPair {
  std::string name;
  std::string source_file;
  std::string target_file;
  Points source;  // [m], each in its own frame.
  Points target;
  std::optional<Rigid3> true_target_from_source;
  double noise_bound = 0.3;  // On each axis [m].
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
