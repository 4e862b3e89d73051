// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/methods.h"

#include <iterator>
#include <utility>

namespace quatro {
namespace {

// The number of matches above which a consistency graph costs too much.
constexpr Eigen::Index kMaxGraphMatches = 20000;

// `kSolve` takes matched points and the estimator's options.
template <auto kOptions, auto kSolve>
PoseSolver Make(const RegistrationOptions& options) {
  return [own = options.*kOptions](const PointsRef& source,
                                   const PointsRef& target) -> PoseSummary {
    return kSolve(source, target, own);
  };
}

constexpr auto kMakeQuatro = Make<&RegistrationOptions::quatro, SolveQuatro>;
constexpr auto kMakeArcConsensus =
    Make<&RegistrationOptions::arc_consensus, SolveArcConsensus>;
constexpr auto kMakeConsensus =
    Make<&RegistrationOptions::consensus, SolveConsensusPose>;
constexpr auto kMakeTeaser = Make<&RegistrationOptions::teaser, SolveTeaser>;
constexpr auto kMakeFgr = Make<&RegistrationOptions::fgr, SolveFgr>;

PoseSolver MakeRansac(const RegistrationOptions& options) {
  return [own = options.ransac](const PointsRef& source,
                                const PointsRef& target) -> PoseSummary {
    return SolveRansac(source, target, own);
  };
}

PoseSolver MakeAuto(const RegistrationOptions& options) {
  return [few = kMakeQuatro(options), many = kMakeArcConsensus(options)](
             const PointsRef& source, const PointsRef& target) {
    return (source.cols() > kMaxGraphMatches ? many : few)(source, target);
  };
}

OptionList NoOptions(RegistrationOptions*) { return {}; }

void TakeExactYaw(RegistrationOptions* options) {
  options->quatro.yaw_solver = YawSolver::kExact;
}

void RefineByGicp(RegistrationOptions* options) {
  options->refinement.method = RefinementMethod::kGicp;
}

template <int num>
void LimitIterations(RegistrationOptions* options) {
  options->ransac.max_iterations = num;
}

template <RefinementMethod method>
void AlignBy(RegistrationOptions* options) {
  options->refinement.method = method;
}

using enum MethodInput;
using enum InsUse;

constexpr Method kMethods[] = {
    {"auto",
     "quatro; above 20,000 matches arc_consensus",
     kMatches,
     kTaken,
     true,
     QuatroOptionList,
     MakeAuto,
     nullptr},
    {"quatro",
     "clique, yaw by GNC, translation by axis",
     kMatches,
     kTaken,
     true,
     QuatroOptionList,
     kMakeQuatro,
     nullptr},
    {"quatro_single",
     "quatro without a search if its pose is not registered",
     kMatches,
     kTaken,
     false,
     QuatroOptionList,
     kMakeQuatro,
     nullptr},
    {"quatro_exact",
     "quatro with the global optimum of the yaw in place of GNC",
     kMatches,
     kTaken,
     true,
     QuatroExactOptionList,
     kMakeQuatro,
     TakeExactYaw},
    {"quatro_ins",
     "quatro with roll and pitch of an INS, which must be given",
     kMatches,
     kNeeded,
     true,
     QuatroOptionList,
     kMakeQuatro,
     nullptr},
    {"arc_consensus",
     "no graph: random pairs, exact yaw, translation by axis",
     kMatches,
     kTaken,
     false,
     ArcConsensusOptionList,
     kMakeArcConsensus,
     nullptr},
    {"consensus",
     "no graph: votes of all matches over yaw and translation",
     kMatches,
     kTaken,
     false,
     ConsensusOptionList,
     kMakeConsensus,
     nullptr},
    {"teaser",
     "TEASER++: exact clique, SO(3) by GNC, translation by axis",
     kMatches,
     kRefused,
     false,
     TeaserOptionList,
     kMakeTeaser,
     nullptr},
    {"fgr",
     "FGR: SE(3) by a line process, mu falling",
     kMatches,
     kRefused,
     false,
     FgrOptionList,
     kMakeFgr,
     nullptr},
    {"ransac",
     "RANSAC with local optimization",
     kMatches,
     kRefused,
     false,
     RansacOptionList,
     MakeRansac,
     nullptr},
    {"ransac1k",
     "RANSAC: three points, 1,000 samples at most",
     kMatches,
     kRefused,
     false,
     NoOptions,
     MakeRansac,
     LimitIterations<1000>},
    {"ransac10k",
     "RANSAC: three points, 10,000 samples at most",
     kMatches,
     kRefused,
     false,
     NoOptions,
     MakeRansac,
     LimitIterations<10'000>},
    {"quatro_c2f",
     "quatro, then G-ICP from its pose",
     kMatchedClouds,
     kRefused,
     true,
     QuatroOptionList,
     kMakeQuatro,
     RefineByGicp},
    {"icp",
     "clouds: point to point, from the guess or no motion",
     kClouds,
     kRefused,
     false,
     NoOptions,
     nullptr,
     AlignBy<RefinementMethod::kIcp>},
    {"gicp",
     "clouds: plane to plane, from the guess or no motion",
     kClouds,
     kRefused,
     false,
     NoOptions,
     nullptr,
     AlignBy<RefinementMethod::kGicp>},
    {"vgicp",
     "clouds: plane to planes of voxels, from the guess or no motion",
     kClouds,
     kRefused,
     false,
     NoOptions,
     nullptr,
     AlignBy<RefinementMethod::kVgicp>},
};

std::string NamesThatTakeIns() {
  std::string names;
  for (const Method& method : kMethods) {
    if (method.ins == kRefused) continue;
    names += (names.empty() ? "" : ", ") + std::string(method.name);
  }
  return names;
}

}  // namespace

std::span<const Method> Methods() { return kMethods; }

std::vector<std::string> MethodNames(MethodInput input) {
  std::vector<std::string> names;
  for (const Method& method : kMethods) {
    if (method.input == input) names.emplace_back(method.name);
  }
  return names;
}

const Method* FindMethod(const std::string& name, std::string* error) {
  std::string known;
  for (const Method& method : kMethods) {
    if (name == method.name) return &method;
    known += (known.empty() ? "" : ", ") + std::string(method.name);
  }
  *error = "method = " + name + ", must be one of " + known;
  return nullptr;
}

OptionList OptionsOf(const Method& method,
                     bool has_clouds,
                     RegistrationOptions* options) {
  OptionList list = CommonOptions(options);
  if (has_clouds) {
    Append(FrontEndOptionList(options), &list);
    Append(RefinementOptionList(options), &list);
    if (method.searches) Append(SearchOptionList(options), &list);
  }
  if (method.input == kClouds) {
    std::erase_if(list, [](const Option& o) {
      return o.name != "num_threads" && o.name != "voxel_size";
    });
  } else if (method.input == kMatchedClouds) {
    std::erase_if(list, [](const Option& o) { return o.name == "refine"; });
  }
  Append(method.options(options), &list);
  if (method.ins != kRefused) Append(InsOptionList(options), &list);
  Append(BoundsOptionList(options), &list);
  return list;
}

bool CanUseIns(const Method& method,
               const InsOptions& ins,
               std::string* error) {
  if (!ins.IsValid(error)) return false;
  const std::string name = method.name;
  if (method.ins == kNeeded && ins.mode == InsMode::kNone) {
    *error = "method " + name +
             " needs an INS: set ins_mode to relative, leveled or fused, and "
             "give source_rpy and target_rpy";
    return false;
  }
  if (method.ins == kRefused && !ins.IsPlain()) {
    *error = std::string(ins.mode == InsMode::kNone ? "gravity" : "ins_mode") +
             " needs one of the methods " + NamesThatTakeIns() + ", not " +
             name;
    return false;
  }
  return true;
}

}  // namespace quatro
