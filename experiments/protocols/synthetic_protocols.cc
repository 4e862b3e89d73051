// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/protocols/synthetic_protocols.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "experiments/simulator/synthetic.h"
#include "features/base/degree.h"
#include "features/base/stopwatch.h"
#include "robust/estimators/arc_consensus.h"
#include "robust/gnc/gnc.h"
#include "robust/gnc/quasi_so3.h"
#include "robust/gnc/surrogate.h"
#include "robust/registration/registration.h"
#include "solvers/closed_form/exact_yaw.h"

namespace quatro {
namespace {

constexpr double kYawTolerance = 1.0 * kDegree;
constexpr double kTranslationTolerance = 0.3;  // [m]

std::string Number(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", digits, value);
  return text;
}

std::string Count(int value, int total) {
  return std::to_string(value) + "/" + std::to_string(total);
}

double Median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  const auto middle =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool HasCorrectRotation(const PoseSummary& summary,
                        const MatchedProblem& problem,
                        double tolerance) {
  return summary.IsUsable() &&
         AngleBetween(summary.target_from_source->rotation,
                      problem.true_target_from_source.rotation) <= tolerance;
}

bool HasCorrectTranslation(const PoseSummary& summary,
                           const MatchedProblem& problem) {
  return summary.IsUsable() && (summary.target_from_source->translation -
                                problem.true_target_from_source.translation)
                                       .norm() <= kTranslationTolerance;
}

// Counts correct results of a solver.
struct Tally {
  int num_answers = 0;
  int num_correct_rotations = 0;
  int num_correct_translations = 0;
  int num_registered = 0;

  void Add(const RegistrationSummary& summary,
           const MatchedProblem& problem,
           double rotation_tolerance) {
    num_answers += summary.solution.IsUsable();
    num_correct_rotations +=
        HasCorrectRotation(summary.solution, problem, rotation_tolerance);
    num_correct_translations +=
        HasCorrectTranslation(summary.solution, problem);
    num_registered += summary.verdict.IsRegistered();
  }
};

struct NamedMethod {
  std::string name;
  RegistrationOptions options;

