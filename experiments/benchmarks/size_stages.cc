// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "experiments/benchmarks/limits.h"
#include "experiments/benchmarks/peak_memory.h"
#include "experiments/benchmarks/stages.h"
#include "experiments/simulator/synthetic.h"
#include "features/base/simd.h"
#include "robust/estimators/arc_consensus.h"
#include "robust/estimators/quatro.h"
#include "robust/estimators/tims.h"
#include "robust/gnc/gnc.h"
#include "robust/gnc/quasi_so3.h"
#include "robust/gnc/surrogate.h"
#include "robust/graph/consistency_graph.h"
#include "robust/graph/max_clique.h"
#include "solvers/closed_form/exact_yaw.h"
#include "solvers/closed_form/gravity.h"
#include "solvers/closed_form/translation.h"

namespace quatro {
namespace {

constexpr double kNoiseSigma = 0.1;  // [m]
constexpr double kOutlierRatio = 0.95;
constexpr double kArcOutlierRatio = 0.99;
constexpr int kCliqueSize = 200;
constexpr std::uint64_t kSeed = 1;

MatchedProblem MakeProblem(int size, double outlier_ratio) {
  return MakeOutlierProblem(size, outlier_ratio, kNoiseSigma, kSeed);
}

void Add(const std::string& stage,
         const std::string& who,
         const std::string& of_case,
         const std::function<void(benchmark::State&)>& run) {
  const std::string name = stage + "/" + who + "/" + of_case;
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}

// The block exceeds every cache: 256 MiB.
void CopyMemory(benchmark::State& state) {
  const std::size_t size = std::size_t{1} << 28;
  const std::vector<char> from(size, 1);
  std::vector<char> to(size, 2);
  for ([[maybe_unused]] auto _ : state) {
    std::memcpy(to.data(), from.data(), size);
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
  }
  // Each byte is read and written.
  state.SetBytesProcessed(state.iterations() * 2 *
                          static_cast<std::int64_t>(size));
}

// Reports the error of the pose, so that a fast but incorrect answer is
// noticed.
void ReportError(const PoseSummary& summary,
                 const MatchedProblem& problem,
                 benchmark::State* state) {
  if (!summary.IsUsable()) {
    state->SkipWithError(summary.message.c_str());
    return;
  }
  const Rigid3& truth = problem.true_target_from_source;
  const Rigid3& pose = *summary.target_from_source;
  state->counters["error_m"] = (pose.translation - truth.translation).norm();
  state->counters["error_deg"] =
      AngleBetween(pose.rotation, truth.rotation) * 180.0 / M_PI;
}

void BuildGraph(int size, int num_threads, benchmark::State& state) {
  const MatchedProblem problem = MakeProblem(size, kOutlierRatio);
  const ConsistencyOptions options;
  const auto build = [&] {
    benchmark::DoNotOptimize(BuildConsistencyGraph(
        problem.source, problem.target, options, num_threads));
  };
  const auto peak = MeasurePeakMemory(build);
  for ([[maybe_unused]] auto _ : state) build();
  if (peak) state.counters["peak_bytes"] = *peak;
  state.counters["bitset_bytes"] = 0.125 * size * size;
}

void TestPairs(int size, benchmark::State& state) {
  const MatchedProblem problem = MakeProblem(size, kOutlierRatio);
  PairTestLimit limit(
      problem.source, problem.target, ConsistencyOptions().bound);
  for ([[maybe_unused]] auto _ : state) {
    limit.Run(BestSimdLevel());
    benchmark::ClobberMemory();
  }
  state.counters["bitset_bytes"] = static_cast<double>(limit.num_bytes());
}

void FindClique(int size, int num_threads, benchmark::State& state) {
  const MatchedProblem problem = MakeProblem(size, kOutlierRatio);
  const Graph graph = BuildConsistencyGraph(
      problem.source, problem.target, ConsistencyOptions(), num_threads);
  std::size_t clique_size = 0;
  for ([[maybe_unused]] auto _ : state)
    clique_size = FindCliqueGreedily(graph).size();
  state.counters["clique"] = static_cast<double>(clique_size);
}

void RunQuatro(int size, int num_threads, benchmark::State& state) {
  const MatchedProblem problem = MakeProblem(size, kOutlierRatio);
  QuatroOptions options;
  options.num_threads = num_threads;
  QuatroSummary summary;
  for ([[maybe_unused]] auto _ : state) {
    summary = SolveQuatro(problem.source, problem.target, options);
  }
  ReportError(summary, problem, &state);
}

// The stages after the clique, with 5 % outliers: yaw by GNC, the exact yaw,
// and the translation.
void SolveClique(benchmark::State& state) {
  const MatchedProblem problem = MakeProblem(kCliqueSize, 0.05);
  const QuatroOptions options;
  const auto pairs = MakeTimPairs(kCliqueSize, TimLayout::kRing, 0, 0);
  const QuasiSo3 rotation = {ComputeTims(problem.source, pairs),
                             ComputeTims(problem.target, pairs),
                             options.tim_bound_factor * options.noise_bound};
  const Weights weights = Weights::Ones(rotation.NumMeasurements());
  const Weights bounds =
      Weights::Constant(weights.size(), rotation.noise_bound);
  double error = 0.0;
  for ([[maybe_unused]] auto _ : state) {
    const auto gnc = SolveGnc<TruncatedLeastSquares>(rotation, options.gnc);
    const auto exact =
        EstimateExactYaw(rotation.source, rotation.target, weights, bounds);
    double cost = exact->cost;
    benchmark::DoNotOptimize(cost);
    const double yaw = gnc.estimate->target_from_source;
    const auto translation = EstimateTranslation(
        RotationZ(yaw) * problem.source, problem.target, options.noise_bound);
    error = (translation->target_from_source -
             problem.true_target_from_source.translation)
                .norm();
  }
  state.counters["error_m"] = error;
}

void RunArcConsensus(int size, int num_threads, benchmark::State& state) {
  const MatchedProblem problem = MakeProblem(size, kArcOutlierRatio);
  ArcConsensusOptions options;
  options.num_threads = num_threads;
  PoseSummary summary;
  const auto solve = [&] {
    summary = SolveArcConsensus(problem.source, problem.target, options);
  };
  const auto peak = MeasurePeakMemory(solve);
  for ([[maybe_unused]] auto _ : state) solve();
  if (peak) state.counters["peak_bytes"] = *peak;
  ReportError(summary, problem, &state);
}

}  // namespace

void AddSizeStages(const std::vector<int>& sizes, int num_threads) {
  using benchmark::State;
  Add("memory_copy", "limit", "MiB:256", CopyMemory);
  Add("after_clique",
      "quatro",
      "clique:" + std::to_string(kCliqueSize),
      SolveClique);
  for (const int size : sizes) {
    const std::string of_case = "N:" + std::to_string(size);
    if (size <= kMaxGraphSize) {
      Add("graph", "quatro", of_case, [=](State& state) {
        BuildGraph(size, num_threads, state);
      });
      Add("graph", "limit", of_case, [=](State& state) {
        TestPairs(size, state);
      });
      Add("clique", "quatro", of_case, [=](State& state) {
        FindClique(size, num_threads, state);
      });
      Add("quatro_95", "quatro", of_case, [=](State& state) {
        RunQuatro(size, num_threads, state);
      });
    }
    for (const int threads : {1, 2}) {
      Add("arc_consensus_99",
          "quatro",
          of_case + "/threads:" + std::to_string(threads),
          [=](State& state) { RunArcConsensus(size, threads, state); });
    }
  }
}

}  // namespace quatro
