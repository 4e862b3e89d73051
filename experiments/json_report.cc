// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/json_report.h"

#include <cmath>
#include <optional>

#include "solvers/rigid3.h"

namespace quatro {
namespace {

const char* Name(ConsistencyTest test) {
  switch (test) {
    case ConsistencyTest::kLength:
      return "length";
    case ConsistencyTest::kPlanar:
      return "planar";
    case ConsistencyTest::kPlanarAndHeight:
      break;
  }
  return "planar_and_height";
}

const char* Name(Pruning pruning) {
  switch (pruning) {
    case Pruning::kCliqueHeuristic:
      return "clique_heuristic";
    case Pruning::kExactClique:
      return "exact_clique";
    case Pruning::kMaxCore:
      return "max_core";
    case Pruning::kNone:
      break;
  }
  return "none";
}

const char* Name(TimLayout layout) {
  switch (layout) {
    case TimLayout::kRing:
      return "ring";
    case TimLayout::kComplete:
      return "complete";
    case TimLayout::kRandom:
      break;
  }
  return "random";
}

const char* Name(SurrogateType surrogate) {
  switch (surrogate) {
    case SurrogateType::kGemanMcClure:
      return "geman_mcclure";
    case SurrogateType::kWelsch:
      return "welsch";
    case SurrogateType::kTruncatedLeastSquares:
      break;
  }
  return "truncated_least_squares";
}

const char* Name(GncStart start) {
  return start == GncStart::kIdentity ? "identity" : "plain_fit";
}

const char* Name(YawSolver solver) {
  return solver == YawSolver::kExact ? "exact" : "gnc";
}

Json Rows(const Rigid3& motion) {
  const Eigen::Matrix4d matrix = motion.ToMatrix();
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) {
    rows.push_back(
        {matrix(row, 0), matrix(row, 1), matrix(row, 2), matrix(row, 3)});
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

// Microseconds are as fine as a clock is believed.
double Milliseconds(double seconds) { return std::round(seconds * 1e6) / 1e3; }

}  // namespace

Json MakeReport(const std::string& method,
                const Verdict& verdict,
                const PoseSummary& solution,
                const std::vector<StageTime>& stage_times,
                double total_seconds) {
  Json report;
  report["status"] = StatusName(verdict.status);
  report["reason"] = verdict.reason;
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
  report["counts"] = {{"correspondences", solution.num_distinct},
                      {"clique", solution.num_consistent},
                      {"tims", solution.num_tims},
                      {"rotation_inliers", solution.num_rotation_inliers},
                      {"translation_inliers", solution.num_translation_inliers},
                      {"agreeing", verdict.num_agreeing}};
  report["evidence"] = {
      {"chance_of_agreement", verdict.chance_of_agreement},
      {"log10_false_alarms", verdict.log10_false_alarms},
      {"structure_overlap", OrNull(verdict.structure_overlap)}};
  report["covariance"] = nullptr;
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
  report["method"] = method;
  return report;
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

Json DescribeOptions(const QuatroOptions& options) {
  return {{"noise_bound", options.noise_bound},
          {"tim_bound_factor", options.tim_bound_factor},
          {"consistency_test", Name(options.consistency_test)},
          {"pruning", Name(options.pruning)},
          {"tim_layout", Name(options.tim_layout)},
          {"yaw_solver", Name(options.yaw_solver)},
          {"surrogate", Name(options.surrogate)},
          {"gnc_start", Name(options.gnc.start)},
          {"gnc_mu_step", options.gnc.mu_step},
          {"gnc_max_num_iterations", options.gnc.max_num_iterations},
          {"replace_missed_optimum", options.replace_missed_optimum},
          {"recover_translation", options.recover_translation},
          {"polish", options.polish},
          {"seed", options.seed}};
}

Json DescribeOptions(const FrontEndOptions& options) {
  return {{"voxel_size", options.voxel_size},
          {"normal_radius", options.normal_radius},
          {"fpfh_radius", options.fpfh_radius},
          {"tuple_test", options.tuple_test},
          {"tuple_scale", options.tuple.scale}};
}

std::string Version() { return QUATRO_VERSION; }

}  // namespace quatro