  RegistrationSummary Solve(const MatchedProblem& problem) const {
    return RegisterMatches({problem.source, problem.target}, options);
  }
};

std::vector<NamedMethod> MethodsAt(double noise_bound) {
  RegistrationOptions ours;
  ours.noise_bound = noise_bound;
  RegistrationOptions paper = ours;
  paper.quatro.replace_missed_optimum = false;
  paper.quatro.recover_translation = false;
  paper.quatro.polish = false;
  RegistrationOptions teaser = ours;
  teaser.method = "teaser";
  return {{"SO(3), teaser", teaser},
          {"quasi-SO(3), as in the paper", paper},
          {"quasi-SO(3), recover and polish", ours}};
}

}  // namespace

Table TabulateSurrogates() {
  Table table{{"mu", "residual", "loss"}, {}};
  const auto add = [&](const std::string& name, double mu) {
    for (int i = 0; i <= 300; ++i) {
      const double residual = 0.01 * i;  // In noise bounds.
      table.rows.push_back(
          {name,
           Number(residual, 2),
           Number(TruncatedLeastSquares::Loss(residual * residual, mu), 6)});
    }
  };
  for (const double mu : {0.01, 0.1, 0.5, 2.0, 10.0}) add(Number(mu, 2), mu);
  add("inf", 1e12);
  return table;
}

Table RunTimProtocol(int num_seeds, const Progress& progress) {
  constexpr Eigen::Index kNumTims = 5000;
  constexpr double kBound = 0.3;  // c [m]
  const std::vector<double> ratios = {0.95, 0.98, 0.99};
  const int num_problems = static_cast<int>(ratios.size()) * num_seeds;
  Table table{{"outliers",
               "gnc correct",
               "exact correct",
               "gnc ms",
               "exact ms",
               "largest gap",
               "smallest gap"},
              {}};
  int num_done = 0;
  for (const double ratio : ratios) {
    int gnc_right = 0;
    int exact_right = 0;
    double largest_gap = 0.0;
    double smallest_gap = std::numeric_limits<double>::infinity();
    std::vector<double> gnc_seconds;
    std::vector<double> exact_seconds;
    for (int seed = 0; seed < num_seeds; ++seed) {
      const MatchedProblem problem = MakeTimProblem(
          kNumTims, ratio, kBound / 3.0, static_cast<std::uint64_t>(seed));
      const double truth = Yaw(problem.true_target_from_source.rotation);
      const auto is_right = [&](double yaw) {
        return std::abs(std::remainder(yaw - truth, 2.0 * M_PI)) <=
               kYawTolerance;
      };
      const Weights weights = Weights::Ones(kNumTims);
      const Weights bounds = Weights::Constant(kNumTims, kBound);
      Stopwatch stopwatch;
      const auto gnc = SolveGnc<TruncatedLeastSquares>(
          QuasiSo3{problem.source, problem.target, kBound}, GncOptions{});
      gnc_seconds.push_back(stopwatch.Lap());
      const auto exact =
          EstimateExactYaw(problem.source, problem.target, weights, bounds);
      exact_seconds.push_back(stopwatch.Lap());
      exact_right += exact && is_right(exact->target_from_source);
      if (gnc.IsUsable()) {
        gnc_right += is_right(gnc.estimate->target_from_source);
        const double gap = TruncatedYawCost(problem.source,
                                            problem.target,
                                            weights,
                                            bounds,
                                            gnc.estimate->target_from_source) -
                           exact->cost;
        largest_gap = std::max(largest_gap, gap);
        smallest_gap = std::min(smallest_gap, gap);
      }
      progress(++num_done, num_problems);
    }
    table.rows.push_back({Number(100.0 * ratio, 0) + " %",
                          Count(gnc_right, num_seeds),
                          Count(exact_right, num_seeds),
                          Number(1e3 * Median(gnc_seconds), 2),
                          Number(1e3 * Median(exact_seconds), 2),
                          Number(largest_gap, 3),
                          Number(smallest_gap, 9)});
  }
  return table;
}

Table RunDegeneracyProtocol(int num_seeds, const Progress& progress) {
  constexpr double kNoiseBound = 0.3;
  constexpr double kTolerance = 5.0 * kDegree;  // Two matches allow no better.
  const std::vector<Eigen::Index> num_true = {1, 2, 3, 5};
  const auto methods = MethodsAt(kNoiseBound);
  const int num_problems = static_cast<int>(num_true.size()) * num_seeds;
  Table table{
      {"estimator", "true of 50", "answers", "correct rotation", "registered"},
      {}};
  std::vector<std::vector<Tally>> tallies(methods.size(),
                                          std::vector<Tally>(num_true.size()));
  int num_done = 0;
  for (std::size_t i = 0; i < num_true.size(); ++i) {
    for (int seed = 0; seed < num_seeds; ++seed) {
      const MatchedProblem problem =
          MakeDegenerateProblem(50,
                                num_true[i],
                                kNoiseBound / 3.0,
                                2.0 * kNoiseBound,
                                static_cast<std::uint64_t>(seed));
      for (std::size_t s = 0; s < methods.size(); ++s) {
        tallies[s][i].Add(methods[s].Solve(problem), problem, kTolerance);
      }
      progress(++num_done, num_problems);
    }
  }
  for (std::size_t s = 0; s < methods.size(); ++s) {
    for (std::size_t i = 0; i < num_true.size(); ++i) {
      const Tally& tally = tallies[s][i];
      table.rows.push_back({methods[s].name,
                            std::to_string(num_true[i]),
                            Count(tally.num_answers, num_seeds),
                            Count(tally.num_correct_rotations, num_seeds),
                            Count(tally.num_registered, num_seeds)});
    }
  }
  return table;
}

Table RunQuasiInlierProtocol(int num_seeds, const Progress& progress) {
  // The noise bound determines how well z can be distinguished, so the table
  // shows a tight and a loose bound.
  const std::vector<double> noise_bounds = {0.1, 0.3};
  const std::vector<Eigen::Index> num_quasi = {20, 60, 180};
  const int num_problems =
      static_cast<int>(noise_bounds.size() * num_quasi.size()) * num_seeds;
  Table table{{"estimator",
               "noise bound m",
               "true/quasi",
               "correct rotation",
               "correct translation"},
              {}};
  int num_done = 0;
  for (const double noise_bound : noise_bounds) {
    const auto methods = MethodsAt(noise_bound);
    std::vector<std::vector<Tally>> tallies(
        methods.size(), std::vector<Tally>(num_quasi.size()));
    for (std::size_t i = 0; i < num_quasi.size(); ++i) {
      for (int seed = 0; seed < num_seeds; ++seed) {
        const MatchedProblem problem =
            MakeQuasiInlierProblem(500,
                                   20,
                                   num_quasi[i],
                                   noise_bound / 3.0,
                                   static_cast<std::uint64_t>(seed));
        for (std::size_t s = 0; s < methods.size(); ++s) {
          tallies[s][i].Add(methods[s].Solve(problem), problem, kYawTolerance);
        }
        progress(++num_done, num_problems);
      }
    }
    for (std::size_t s = 0; s < methods.size(); ++s) {
      for (std::size_t i = 0; i < num_quasi.size(); ++i) {
        const Tally& tally = tallies[s][i];
        table.rows.push_back(
            {methods[s].name,
             Number(noise_bound, 1),
             "20/" + std::to_string(num_quasi[i]),
             Count(tally.num_correct_rotations, num_seeds),
             Count(tally.num_correct_translations, num_seeds)});
      }
    }
  }
  return table;
}

Table RunSizeProtocol(int num_seeds,
                      long max_num_matches,
                      int num_threads,
                      const Progress& progress) {
  std::vector<long> sizes;
  for (long n = 1000; n <= max_num_matches; n *= 10) sizes.push_back(n);
  const std::vector<double> ratios = {0.95, 0.99};
  const int num_problems =
      static_cast<int>(sizes.size() * ratios.size()) * num_seeds;
  Table table{{"matches", "outliers", "correct", "median ms"}, {}};
  int num_done = 0;
  for (const long size : sizes) {
    for (const double ratio : ratios) {
      int num_right = 0;
      std::vector<double> seconds;
      for (int seed = 0; seed < num_seeds; ++seed) {
        const MatchedProblem problem = MakeOutlierProblem(
            size, ratio, 0.1, static_cast<std::uint64_t>(seed));
        ArcConsensusOptions options;
        options.num_threads = num_threads;
        Stopwatch stopwatch;
        const PoseSummary summary =
            SolveArcConsensus(problem.source, problem.target, options);
        seconds.push_back(stopwatch.Lap());
        num_right += HasCorrectRotation(summary, problem, kYawTolerance) &&
                     HasCorrectTranslation(summary, problem);
        progress(++num_done, num_problems);
      }
      table.rows.push_back({std::to_string(size),
                            Number(100.0 * ratio, 0) + " %",
                            Count(num_right, num_seeds),
                            Number(1e3 * Median(seconds), 1)});
    }
  }
  return table;
}

Table RunSlopeProtocol(int num_seeds, const Progress& progress) {
  constexpr double kNoiseBound = 0.3;
  constexpr double kAttitudeStd = 0.3 * kDegree;
  constexpr Eigen::Index kNumMatches = 100;
  const std::vector<Eigen::Index> num_true = {30, 4};
  const std::vector<double> tilts_deg = {2.0, 5.0, 10.0, 15.0};
  const std::vector<std::pair<const char*, InsMode>> modes = {
      {"plain", InsMode::kNone},
      {"relative", InsMode::kRelative},
      {"leveled", InsMode::kLeveled},
      {"fused", InsMode::kFused}};
  Table table{{"INS", "true of 100", "polish"}, {}};
  for (const double tilt_deg : tilts_deg) {
    table.columns.push_back(Number(tilt_deg, 0) + " deg");
  }
  for (const auto& [name, mode] : modes) {
    for (const Eigen::Index n : num_true) {
      table.rows.push_back({name, std::to_string(n), "off"});
      table.rows.push_back({name, std::to_string(n), "on"});
    }
  }
  const int num_problems =
      static_cast<int>(tilts_deg.size() * num_true.size()) * num_seeds;
  int num_done = 0;
  for (const double tilt_deg : tilts_deg) {
    std::vector<std::vector<double>> errors(table.rows.size());
    for (std::size_t i = 0; i < num_true.size(); ++i) {
      for (int seed = 0; seed < num_seeds; ++seed) {
        const SlopeProblem problem = MakeSlopeProblem(
            kNumMatches,
            1.0 - static_cast<double>(num_true[i]) / kNumMatches,
            kNoiseBound / 3.0,
            tilt_deg * kDegree,
            kAttitudeStd,
            static_cast<std::uint64_t>(seed));
        const MatchedProblem& matches = problem.matches;
        for (std::size_t k = 0; k < 2 * modes.size(); ++k) {
          RegistrationOptions options;
          options.noise_bound = kNoiseBound;
          options.quatro.polish = k % 2 == 1;
          options.ins.mode = modes[k / 2].second;
          options.ins.source_attitude = problem.source_attitude;
          options.ins.target_attitude = problem.target_attitude;
          options.ins.attitude_std = kAttitudeStd;
          const PoseSummary summary =
              RegisterMatches({matches.source, matches.target}, options)
                  .solution;
          const std::size_t row = (k / 2 * num_true.size() + i) * 2 + k % 2;
          errors[row].push_back(
              summary.IsUsable()
                  ? AngleBetween(summary.target_from_source->rotation,
                                 matches.true_target_from_source.rotation)
                  : M_PI);
        }
        progress(++num_done, num_problems);
      }
    }
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      const auto num_right = std::count_if(
          errors[row].begin(), errors[row].end(), [](double error) {
            return error <= 1.0 * kDegree;
          });
      table.rows[row].push_back(
          Number(Median(errors[row]) / kDegree, 2) + " (" +
          Count(static_cast<int>(num_right), num_seeds) + ")");
    }
  }
  return table;
}

}  // namespace quatro
