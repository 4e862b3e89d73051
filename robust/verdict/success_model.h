// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The probability that a pose is right, from what is known of it:
//
//   P = 1 / (1 + exp(-(w_0 + sum_j w_j x_j))),                             (1)
//
// one model for matches alone, one for matches and clouds. The features are
// ramps from 0 to 1, so that no single one decides, and w_j >= 0: more evidence
// never lowers P.
//
//   surprise            ln(1 - log10 NFA) of the pose      0 .. 3
//   margin              over the rival of the matches      0 .. 3
//   overlap             structure that is met              0 .. 0.3
//   free_space          1 - contradicted share             0.5 .. 0.95
//   distinctness        overlap over that of the rival     0 .. 0.15
//   rival_refuted       its contradicted share over ours   0 .. 0.1
//                       or, if more, the distinctness      0.4 .. 0.5
//   held                log10 of the weakest share         -2 .. -0.8
//
// (robust/verdict/false_alarms.h, robust/verdict/match_rival.h,
// robust/verdict/evidence.h.) The weights were fitted by
// experiments/scripts/calibrate_verdict.py, which says how; it prints what
// success_model.cc holds. P is calibrated for the scans there, half of which
// share no place: where wrong answers are rarer, P is too low, and the other
// way round. The model of matches alone was fitted without places that have a
// twin, since matches cannot tell twins apart.

#ifndef QUATRO_ROBUST_VERDICT_SUCCESS_MODEL_H_
#define QUATRO_ROBUST_VERDICT_SUCCESS_MODEL_H_

#include <optional>
#include <string>
#include <vector>

#include "robust/verdict/evidence.h"
#include "robust/verdict/match_rival.h"

namespace quatro {

// One number of the model, by name.
struct Feature {
  std::string name;
  double value = 0.0;
};

// Of the matches, and of the clouds if they are known.
std::vector<Feature> MakeFeatures(
    double log10_false_alarms,
    const std::optional<MatchRival>& rival,
    const std::optional<GeometricEvidence>& geometry);

// (1), by the model that the features are of.
double ProbabilityOfSuccess(const std::vector<Feature>& features);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_SUCCESS_MODEL_H_
