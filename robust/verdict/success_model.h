// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The probability that a pose is correct, from the evidence:
//
//   P = 1 / (1 + exp(-(w_0 + sum_j w_j x_j))),                             (1)
//
// There is one model for matches only, one for matches and clouds, and one for
// poses that were searched for, where the best of many hypotheses is judged
// (robust/registration/ladder.h). The features x_j are ramps from 0 to 1, so
// that no single one decides, and w_j >= 0, so that more evidence never lowers
// P.
//
//   surprise            ln(1 - log10 NFA) of the pose      0 .. 3
//   margin              z against the match rival          0 .. 3
//   overlap             overlap of the structure           0 .. 0.3
//   free_space          1 - contradicted share             0.5 .. 0.95
//   distinctness        overlap minus that of the rival    0 .. 0.15
//   rival_refuted       contradicted share of the rival    0 .. 0.1
//                       minus that of the pose, or, if
//                       larger, the distinctness           0.4 .. 0.5
//   held                log10 of the weakest share         -2 .. -0.8
//
// The model of poses that were searched for has ramps of 0 .. 0.5 for overlap
// and 0 .. 0.3 for distinctness, and three more features,
//
//   guided              ln of the inliers of guided        ln 10 .. ln 100
//                       matches, plus one
//   segments            log-likelihood ratio of segments   0 .. 10
//   first_search        1 if the pose is from the first
//                       search, else 0
//
// (robust/verdict/false_alarms.h, robust/verdict/match_rival.h,
// robust/verdict/evidence.h.) The weights were fitted by
// experiments/scripts/calibrate_verdict.py, which documents how and prints the
// constants of success_model.cc. P is calibrated for the scans of that fit,
// half of which show different places. P is too low for data with fewer
// incorrect poses, and too high for data with more. The model for matches only
// was fitted without places that have a twin, since matches cannot distinguish
// twins.

#ifndef QUATRO_ROBUST_VERDICT_SUCCESS_MODEL_H_
#define QUATRO_ROBUST_VERDICT_SUCCESS_MODEL_H_

#include <optional>
#include <string>
#include <vector>

#include "robust/verdict/evidence.h"
#include "robust/verdict/match_rival.h"

namespace quatro {

// A feature x_j of the model, by name.
struct Feature {
  std::string name;
  double value = 0.0;
};

// The features of the matches, and of the clouds if `geometry` is set.
std::vector<Feature> MakeFeatures(
    double log10_false_alarms,
    const std::optional<MatchRival>& rival,
    const std::optional<GeometricEvidence>& geometry);

// Equation (1), with the model that has these features.
double ProbabilityOfSuccess(const std::vector<Feature>& features);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_SUCCESS_MODEL_H_
