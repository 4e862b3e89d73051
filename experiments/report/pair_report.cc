// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/report/pair_report.h"

#include "experiments/report/report_page.h"
#include "experiments/runner/run_task.h"
#include "features/voxel_grid.h"

namespace quatro {
namespace {

// About a megabyte in total.
constexpr Eigen::Index kMaxPoints = 30'000;
constexpr Eigen::Index kMaxMatches = 5'000;

void ThinToVoxels(double voxel_size, Points* points) {
  std::string ignored;
  auto voxels = SampleVoxels(*points, voxel_size, &ignored);
  if (voxels) *points = std::move(*voxels);
}

}  // namespace

std::string FormatPairReport(ViewedPair pair,
                             double voxel_size,
                             const MethodAnswer& answer,
                             const Manifest& manifest,
                             const std::string& report_template) {
  ThinToVoxels(voxel_size, &pair.source);
  ThinToVoxels(voxel_size, &pair.target);
  PairResult result;
  result.pair = pair.name;
  result.method = answer.method;
  result.is_truth_known = pair.true_target_from_source.has_value();
  FillResult(answer.summary, pair.true_target_from_source, &result);
  ViewOptions options;
  options.max_points = kMaxPoints;
  options.max_matches = kMaxMatches;
  options.seed = manifest.seed;
  ReportPage page;
  page.title = pair.name;
  page.manifest = manifest;
  page.results = {result};
  page.views = {{pair.name, FormatPairView(pair, {answer}, options)}};
  return FormatReportPage(page, report_template);
}

}  // namespace quatro
