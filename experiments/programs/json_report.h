// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The result as JSON, for programs. It does not depend on the number of
// threads, except for `timings_ms`.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_JSON_REPORT_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_JSON_REPORT_H_

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/stopwatch.h"
#include "robust/estimators/pose_summary.h"
#include "robust/registration/pose_search.h"
#include "robust/registration/refinement.h"
#include "robust/registration/registration.h"
#include "robust/verdict/surface_observability.h"
#include "robust/verdict/verdict.h"

namespace quatro {

using Json = nlohmann::ordered_json;

// A pose as the 4 rows of its 4x4 matrix.
Json Rows(const Rigid3& pose);

// The fields that both programs report. Among them are status, reason and
// probability (of the verdict), message (of the estimator), target_from_source
// (4 rows of 4, or null), yaw_deg, counts, evidence, covariance (6 rows of 6,
// rotation [rad] first, or null), unobservable_directions, match_sigma [m],
// certificate, timings_ms, notes and method.
Json MakeReport(const std::string& method,
                const Verdict& verdict,
                const PoseSummary& solution,
                const std::vector<StageTime>& stage_times,
                double total_seconds);

// The observability of the horizontal position from the surfaces, or null.
Json Describe(const std::optional<SurfaceObservability>& hold);

// The error radius: translation_m, rotation_deg, confidence, the deviations
// that it is a multiple of, and regime; or null.
Json DescribeRadius(const std::optional<ErrorRadius>& radius);

// The refinement: method, accepted, message, termination, iterations, inliers,
// moved_m, moved_deg, cost, conditioning and the pose before the refinement.
// Null if there was no refinement.
Json DescribeRefinement(const std::optional<RefinementSummary>& refinement);

// The poses that a search found, the best of each rung first: origin, score,
// overlap, contradicted_share, log_likelihood_ratio and target_from_source.
Json DescribeCandidates(const std::vector<PoseCandidate>& candidates);

// The library's version.
std::string Version();

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_JSON_REPORT_H_
