// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The probability that a pose is right, from what is known of it:
//
//   P = 1 / (1 + exp(-(w_0 + sum_j w_j x_j))),                             (1)
//
// one model for matches alone, one for matches and clouds. The features x_j are
// bounded, so that no single one decides, and the weights are >= 0: more
// evidence never lowers P.
//
// The weights were fitted by experiments/calibrate_verdict.py, which says how,
// and on which scans; it prints what success_model.cc holds. P is calibrated
// for such scans, half of which share no place: where wrong answers are rarer,
// P is too low, and the other way round.

#ifndef QUATRO_ROBUST_SUCCESS_MODEL_H_
#define QUATRO_ROBUST_SUCCESS_MODEL_H_

#include <optional>
#include <string>
#include <vector>

#include "robust/evidence.h"
#include "robust/rival.h"

namespace quatro {

struct Feature {
  std::string name;
  double value = 0.0;
};

// Of the matches, and of the clouds if they are known.
std::vector<Feature> MakeFeatures(
    double log10_false_alarms,
    const std::optional<Rival>& rival,
    const std::optional<GeometricEvidence>& geometry);

// (1), by the model that the features are of.
double ProbabilityOfSuccess(const std::vector<Feature>& features);

}  // namespace quatro

#endif  // QUATRO_ROBUST_SUCCESS_MODEL_H_
