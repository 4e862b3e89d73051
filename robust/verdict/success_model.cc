// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/success_model.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace quatro {
namespace {

// Output of experiments/scripts/calibrate_verdict.py.
constexpr double kMatchesIntercept = -5.207;
constexpr double kMatchesWeights[] = {3.577, 3.931};
constexpr double kCloudsIntercept = -8.557;
constexpr double kCloudsWeights[] = {
    0.0, 0.984, 2.046, 3.001, 1.926, 2.576, 1.616};
constexpr double kSearchIntercept = -12.407;
constexpr double kSearchWeights[] = {
    0.777, 0.244, 0.066, 4.704, 2.198, 1.717, 2.749, 2.350, 1.671, 2.047};

// The upper ends of ramps.
constexpr double kLargeOverlap = 0.3;
constexpr double kLargeDistinctness = 0.15;
constexpr double kLargeOverlapOfSearch = 0.5;
constexpr double kLargeDistinctnessOfSearch = 0.3;
constexpr double kLargeSegmentRatio = 10.0;

// Typical values, assumed if free space is unknown, so that the feature has
// little influence.
constexpr double kUsualContradictedShare = 0.1;
constexpr double kUsualRivalContradictedShare = 0.15;

// 0 below `low`, 1 above `high`.
double Ramp(double x, double low, double high) {
  return std::clamp((x - low) / (high - low), 0.0, 1.0);
}

}  // namespace

std::vector<Feature> MakeFeatures(
    double log10_false_alarms,
    const std::optional<MatchRival>& rival,
    const std::optional<GeometricEvidence>& geometry) {
  std::vector<Feature> features = {
      {"surprise",
       Ramp(std::log1p(std::max(0.0, -log10_false_alarms)), 0.0, 3.0)},
      {"margin", rival ? Ramp(rival->margin, 0.0, 3.0) : 1.0}};
  if (!geometry) return features;
  const bool is_known = geometry->free_space.ContradictedShare().has_value();
  const double contradicted = geometry->free_space.ContradictedShare().value_or(
      kUsualContradictedShare);
  const double rival_contradicted =
      geometry->rival_free_space.ContradictedShare().value_or(
          is_known ? contradicted : kUsualRivalContradictedShare);
  const auto& search = geometry->search;
  features.push_back({"overlap",
                      Ramp(geometry->structure_overlap,
                           0.0,
                           search ? kLargeOverlapOfSearch : kLargeOverlap)});
  features.push_back({"free_space", Ramp(1.0 - contradicted, 0.5, 0.95)});
  features.push_back(
      {"distinctness",
       Ramp(geometry->Distinctness(),
            0.0,
            search ? kLargeDistinctnessOfSearch : kLargeDistinctness)});
  features.push_back(
      {"rival_refuted",
       std::max(Ramp(rival_contradicted - contradicted, 0.0, 0.1),
                Ramp(geometry->Distinctness(), 0.4, 0.5))});
  features.push_back(
      {"held",
       Ramp(std::log10(std::max(1e-3, geometry->weakest_share)), -2.0, -0.8)});
  if (search) {
    features.push_back(
        {"guided",
         Ramp(std::log1p(static_cast<double>(search->num_guided_inliers)),
              std::log(10.0),
              std::log(100.0))});
    features.push_back(
        {"segments", Ramp(search->segment_ratio, 0.0, kLargeSegmentRatio)});
    features.push_back({"first_search", search->is_first ? 1.0 : 0.0});
  }
  return features;
}

double ProbabilityOfSuccess(const std::vector<Feature>& features) {
  double sum = kMatchesIntercept;
  std::span<const double> weights = kMatchesWeights;
  if (features.size() == std::size(kCloudsWeights)) {
    sum = kCloudsIntercept;
    weights = kCloudsWeights;
  } else if (features.size() == std::size(kSearchWeights)) {
    sum = kSearchIntercept;
    weights = kSearchWeights;
  }
  CHECK_EQ(features.size(), weights.size());
  for (std::size_t j = 0; j < weights.size(); ++j) {
    sum += weights[j] * features[j].value;
  }
  return 1.0 / (1.0 + std::exp(-sum));
}

}  // namespace quatro
