// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The answer as JSON, for programs. The same for any number of threads, but for
// `timings_ms`.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_JSON_REPORT_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_JSON_REPORT_H_

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "features/base/stopwatch.h"
#include "robust/estimators/pose_summary.h"
#include "robust/estimators/quatro.h"
#include "robust/registration/refinement.h"
#include "robust/registration/registration.h"
#include "robust/verdict/surface_observability.h"
#include "robust/verdict/verdict.h"

namespace quatro {

using Json = nlohmann::ordered_json;

// What both programs report: status and reason (the verdict's), message (the
// estimator's), target_from_source (4 rows of 4, or null), yaw_deg, counts,
// covariance (6 rows of 6, rotation [rad] first, or null),
// unobservable_directions, match_sigma [m], certificate, timings_ms, method.
Json MakeReport(const std::string& method,
                const Verdict& verdict,
                const PoseSummary& solution,
                const std::vector<StageTime>& stage_times,
                double total_seconds);

// What the surfaces hold of the position on the ground, or null.
Json Describe(const std::optional<SurfaceObservability>& hold);

// Method, termination, message, whether it was accepted, iterations, inliers,
// moved_m and moved_deg, cost, conditioning and the pose before. Null if it was
// not tried.
Json DescribeRefinement(const std::optional<RefinementSummary>& refinement);

// The parameters as given and used.
Json DescribeOptions(const QuatroOptions& options);
Json DescribeOptions(const FrontEndOptions& options);

// The library's version.
std::string Version();

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_JSON_REPORT_H_
