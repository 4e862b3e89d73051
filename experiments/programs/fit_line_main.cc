// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <ceres/ceres.h>
#include <gflags/gflags.h>

#include <cstdio>
#include <vector>

#include "experiments/programs/flag_problems.h"
#include "experiments/programs/program.h"
#include "features/base/random.h"
#include "robust/gnc/ceres_gnc.h"

DEFINE_int32(points, 300, "Number of points");
DEFINE_double(outliers, 0.7, "Share of outliers");
DEFINE_uint64(seed, 0, "Random seed");

namespace {

constexpr double kSlope = 0.5;
constexpr double kOffset = 1.0;
constexpr double kNoise = 0.05;

constexpr char kUsage[] =
    "fits a line to points that are mostly outliers: the first example of\n"
    "robust/gnc/ceres_gnc.h.\n"
    "\n"
    "  quatro_fit_line --outliers=0.7\n"
    "\n"
    "Prints y = a x + b for the truth, ceres::Solve and GNC. Exits with 0;\n"
    "1 if there is no answer; 2 if a flag is invalid.";

struct PointOnLine {
  template <typename T>
  bool operator()(const T* line, T* residual) const {
    residual[0] = y - (line[0] * x + line[1]);
    return true;
  }
  double x, y;
};

std::vector<PointOnLine> DrawPoints() {
  quatro::Random random(FLAGS_seed);
  std::vector<PointOnLine> points;
  for (int i = 0; i < FLAGS_points; ++i) {
    const bool is_outlier = i < FLAGS_outliers * FLAGS_points;
    const double x = 10.0 * random.Uniform();
    const double u = random.Uniform();
    points.push_back({x,
                      is_outlier
                          ? 20.0 * u
                          : kSlope * x + kOffset + kNoise * (2.0 * u - 1.0)});
  }
  return points;
}

int Main(int argc, char** argv) {
  if (const auto exit_code = quatro::ParseFlags(kUsage, argc, argv)) {
    return *exit_code;
  }
  if (FLAGS_points < 2 || FLAGS_points > 1000000) {
    return quatro::Fail(
        quatro::FlagProblem("points", FLAGS_points, "2 to 1000000"));
  }
  if (!(FLAGS_outliers >= 0.0 && FLAGS_outliers <= 1.0)) {
    return quatro::Fail(
        quatro::FlagProblem("outliers", FLAGS_outliers, "0 to 1"));
  }

  double line[2] = {0.0, 0.0};
  ceres::Problem problem;
  for (const PointOnLine& point : DrawPoints()) {
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PointOnLine, 1, 2>(
                                 new PointOnLine(point)),
                             nullptr,
                             line);
  }
  quatro::CeresGncOptions options;
  options.bound = 2.0 * kNoise;
  options.surrogate = quatro::SurrogateType::kGemanMcClure;

  std::printf("truth         y = %.3f x + %.3f\n", kSlope, kOffset);
  ceres::Solver::Summary plain;
  ceres::Solve(options.solver, &problem, &plain);
  std::printf("ceres::Solve  y = %.3f x + %.3f\n", line[0], line[1]);
  const auto summary = quatro::SolveCeresGnc(&problem, options);
  std::printf("GNC           y = %.3f x + %.3f\n%s\n",
              line[0],
              line[1],
              summary.BriefReport().c_str());
  return summary.IsUsable() ? quatro::kExitDone : quatro::kExitNotVouchedFor;
}

}  // namespace

int main(int argc, char** argv) { return quatro::RunProgram(Main, argc, argv); }
