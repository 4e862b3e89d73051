// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <benchmark/benchmark.h>
#include <gflags/gflags.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/base/number_text.h"
#include "experiments/base/outputs.h"
#include "experiments/benchmarks/pair_input.h"
#include "experiments/benchmarks/stages.h"
#include "experiments/programs/flag_problems.h"
#include "experiments/programs/program.h"
#include "experiments/runner/build_info.h"
#include "experiments/simulator/pair_sets.h"
#include "features/base/simd.h"
#include "features/io/cloud_io.h"
#include "features/voxel_grid.h"

DEFINE_string(source,
              "",
              "Source cloud, the one to move: .bin (KITTI), .ply, .pcd, ...");
DEFINE_string(target,
              "",
              "Target cloud; without source and target: a simulated street");
DEFINE_string(preset, "kitti", "Preset, as in quatro_register");
DEFINE_string(sizes,
              "1000,3000,10000,30000,50000,100000,300000,1000000",
              "Numbers of matches for the estimators; graphs up to 50000");
DEFINE_int32(threads, 1, "Threads, unless a name states them; 0: one per core");

namespace {

constexpr char kUsage[] =
    "measures the time of every stage, of other libraries that are built in,\n"
    "and of the best the machine can do.\n"
    "\n"
    "  quatro_benchmark --source=a.bin --target=b.bin --benchmark_out=ab.json\n"
    "  experiments/scripts/tabulate_benchmark.py ab.json\n"
    "\n"
    "Names are stage/who[/case]. Google Benchmark provides the flags\n"
    "--benchmark_...: "
    "_filter=REGEX, _min_time=SECONDS, _repetitions=N, _out=FILE (JSON),\n"
    "_list_tests.\n"
    "Exits with 0 when done; 2 if a flag or a file is invalid.";

constexpr int kMaxSize = 10'000'000;
constexpr int kMaxRepetitions = 100'000;

bool IsOfBenchmark(std::string_view arg) {
  const auto begin = arg.find_first_not_of('-');
  return begin != arg.npos && arg.substr(begin).starts_with("benchmark_");
}

// Returns the value of the last --benchmark_`name`=..., which takes precedence;
// empty if it is not given.
std::string BenchmarkFlag(const std::vector<std::string>& args,
                          const std::string& name) {
  std::string value;
  for (const std::string& arg : args) {
    const auto equals = arg.find('=');
    if (equals != arg.npos &&
        arg.substr(0, equals).ends_with("benchmark_" + name)) {
      value = arg.substr(equals + 1);
    }
  }
  return value;
}

// Checks the flags that Google Benchmark would handle differently from us.
bool AreValid(const std::vector<std::string>& args, std::string* error) {
  const std::string min_time = BenchmarkFlag(args, "min_time");
  const auto seconds = quatro::ParseFiniteNumber(min_time);
  if (!min_time.empty() && !(seconds && *seconds >= 0.0)) {
    *error = "--benchmark_min_time=" + min_time + ", must be a number >= 0";
    return false;
  }
  const std::string repetitions = BenchmarkFlag(args, "repetitions");
  const auto count = quatro::ParseFiniteNumber(repetitions);
  if (!repetitions.empty() && !(count && *count == std::floor(*count) &&
                                *count >= 1 && *count <= kMaxRepetitions)) {
    *error = "--benchmark_repetitions=" + repetitions +
             ", must be a whole number from 1 to 100000";
    return false;
  }
  for (const char* name : {"format", "out_format"}) {
    const std::string format = BenchmarkFlag(args, name);
    if (format.empty() || format == "json" || format == "console" ||
        format == "csv") {
      continue;
    }
    *error = std::string("--benchmark_") + name + "=" + format +
             ", must be json, console or csv";
    return false;
  }
  return true;
}

std::optional<std::vector<int>> ParseSizes(std::string* error) {
  std::vector<int> sizes;
  for (const std::string_view field : quatro::SplitFields(FLAGS_sizes, ",")) {
    const auto size = quatro::ParseFiniteNumber(field);
    if (!size || *size != std::floor(*size) || *size < 3 || *size > kMaxSize) {
      *error = "--sizes=" + FLAGS_sizes +
               ", must be whole numbers from 3 to 10000000";
      return std::nullopt;
    }
    sizes.push_back(static_cast<int>(*size));
  }
  return sizes;
}

// Returns whether two files can be registered at all.
bool CanUse(const std::string& path,
            const quatro::PointCloud& cloud,
            double voxel_size,
            std::string* error) {
  if (cloud.points.cols() == 0) {
    *error = path + ": has no points";
    return false;
  }
  std::string problem;
  if (quatro::SampleVoxels(cloud.points, voxel_size, &problem)) return true;
  *error = path + ": " + problem;
  return false;
}

const char* SimdName() {
  switch (quatro::BestSimdLevel()) {
    case quatro::SimdLevel::kAvx512:
      return "AVX-512";
    case quatro::SimdLevel::kAvx2:
      return "AVX2";
    case quatro::SimdLevel::kBaseline:
      break;
  }
  return "baseline";
}

// The arguments for this program and for Google Benchmark.
struct Arguments {
  std::vector<char*> ours;
  std::vector<char*> theirs;
  std::vector<std::string> their_texts;
};

Arguments SplitArguments(int argc, char** argv) {
  Arguments arguments{{argv[0]}, {argv[0]}, {}};
  for (int i = 1; i < argc; ++i) {
    if (!IsOfBenchmark(argv[i])) {
      arguments.ours.push_back(argv[i]);
      continue;
    }
    // Google Benchmark has another flag for JSON on standard output.
    static char on_standard_output[] = "--benchmark_format=json";
    const bool is_dash = std::string_view(argv[i]).ends_with("benchmark_out=-");
    arguments.theirs.push_back(is_dash ? on_standard_output : argv[i]);
    arguments.their_texts.emplace_back(arguments.theirs.back());
  }
  return arguments;
}

// The clouds of --source and --target. Both are nullopt if a pair is to be
// simulated.
struct NamedClouds {
  std::optional<quatro::PointCloud> source;
  std::optional<quatro::PointCloud> target;
};

bool ReadNamedClouds(double voxel_size,
                     NamedClouds* clouds,
                     std::string* error) {
  if (FLAGS_source.empty() != FLAGS_target.empty()) {
    *error = (FLAGS_source.empty() ? "--source" : "--target") +
             std::string(
                 " is empty, but the other cloud is named; name "
                 "both, or neither for a simulated pair");
    return false;
  }
  if (FLAGS_source.empty()) return true;
  clouds->source = quatro::ReadCloud(FLAGS_source, error);
  if (!clouds->source) return false;
  clouds->target = quatro::ReadCloud(FLAGS_target, error);
  if (!clouds->target) return false;
  return CanUse(FLAGS_source, *clouds->source, voxel_size, error) &&
         CanUse(FLAGS_target, *clouds->target, voxel_size, error);
}

// The clouds and the results of all stages. Simulates a pair if no clouds are
// named.
std::unique_ptr<const quatro::PairInput> MakePair(
    NamedClouds clouds, const quatro::RegistrationOptions& options) {
  if (!clouds.source) {
    // The default options are valid.
    std::string ignored;
    auto simulated = quatro::SimulateSetPair({}, 0, &ignored);
    clouds.source = std::move(simulated->source);
    clouds.target = std::move(simulated->target);
  }
  auto pair = std::make_unique<const quatro::PairInput>(
      quatro::MakePairInput(*clouds.source, *clouds.target, options));
  std::fprintf(stderr,
               "%td and %td voxels, %td matches, %s: %s\n",
               pair->clouds[0].voxels.cols(),
               pair->clouds[1].voxels.cols(),
               pair->matched.matched_source.cols(),
               quatro::StatusName(pair->summary.verdict.status),
               pair->summary.verdict.reason.c_str());
  return pair;
}

void AddContext() {
  const quatro::BuildInfo build = quatro::GetBuildInfo();
  benchmark::AddCustomContext("version", build.version + " " + build.commit);
  benchmark::AddCustomContext("compiler", build.compiler);
  benchmark::AddCustomContext("cpu", quatro::GetMachineInfo().cpu);
  benchmark::AddCustomContext("simd", SimdName());
  benchmark::AddCustomContext("threads", std::to_string(FLAGS_threads));
  benchmark::AddCustomContext("preset", FLAGS_preset);
  benchmark::AddCustomContext("pair",
                              FLAGS_source.empty()
                                  ? "simulated"
                                  : FLAGS_source + " -> " + FLAGS_target);
}

int Main(int argc, char** argv) {
  using quatro::Fail;
  Arguments arguments = SplitArguments(argc, argv);
  int num_theirs = static_cast<int>(arguments.theirs.size());
  const int num_ours = static_cast<int>(arguments.ours.size());
  arguments.ours.push_back(nullptr);
  arguments.theirs.push_back(nullptr);
  if (const auto exit_code =
          quatro::ParseFlags(kUsage, num_ours, arguments.ours.data())) {
    return *exit_code;
  }

  std::string error;
  const auto sizes = ParseSizes(&error);
  if (!sizes || !AreValid(arguments.their_texts, &error)) return Fail(error);
  auto options = quatro::FindPreset(FLAGS_preset, &error);
  if (!options) return Fail(error);
  options->num_threads = FLAGS_threads;
  if (!options->IsValid(&error)) return Fail(error);
  const std::string out = BenchmarkFlag(arguments.their_texts, "out");
  if (!out.empty() &&
      !quatro::CanWriteAll(
          {{"benchmark_out", out}}, {FLAGS_source, FLAGS_target}, &error)) {
    return Fail(error);
  }
  NamedClouds clouds;
  if (!ReadNamedClouds(options->front_end.voxel_size, &clouds, &error)) {
    return Fail(error);
  }

  benchmark::Initialize(&num_theirs, arguments.theirs.data());
  if (num_theirs > 1) {
    return Fail(std::string(arguments.theirs[1]) + ": not a flag");
  }
  std::unique_ptr<const quatro::PairInput> pair;
  quatro::AddPairStages([&]() -> const quatro::PairInput& {
    if (!pair) pair = MakePair(std::move(clouds), *options);
    return *pair;
  });
  quatro::AddSizeStages(*sizes, FLAGS_threads);
  AddContext();
  const std::size_t num_run = benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  // Google Benchmark has printed the reason: the filter matches nothing or is
  // not a valid regular expression.
  return num_run == 0 ? quatro::kExitBadInput : quatro::kExitDone;
}

}  // namespace

int main(int argc, char** argv) { return quatro::RunProgram(Main, argc, argv); }
