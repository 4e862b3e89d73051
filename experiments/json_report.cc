// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/json_report.h"

#include <cmath>

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
  return surrogate == SurrogateType::kGemanMcClure ? "geman_mcclure"
                                                   : "truncated_least_squares";
}

const char* Name(GncStart start) {
  return start == GncStart::kIdentity ? "identity" : "plain_fit";
}

// Microseconds are as fine as a clock is believed.
double Milliseconds(double seconds) { return std::round(seconds * 1e6) / 1e3; }

}  // namespace

Json MakeReport(const std::string& method,
                const Verdict& verdict,
                const QuatroSummary& quatro,
                const std::vector<StageTime>& stage_times,
                double total_seconds) {
  Json report;
  report["status"] = StatusName(verdict.status);
  report["reason"] = verdict.reason;
  report["target_from_source"] = nullptr;
  report["yaw_deg"] = nullptr;
  if (quatro.IsUsable()) {
    const Eigen::Matrix4d matrix = quatro.target_from_source->ToMatrix();
    Json rows = Json::array();
    for (int row = 0; row < 4; ++row) {
      rows.push_back(
          {matrix(row, 0), matrix(row, 1), matrix(row, 2), matrix(row, 3)});
    }
    report["target_from_source"] = rows;
    report["yaw_deg"] = Yaw(quatro.target_from_source->rotation) * 180.0 / M_PI;
  }
  report["counts"] = {{"correspondences", quatro.num_distinct},
                      {"clique", quatro.num_consistent},
                      {"tims", quatro.num_tims},
                      {"rotation_inliers", quatro.num_rotation_inliers},
                      {"translation_inliers", quatro.num_translation_inliers},
                      {"agreeing", verdict.num_agreeing}};
  report["evidence"] = {
      {"chance_of_agreement", verdict.chance_of_agreement},
      {"log10_false_alarms", verdict.log10_false_alarms},
      {"structure_overlap",
       verdict.structure_overlap ? Json(*verdict.structure_overlap)
                                 : Json(nullptr)}};
  report["covariance"] = nullptr;
  report["certificate"] = nullptr;
  Json timings;
  for (const StageTime& time : stage_times) {
    timings[time.stage] = Milliseconds(time.seconds);
  }
  timings["total"] = Milliseconds(total_seconds);
  report["timings_ms"] = timings;
  report["method"] = method;
  return report;
}

Json DescribeOptions(const QuatroOptions& options) {
  return {{"noise_bound", options.noise_bound},
          {"tim_bound_factor", options.tim_bound_factor},
          {"consistency_test", Name(options.consistency_test)},
          {"pruning", Name(options.pruning)},
          {"tim_layout", Name(options.tim_layout)},
          {"surrogate", Name(options.surrogate)},
          {"gnc_start", Name(options.gnc.start)},
          {"gnc_mu_step", options.gnc.mu_step},
          {"gnc_max_num_iterations", options.gnc.max_num_iterations},
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
