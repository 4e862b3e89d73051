// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/report/pair_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "experiments/report/base64.h"
#include "experiments/report/match_stages.h"
#include "experiments/report/quantized_points.h"
#include "experiments/report/thinning.h"
#include "features/base/random.h"
#include "robust/estimators/consensus.h"
#include "robust/estimators/distinct_matches.h"

namespace quatro {
namespace {

using Json = nlohmann::ordered_json;
using Indices = std::vector<Eigen::Index>;

Json Rows(const std::optional<Rigid3>& pose) {
  if (!pose) return nullptr;
  const Eigen::Matrix4d matrix = pose->ToMatrix();
  Json rows = Json::array();
  for (const auto row : matrix.rowwise()) {
    rows.push_back(std::vector<double>(row.begin(), row.end()));
  }
  return rows;
}

bool HasSameMatches(const RegistrationSummary& a,
                    const RegistrationSummary& b) {
  return a.matched_source.cols() == b.matched_source.cols() &&
         a.matched_source == b.matched_source &&
         a.matched_target == b.matched_target;
}

// The answer whose matches are drawn; nullptr if there is none.
const RegistrationSummary* FindMatched(
    const std::vector<MethodAnswer>& answers) {
  for (const MethodAnswer& answer : answers) {
    if (answer.summary.matched_source.cols() > 0) return &answer.summary;
  }
  return nullptr;
}

// The matches to draw: first those that any method kept, then others.
Indices ChooseMatches(const RegistrationSummary& matched,
                      const std::vector<MethodAnswer>& answers,
                      const ViewOptions& options) {
  const Eigen::Index num_matches = matched.matched_source.cols();
  std::vector<bool> is_kept(static_cast<std::size_t>(num_matches));
  for (const MethodAnswer& answer : answers) {
    if (!HasSameMatches(answer.summary, matched)) continue;
    const std::vector<int> fates = FindMatchStages(answer.summary).fates;
    for (std::size_t i = 0; i < fates.size(); ++i) {
      if (fates[i] != 0) is_kept[i] = true;
    }
  }
  Indices kept, others;
  for (Eigen::Index i = 0; i < num_matches; ++i) {
    (is_kept[static_cast<std::size_t>(i)] ? kept : others).push_back(i);
  }
  const auto num_others = static_cast<Eigen::Index>(others.size());
  const Eigen::Index max_kept =
      std::max(options.max_matches * 3 / 4, options.max_matches - num_others);
  Indices chosen = Thin(kept, max_kept, Mix(options.seed + 1));
  const auto num_kept = static_cast<Eigen::Index>(chosen.size());
  const Indices more =
      Thin(others, options.max_matches - num_kept, Mix(options.seed + 2));
  chosen.insert(chosen.end(), more.begin(), more.end());
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

Json DescribeCounts(const StageCounts& counts) {
  return {{"matches", counts.matches},
          {"consistent", counts.consistent},
          {"weighted", counts.weighted},
          {"inliers", counts.inliers}};
}

Json DescribeStages(const RegistrationSummary& summary,
                    const ViewedPair& pair,
                    const Indices& chosen) {
  const MatchStages found = FindMatchStages(summary);
  const auto& [fates, weights] = found;
  std::string fate_bytes, weight_bytes;
  for (const Eigen::Index i : chosen) {
    const auto k = static_cast<std::size_t>(i);
    fate_bytes += static_cast<char>(fates[k]);
    if (!weights.empty()) {
      weight_bytes += static_cast<char>(
          std::lround(255.0 * std::clamp(weights[k], 0.0, 1.0)));
    }
  }
  Json stages = {
      {"fate", EncodeBase64(fate_bytes)},
      {"weight", weights.empty() ? Json() : Json(EncodeBase64(weight_bytes))},
      {"counts", DescribeCounts(CountStages(found, {}))},
      {"right", nullptr}};
  if (pair.true_target_from_source) {
    std::vector<bool> is_right(fates.size());
    for (const Eigen::Index i : FindInliers(summary.matched_source,
                                            summary.matched_target,
                                            *pair.true_target_from_source,
                                            pair.noise_bound)) {
      is_right[static_cast<std::size_t>(i)] = true;
    }
    stages["right"] = DescribeCounts(CountStages(found, is_right));
  }
  return stages;
}

double Thousandths(double value) { return std::round(1000.0 * value) / 1000.0; }

// The best candidates of the search, and how far each is from the answer.
Json DescribeCandidates(const RegistrationSummary& summary) {
  constexpr std::size_t kNumDescribed = 5;
  std::vector<const PoseCandidate*> best;
  for (const PoseCandidate& candidate : summary.candidates) {
    best.push_back(&candidate);
  }
  std::stable_sort(best.begin(),
                   best.end(),
                   [](const PoseCandidate* a, const PoseCandidate* b) {
                     return a->Score() > b->Score();
                   });
  best.resize(std::min(best.size(), kNumDescribed));
  const Eigen::Vector3d middle =
      summary.matched_source.cols() > 0
          ? Eigen::Vector3d(summary.matched_source.rowwise().mean())
          : Eigen::Vector3d::Zero();
  const auto& answer = summary.target_from_source();
  Json candidates = Json::array();
  for (const PoseCandidate* candidate : best) {
    const Rigid3& pose = candidate->target_from_source;
    Json described = {
        {"origin", candidate->origin},
        {"score", Thousandths(candidate->Score())},
        {"overlap", Thousandths(candidate->geometry.overlap)},
        {"contradicted", Thousandths(candidate->geometry.contradicted_share)},
        {"likelihood", Thousandths(candidate->log_likelihood_ratio)},
        {"shift_m", nullptr},
        {"turn_deg", nullptr}};
    if (answer) {
      described["shift_m"] =
          Thousandths((pose * middle - *answer * middle).norm());
      described["turn_deg"] = Thousandths(
          180.0 / M_PI * AngleBetween(pose.rotation, answer->rotation));
    }
    candidates.push_back(std::move(described));
  }
  return candidates;
}

Json DescribeAnswer(const MethodAnswer& answer, const Json& stages) {
  const RegistrationSummary& summary = answer.summary;
  Json features = Json::object();
  for (const Feature& feature : summary.verdict.features) {
    features[feature.name] = feature.value;
  }
  Json notes = Json::array();
  for (const StageNote& note : summary.solution.notes) {
    notes.push_back({note.stage, note.text});
  }
  return {{"name", answer.method},
          {"status", StatusName(summary.verdict.status)},
          {"reason", summary.verdict.reason},
          {"pose", Rows(summary.target_from_source())},
          {"features", features},
          {"rung", summary.rung},
          {"candidates", DescribeCandidates(summary)},
          {"notes", notes},
          {"stages", stages}};
}

// A cloud and its matched points on one grid.
struct DrawnCloud {
  Json cloud;
  Json matched;
};

DrawnCloud Draw(const Points& points,
                const Points& matched,
                Eigen::Index max_points,
                std::uint64_t seed) {
  const Points drawn =
      Columns(points, ThinRange(points.cols(), max_points, seed));
  Points both(3, drawn.cols() + matched.cols());
  both << drawn, matched;
  const PointGrid grid = FindGrid(both);
  const Eigen::Vector3d& origin = grid.origin;
  return {{{"points", points.cols()},
           {"origin", {origin.x(), origin.y(), origin.z()}},
           {"step", grid.step},
           {"xyz", EncodeBase64(QuantizePoints(drawn, grid))}},
          EncodeBase64(QuantizePoints(matched, grid))};
}

}  // namespace

bool ViewOptions::IsValid(std::string* error) const {
  if (max_points >= 1 && max_matches >= 4) return true;
  *error =
      max_points < 1 ? "max_points must be >= 1" : "max_matches must be >= 4";
  return false;
}

ViewOptions MakeViewOptions(std::size_t num_pairs, std::size_t num_methods) {
  constexpr double kPageBytes = 24e6;
  constexpr double kMethodBytes = 1500.0;  // Without its matches.
  const auto num = static_cast<double>(num_methods);
  const double bytes =
      kPageBytes / static_cast<double>(std::max<std::size_t>(num_pairs, 1)) -
      kMethodBytes * num;
  // In base64, one point of both clouds takes 16 bytes; a match takes as much,
  // plus 3 bytes per method.
  ViewOptions options;
  options.max_points =
      static_cast<Eigen::Index>(std::clamp(0.7 * bytes / 16.0, 500.0, 6000.0));
  options.max_matches = static_cast<Eigen::Index>(
      std::clamp(0.3 * bytes / (16.0 + 3.0 * num), 200.0, 2000.0));
  return options;
}

std::string FormatPairView(const ViewedPair& pair,
                           const std::vector<MethodAnswer>& answers,
                           const ViewOptions& options) {
  const RegistrationSummary* const matched = FindMatched(answers);
  Indices chosen;
  Points matched_source(3, 0), matched_target(3, 0);
  if (matched) {
    chosen = ChooseMatches(*matched, answers, options);
    matched_source = Columns(matched->matched_source, chosen);
    matched_target = Columns(matched->matched_target, chosen);
  }
  const DrawnCloud source = Draw(
      pair.source, matched_source, options.max_points, Mix(options.seed + 3));
  const DrawnCloud target = Draw(
      pair.target, matched_target, options.max_points, Mix(options.seed + 4));
  Json methods = Json::array();
  for (const MethodAnswer& answer : answers) {
    const bool has_stages = matched && HasSameMatches(answer.summary, *matched);
    methods.push_back(DescribeAnswer(
        answer,
        has_stages ? DescribeStages(answer.summary, pair, chosen) : Json()));
  }
  const Json view = {
      {"pair", pair.name},
      {"files", {pair.source_file, pair.target_file}},
      {"source", source.cloud},
      {"target", target.cloud},
      {"truth", Rows(pair.true_target_from_source)},
      {"matches", {{"source", source.matched}, {"target", target.matched}}},
      {"methods", methods}};
  // Replaces invalid UTF-8 instead of throwing.
  return view.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace quatro
