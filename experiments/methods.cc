// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/methods.h"

#include "robust/arc_consensus.h"
#include "robust/local_registration.h"
#include "robust/teaser.h"

namespace quatro {
namespace {

// Matches above which a graph of them no longer pays.
constexpr Eigen::Index kMaxGraphMatches = 20000;

PoseSolver MakeQuatro(const QuatroOptions& options) {
  return [options](const PointsRef& source, const PointsRef& target) {
    return SolveQuatro(source, target, options);
  };
}

PoseSolver MakeQuatroExact(QuatroOptions options) {
  options.yaw_solver = YawSolver::kExact;
  return MakeQuatro(options);
}

PoseSolver MakeArcConsensus(const QuatroOptions& options) {
  ArcConsensusOptions arc;
  arc.noise_bound = options.noise_bound;
  arc.max_tilt = options.max_tilt;
  arc.seed = options.seed;
  arc.num_threads = options.num_threads;
  return [arc](const PointsRef& source, const PointsRef& target) {
    return SolveArcConsensus(source, target, arc);
  };
}

PoseSolver MakeTeaser(const QuatroOptions& options) {
  TeaserOptions teaser;
  teaser.noise_bound = options.noise_bound;
  teaser.crosscheck = options.crosscheck;
  teaser.seed = options.seed;
  teaser.num_threads = options.num_threads;
  return [teaser](const PointsRef& source, const PointsRef& target) {
    return SolveTeaser(source, target, teaser);
  };
}

PoseSolver MakeAuto(const QuatroOptions& options) {
  const PoseSolver few = MakeQuatro(options);
  const PoseSolver many = MakeArcConsensus(options);
  return [few, many](const PointsRef& source, const PointsRef& target) {
    return (source.cols() > kMaxGraphMatches ? many : few)(source, target);
  };
}

RegistrationSummary RegisterCoarseToFine(const PointCloud& source,
                                         const PointCloud& target,
                                         const RegistrationOptions& options) {
  RegistrationOptions c2f = options;
  c2f.solver = MakeQuatro(options.quatro);
  c2f.refinement.method = RefinementMethod::kGicp;
  return Register(source, target, c2f);
}

// From no motion as the guess.
template <RefinementMethod method>
RegistrationSummary RegisterFromIdentity(const PointCloud& source,
                                         const PointCloud& target,
                                         const RegistrationOptions& options) {
  RegistrationOptions local = options;
  local.refinement.method = method;
  return RegisterLocally(source, target, Rigid3(), local);
}

// From matches, `make`, or else from clouds, `register_clouds`.
struct Method {
  const char* name;
  const char* description;
  PoseSolver (*make)(const QuatroOptions& options);
  RegistrationSummary (*register_clouds)(const PointCloud& source,
                                         const PointCloud& target,
                                         const RegistrationOptions& options) =
      nullptr;
};

constexpr Method kMethods[] = {
    {"auto", "quatro; above 20,000 matches arc_consensus", MakeAuto},
    {"quatro", "clique, yaw by GNC, translation by axis", MakeQuatro},
    {"quatro_exact",
     "the same with the yaw's global optimum in place of GNC",
     [](const QuatroOptions& options) { return MakeQuatroExact(options); }},
    {"arc_consensus",
     "no graph: random pairs, exact yaw, translation by axis",
     MakeArcConsensus},
    {"teaser",
     "TEASER++: exact clique, SO(3) by GNC, translation by axis",
     MakeTeaser},
    {"quatro_c2f",
     "clouds: quatro, then G-ICP from its pose",
     nullptr,
     RegisterCoarseToFine},
    {"icp",
     "clouds: point to point from no motion",
     nullptr,
     RegisterFromIdentity<RefinementMethod::kIcp>},
    {"gicp",
     "clouds: plane to plane from no motion",
     nullptr,
     RegisterFromIdentity<RefinementMethod::kGicp>},
    {"vgicp",
     "clouds: plane to voxels' planes from no motion",
     nullptr,
     RegisterFromIdentity<RefinementMethod::kVgicp>},
};

}  // namespace

std::vector<std::string> MethodNames() {
  std::vector<std::string> names;
  for (const Method& method : kMethods) {
    if (method.make) names.emplace_back(method.name);
  }
  return names;
}

std::vector<std::string> CloudMethodNames() {
  std::vector<std::string> names;
  for (const Method& method : kMethods) {
    if (method.register_clouds) names.emplace_back(method.name);
  }
  return names;
}

std::string DescribeMethods() {
  std::string text;
  for (const Method& method : kMethods) {
    std::string name = method.name;
    name.resize(16, ' ');
    text += name + method.description + "\n";
  }
  return text;
}

PoseSolver MakeSolver(const std::string& name,
                      const QuatroOptions& options,
                      std::string* error) {
  for (const Method& method : kMethods) {
    if (name != method.name) continue;
    if (method.make) return method.make(options);
    *error = "--method=" + name + " works on clouds, not on matches";
    return nullptr;
  }
  *error = "--method=" + name + ", must be one of";
  for (const Method& method : kMethods) {
    *error += std::string(" ") + method.name;
  }
  return nullptr;
}

CloudSolver FindCloudSolver(const std::string& name) {
  for (const Method& method : kMethods) {
    if (name == method.name && method.register_clouds) {
      return method.register_clouds;
    }
  }
  return nullptr;
}

bool ParseRefinement(const std::string& text,
                     RefinementMethod* method,
                     std::string* error) {
  for (const RefinementMethod known : {RefinementMethod::kNone,
                                       RefinementMethod::kIcp,
                                       RefinementMethod::kGicp,
                                       RefinementMethod::kVgicp}) {
    if (text != RefinementName(known)) continue;
    *method = known;
    return true;
  }
  *error = "--refine=" + text + ", must be none, icp, gicp or vgicp";
  return false;
}

bool ApplySwitch(const std::string& flag,
                 const std::string& text,
                 bool* option,
                 std::string* error) {
  if (text == "on" || text == "off") {
    *option = text == "on";
  } else if (!text.empty()) {
    *error = "--" + flag + "=" + text + ", must be on or off";
    return false;
  }
  return true;
}

}  // namespace quatro
