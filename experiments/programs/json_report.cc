// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/json_report.h"

#include <quatro/version.h>
#include <cmath>
#include <optional>
#include <vector>

#include "features/base/rigid3.h"

namespace quatro {
namespace {

Json Rows(const Matrix6& matrix) {
  Json rows = Json::array();
  for (const auto row : matrix.rowwise()) {
    rows.push_back(std::vector<double>(row.begin(), row.end()));
  }
  return rows;
}

Json OrNull(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json Describe(const std::optional<YawCertificate>& certificate) {
  if (!certificate) return nullptr;
  return {{"gnc_cost", OrNull(certificate->gnc_cost)},
          {"optimal_cost", certificate->optimal_cost},
          {"gap", OrNull(certificate->gap)}};
}

Json Describe(const MatchRival& rival) {
  return {{"inliers", rival.num_inliers},
          {"margin", rival.margin},
          {"same_matches", rival.has_same_matches},
          {"target_from_source", Rows(rival.target_from_source)}};
}

Json Describe(const GeometricEvidence& evidence) {
  const auto& direction = evidence.weakest_direction;
  const GeometricRival& rival = evidence.rival;
  const auto& search = evidence.search;
  return {
      {"structure_overlap", evidence.structure_overlap},
      {"median_residual_voxels", evidence.median_residual},
      {"contradicted_share", OrNull(evidence.free_space.ContradictedShare())},
      {"contradicted", evidence.free_space.num_contradicted},
      {"weakest_share", evidence.weakest_share},
      {"weakest_direction", {direction.x(), direction.y(), direction.z()}},
      {"coarse_overlap", rival.overlap},
      {"rival_overlap", rival.rival_overlap},
      {"rival_contradicted_share",
       OrNull(evidence.rival_free_space.ContradictedShare())},
      {"rival_yaw_deg", rival.yaw * 180.0 / M_PI},
      {"rival_shift_m", {rival.shift.x(), rival.shift.y(), rival.shift.z()}},
      {"rival_target_from_source", Rows(rival.rival_target_from_source)},
      {"guided_matches",
       search ? Json(search->num_guided_matches) : Json(nullptr)},
      {"guided_inliers",
       search ? Json(search->num_guided_inliers) : Json(nullptr)},
      {"segment_log_likelihood_ratio",
       search ? Json(search->segment_ratio) : Json(nullptr)}};
}

// The evidence on which the verdict is based.
Json DescribeEvidence(const Verdict& verdict) {
  Json evidence = {{"false_alarms", Json::array()}};
  for (const FalseAlarms& alarms : verdict.false_alarms) {
    evidence["false_alarms"].push_back(
        {{"stage", alarms.stage},
         {"tested", alarms.num_tested},
         {"inliers", alarms.num_inliers},
         {"chance", alarms.chance},
         {"log10_false_alarms", alarms.log10_false_alarms}});
  }
  evidence["rival"] = verdict.rival ? Describe(*verdict.rival) : Json(nullptr);
  evidence["geometry"] =
      verdict.geometry ? Describe(*verdict.geometry) : Json(nullptr);
  Json features = Json::object();
  for (const Feature& feature : verdict.features) {
    features[feature.name] = feature.value;
  }
  evidence["features"] = features;
  return evidence;
}

const char* Name(UnobservableReason reason) {
  switch (reason) {
    case UnobservableReason::kNoData:
      return "no_data";
    case UnobservableReason::kWithinNoise:
      return "within_noise";
    case UnobservableReason::kUncertain:
      return "uncertain";
    case UnobservableReason::kAssumed:
      return "assumed";
    case UnobservableReason::kNoSurface:
      break;
  }
  return "no_surface";
}

Json Describe(const UnobservableDirection& direction) {
  const Eigen::Vector3d& a = direction.axis;
  const Eigen::Vector3d& p = direction.point;
  const bool is_rotation = direction.freedom == Freedom::kRotation;
  return {{"freedom", is_rotation ? "rotation" : "translation"},
          {"reason", Name(direction.reason)},
          {"axis", {a.x(), a.y(), a.z()}},
          {"point", is_rotation ? Json({p.x(), p.y(), p.z()}) : Json(nullptr)},
          {"standard_deviation", OrNull(direction.standard_deviation)},
          {"text", direction.Describe()}};
}

// Adds `covariance`, `unobservable_directions`, and their assumptions.
void AddUncertainty(const std::optional<PoseCovariance>& uncertainty,
                    Json* report) {
  (*report)["covariance"] = nullptr;
  (*report)["covariance_about"] = nullptr;  // About the inliers' mean.
  (*report)["unobservable_directions"] = Json::array();
  (*report)["match_sigma"] = nullptr;
  if (!uncertainty) return;
  if (uncertainty->covariance) {
    (*report)["covariance"] = Rows(*uncertainty->covariance);
    const Eigen::Vector3d& c = uncertainty->center;
    (*report)["covariance_about"] = {
        {"center", {c.x(), c.y(), c.z()}},
        {"covariance", Rows(*uncertainty->covariance_at_center)}};
  }
  for (const UnobservableDirection& direction : uncertainty->unobservable) {
    (*report)["unobservable_directions"].push_back(Describe(direction));
  }
  (*report)["match_sigma"] = {
      {"assumed", uncertainty->sigma},
      {"from_residuals", OrNull(uncertainty->estimated_sigma)}};
}

// Converts seconds to milliseconds, rounded to microseconds.
double Milliseconds(double seconds) { return std::round(seconds * 1e6) / 1e3; }

}  // namespace

Json Rows(const Rigid3& motion) {
  const Eigen::Matrix4d matrix = motion.ToMatrix();
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) {
    rows.push_back(
        {matrix(row, 0), matrix(row, 1), matrix(row, 2), matrix(row, 3)});
  }
  return rows;
}

Json MakeReport(const std::string& method,
                const Verdict& verdict,
                const PoseSummary& solution,
                const std::vector<StageTime>& stage_times,
                double total_seconds) {
  Json report;
  report["status"] = StatusName(verdict.status);
  report["reason"] = verdict.reason;
  report["probability"] = verdict.probability;
  report["tolerance"] = {
      {"translation_m", verdict.tolerance.translation},
      {"rotation_deg", verdict.tolerance.rotation * 180.0 / M_PI}};
  report["message"] = solution.message;
  report["target_from_source"] = nullptr;
  report["yaw_deg"] = nullptr;
  if (solution.IsUsable()) {
    report["target_from_source"] = Rows(*solution.target_from_source);
    report["yaw_deg"] =
        Yaw(solution.target_from_source->rotation) * 180.0 / M_PI;
  }
  report["unpolished_target_from_source"] =
      solution.unpolished_target_from_source
          ? Rows(*solution.unpolished_target_from_source)
          : Json(nullptr);
  if (solution.scale != 1.0) report["scale"] = solution.scale;
  report["counts"] = {{"matches", solution.num_matches},
                      {"consistent", solution.num_consistent},
                      {"tims", solution.num_tims},
                      {"rotation_inliers", solution.num_rotation_inliers},
                      {"translation_inliers", solution.num_translation_inliers},
                      {"inliers", verdict.num_inliers}};
  report["evidence"] = DescribeEvidence(verdict);
  AddUncertainty(solution.covariance, &report);
  report["certificate"] = Describe(solution.certificate);
  if (solution.crosscheck) {
    report["crosscheck"] = {
        {"subproblems", solution.crosscheck->num_subproblems},
        {"max_rotation_difference_rad",
         solution.crosscheck->max_rotation_difference},
        {"max_translation_difference_m",
         solution.crosscheck->max_translation_difference}};
  }
  Json timings;
  for (const StageTime& time : stage_times) {
    timings[time.stage] = Milliseconds(time.seconds);
  }
  timings["total"] = Milliseconds(total_seconds);
  report["timings_ms"] = timings;
  report["notes"] = Json::object();
  for (const StageNote& note : solution.notes) {
    report["notes"][note.stage] = note.text;
  }
  report["method"] = method;
  return report;
}

Json Describe(const std::optional<SurfaceObservability>& hold) {
  if (!hold) return nullptr;
  const Eigen::Vector3d& axis = hold->weakest_level_axis;
  return {{"points_overlapping", hold->num_overlapping},
          {"structure_overlapping", hold->num_structure},
          {"weakest_level_axis", {axis.x(), axis.y(), axis.z()}},
          {"weakest_level_share", hold->weakest_level_share}};
}

Json DescribeRadius(const std::optional<ErrorRadius>& radius) {
  if (!radius) return nullptr;
  return {{"translation_m", radius->translation},
          {"rotation_deg", radius->rotation * 180.0 / M_PI},
          {"confidence", 0.95},
          {"deviation_m", radius->translation_deviation},
          {"deviation_deg", radius->rotation_deviation * 180.0 / M_PI},
          {"regime", RegimeName(radius->regime)}};
}

Json DescribeRefinement(const std::optional<RefinementSummary>& refinement) {
  if (!refinement) return nullptr;
  const AlignmentSummary& alignment = refinement->alignment;
  return {{"method", RefinementName(refinement->method)},
          {"accepted", refinement->is_accepted},
          {"message", refinement->message},
          {"termination", TerminationName(alignment.termination)},
          {"iterations", alignment.iterations.size()},
          {"inliers", alignment.num_inliers},
          {"moved_m", refinement->moved_translation},
          {"moved_deg", refinement->moved_rotation * 180.0 / M_PI},
          {"cost", alignment.cost},
          {"conditioning", alignment.conditioning},
          {"unrefined_target_from_source",
           Rows(refinement->unrefined_target_from_source)}};
}

Json DescribeCandidates(const std::vector<PoseCandidate>& candidates) {
  Json list = Json::array();
  for (const PoseCandidate& candidate : candidates) {
    list.push_back(
        {{"origin", candidate.origin},
         {"score", candidate.Score()},
         {"overlap", candidate.geometry.overlap},
         {"contradicted_share", candidate.geometry.contradicted_share},
         {"log_likelihood_ratio", candidate.log_likelihood_ratio},
         {"target_from_source", Rows(candidate.target_from_source)}});
  }
  return list;
}

std::string Version() { return QUATRO_VERSION; }

}  // namespace quatro
