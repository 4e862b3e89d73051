// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "python/methods.h"

namespace quatro {
namespace {

template <auto kOptions>
OptionList ListOptions(EstimatorOptions* options) {
  return OptionsOf(&(options->*kOptions));
}

template <auto kOptions>
bool IsValid(const EstimatorOptions& options, std::string* error) {
  return (options.*kOptions).IsValid(error);
}

// `kSolve` maps matched points and the options to a PoseSummary.
template <auto kOptions, auto kSolve>
PoseSolver Make(const EstimatorOptions& options) {
  return [own = options.*kOptions](const PointsRef& source,
                                   const PointsRef& target) -> PoseSummary {
    return kSolve(source, target, own);
  };
}

OptionList ListExactOptions(EstimatorOptions* options) {
  return OptionsOfExact(&options->quatro);
}

PoseSolver MakeExact(const EstimatorOptions& options) {
  EstimatorOptions exact = options;
  exact.quatro.yaw_solver = YawSolver::kExact;
  return Make<&EstimatorOptions::quatro, SolveQuatro>(exact);
}

RansacSummary SolveRansacWithoutNormals(const PointsRef& source,
                                        const PointsRef& target,
                                        const RansacOptions& options) {
  return SolveRansac(source, target, options);
}

template <auto kOptions, auto kSolve>
Method MakeMethod(const char* name, const char* text, bool takes_ins) {
  return {name,
          text,
          takes_ins,
          ListOptions<kOptions>,
          IsValid<kOptions>,
          Make<kOptions, kSolve>};
}

std::vector<Method> MakeMethods() {
  using Options = EstimatorOptions;
  return {MakeMethod<&Options::quatro, SolveQuatro>(
              "quatro", "clique, yaw by GNC, translation by axis", true),
          {"quatro_exact",
           "quatro with the globally optimal yaw instead of GNC",
           true,
           ListExactOptions,
           IsValid<&Options::quatro>,
           MakeExact},
          MakeMethod<&Options::arc_consensus, SolveArcConsensus>(
              "arc_consensus",
              "no graph: random pairs, exact yaw, translation by axis",
              true),
          MakeMethod<&Options::teaser, SolveTeaser>(
              "teaser",
              "TEASER++: exact clique, SO(3) by GNC, translation by axis",
              false),
          MakeMethod<&Options::fgr, SolveFgr>(
              "fgr", "FGR: SE(3) by a line process with decreasing mu", false),
          MakeMethod<&Options::ransac, SolveRansacWithoutNormals>(
              "ransac", "RANSAC with local optimization", false)};
}

}  // namespace

void EstimatorOptions::ShareCommon() {
  arc_consensus.noise_bound = quatro.noise_bound;
  teaser.noise_bound = quatro.noise_bound;
  fgr.noise_bound = quatro.noise_bound;
  ransac.minimal.noise_bound = quatro.noise_bound;
  arc_consensus.seed = quatro.seed;
  teaser.seed = quatro.seed;
  ransac.seed = quatro.seed;
  arc_consensus.num_threads = quatro.num_threads;
  teaser.num_threads = quatro.num_threads;
  fgr.num_threads = quatro.num_threads;
  ransac.num_threads = quatro.num_threads;
}

const std::vector<Method>& Methods() {
  static const auto* const methods = new std::vector<Method>(MakeMethods());
  return *methods;
}

const Method& FindMethod(const std::string& name) {
  std::string known;
  for (const Method& method : Methods()) {
    if (method.name == name) return method;
    known += (known.empty() ? "" : ", ") + method.name;
  }
  throw pybind11::value_error("method = \"" + name + "\", must be one of " +
                              known);
}

}  // namespace quatro
