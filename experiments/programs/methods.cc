// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/methods.h"

#include <algorithm>

#ifdef QUATRO_WITH_OPEN3D
#include "experiments/peers/open3d.h"
#include "experiments/peers/open3d_fpfh.h"
#include "experiments/peers/open3d_icp.h"
#endif
#ifdef QUATRO_WITH_PCL
#include "experiments/peers/pcl_fpfh.h"
#include "experiments/peers/pcl_icp.h"
#include "experiments/peers/pcl_ransac.h"
#endif
#include "robust/estimators/arc_consensus.h"
#include "robust/estimators/fgr.h"
#include "robust/estimators/ransac.h"
#include "robust/estimators/teaser.h"
#include "robust/registration/local_registration.h"

namespace quatro {
namespace {

// Above this number of matches, a consistency graph is too expensive.
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

PoseSolver MakeRansac(const QuatroOptions& options,
                      std::int64_t max_iterations) {
  RansacOptions ransac;
  ransac.minimal.noise_bound = options.noise_bound;
  ransac.minimal.max_tilt = options.max_tilt;
  ransac.max_iterations = max_iterations;
  ransac.seed = options.seed;
  ransac.num_threads = options.num_threads;
  return [ransac](const PointsRef& source, const PointsRef& target) {
    return SolveRansac(source, target, ransac);
  };
}

PoseSolver MakeFgr(const QuatroOptions& options) {
  FgrOptions fgr;
  fgr.noise_bound = options.noise_bound;
  fgr.num_threads = options.num_threads;
  return [fgr](const PointsRef& source, const PointsRef& target) {
    return SolveFgr(source, target, fgr);
  };
}

PoseSolver MakeAuto(const QuatroOptions& options) {
  const PoseSolver few = MakeQuatro(options);
  const PoseSolver many = MakeArcConsensus(options);
  return [few, many](const PointsRef& source, const PointsRef& target) {
    return (source.cols() > kMaxGraphMatches ? many : few)(source, target);
  };
}

#ifdef QUATRO_WITH_OPEN3D
PoseSolver MakeOpen3dFgr(const QuatroOptions& options) {
  Open3dFgrOptions fgr;
  fgr.seed = options.seed;
  return [fgr, bound = options.noise_bound](const PointsRef& source,
                                            const PointsRef& target) {
    return SolveByOpen3dFgr(source, target, bound, fgr);
  };
}

PoseSolver MakeOpen3dRansac(const QuatroOptions& options) {
  Open3dRansacOptions ransac;
  ransac.seed = options.seed;
  return [ransac, bound = options.noise_bound](const PointsRef& source,
                                               const PointsRef& target) {
    return SolveByOpen3dRansac(source, target, bound, ransac);
  };
}
#endif

#ifdef QUATRO_WITH_PCL
PoseSolver MakePclRansac(const QuatroOptions& options) {
  PclRansacOptions ransac;
  ransac.seed = options.seed;
  return [ransac, bound = options.noise_bound](const PointsRef& source,
                                               const PointsRef& target) {
    return SolveByPclRansac(source, target, bound, ransac);
  };
}
#endif

RegistrationSummary RefineQuatro(const MatchedClouds& matched,
                                 const RegistrationOptions& options) {
  RegistrationOptions c2f = options;
  c2f.solver = MakeQuatro(options.quatro);
  c2f.refinement.method = RefinementMethod::kGicp;
  return RegisterMatched(matched, c2f);
}

template <RefinementMethod method>
RegistrationSummary RegisterFromGuess(const PointCloud& source,
                                      const PointCloud& target,
                                      const Rigid3& target_from_source_guess,
                                      const RegistrationOptions& options) {
  RegistrationOptions local = options;
  local.refinement.method = method;
  return RegisterLocally(source, target, target_from_source_guess, local);
}

#if defined(QUATRO_WITH_OPEN3D) || defined(QUATRO_WITH_PCL)
using Aligner = AlignmentSummary (*)(const Points& source,
                                     const Points& target,
                                     const Rigid3& initial_target_from_source,
                                     const RefinementOptions& options);

template <Aligner align, RefinementMethod method>
RegistrationSummary RegisterByPeer(const PointCloud& source,
                                   const PointCloud& target,
                                   const Rigid3& target_from_source_guess,
                                   const RegistrationOptions& options) {
  RegistrationOptions local = options;
  local.refinement.method = method;
  return RegisterLocally(
      source, target, target_from_source_guess, local, align);
}

using Describer = Fpfh (*)(const Points& points,
                           const Points& normals,
                           double radius);

template <Describer describe>
RegistrationSummary RegisterByPeerFpfh(const PointCloud& source,
                                       const PointCloud& target,
                                       const Rigid3&,
                                       const RegistrationOptions& options) {
  RegistrationOptions described = options;
  described.solver = nullptr;  // quatro
  described.front_end.describe = describe;
  return Register(source, target, described);
}
#endif

RegistrationSummary RegisterBy(
    const std::function<PoseSolver(const QuatroOptions&)>& make,
    const MatchedClouds& matched,
    const RegistrationOptions& options) {
  QuatroOptions quatro = options.quatro;
  quatro.seed = options.seed;
  quatro.num_threads = options.num_threads;
  RegistrationOptions solved = options;
  solved.solver = make(quatro);
  return RegisterMatched(matched, solved);
}

enum class Ins { kRefused, kTaken, kNeeded };

// A method has `make` if it works on matches, `register_matched` if it works on
// clouds and their matches, `register_clouds` if it works on clouds alone, and
// none of them if it is an odometry (experiments/odometry/odometry_methods.h).
struct Method {
  const char* name;
  const char* description;
  PoseSolver (*make)(const QuatroOptions& options);
  Ins ins = Ins::kRefused;
  RegistrationSummary (*register_clouds)(const PointCloud& source,
                                         const PointCloud& target,
                                         const Rigid3& target_from_source_guess,
                                         const RegistrationOptions& options) =
      nullptr;
  RegistrationSummary (*register_matched)(const MatchedClouds& matched,
                                          const RegistrationOptions& options) =
      nullptr;

  bool WorksOnClouds() const { return register_clouds || register_matched; }
  bool IsOdometry() const { return !make && !WorksOnClouds(); }
};

constexpr Method kMethods[] = {
    {"auto",
     "quatro; arc_consensus above 20,000 matches",
     MakeAuto,
     Ins::kTaken},
    {"quatro",
     "clique, yaw by GNC, translation by axis",
     MakeQuatro,
     Ins::kTaken},
    {"quatro_exact",
     "quatro with the globally optimal yaw instead of GNC",
     [](const QuatroOptions& options) { return MakeQuatroExact(options); },
     Ins::kTaken},
    {"quatro_ins",
     "quatro with roll and pitch of an INS (required)",
     MakeQuatro,
     Ins::kNeeded},
    {"arc_consensus",
     "no graph: random pairs, exact yaw, translation by axis",
     MakeArcConsensus,
     Ins::kTaken},
    {"teaser",
     "TEASER++: exact clique, SO(3) by GNC, translation by axis",
     MakeTeaser},
    {"fgr", "FGR: SE(3) by a line process with decreasing mu", MakeFgr},
    {"ransac1k",
     "RANSAC: three points, at most 1,000 samples",
     [](const QuatroOptions& options) { return MakeRansac(options, 1000); }},
    {"ransac10k",
     "RANSAC: three points, at most 10,000 samples",
     [](const QuatroOptions& options) { return MakeRansac(options, 10'000); }},
#ifdef QUATRO_WITH_OPEN3D
    {"open3d_fgr", "FGR of Open3D, on the same matches", MakeOpen3dFgr},
    {"open3d_ransac",
     "RANSAC of Open3D, at most 10,000 samples",
     MakeOpen3dRansac},
#endif
#ifdef QUATRO_WITH_PCL
    {"pcl_ransac", "RANSAC of PCL, at most 10,000 samples", MakePclRansac},
#endif
    {"quatro_c2f",
     "clouds: quatro, then G-ICP from its pose",
     nullptr,
     Ins::kRefused,
     nullptr,
     RefineQuatro},
    {"icp",
     "clouds: point to point, starting at the identity",
     nullptr,
     Ins::kRefused,
     RegisterFromGuess<RefinementMethod::kIcp>},
    {"gicp",
     "clouds: plane to plane, starting at the identity",
     nullptr,
     Ins::kRefused,
     RegisterFromGuess<RefinementMethod::kGicp>},
    {"vgicp",
     "clouds: plane to voxel planes, starting at the identity",
     nullptr,
     Ins::kRefused,
     RegisterFromGuess<RefinementMethod::kVgicp>},
#ifdef QUATRO_WITH_OPEN3D
    {"open3d_icp",
     "clouds: ICP of Open3D, starting at the identity, same voxels",
     nullptr,
     Ins::kRefused,
     RegisterByPeer<AlignByOpen3d, RefinementMethod::kIcp>},
    {"open3d_gicp",
     "clouds: G-ICP of Open3D, starting at the identity, same voxels",
     nullptr,
     Ins::kRefused,
     RegisterByPeer<AlignByOpen3d, RefinementMethod::kGicp>},
    {"open3d_fpfh",
     "clouds: quatro on matches of Open3D's FPFH, same normals",
     nullptr,
     Ins::kRefused,
     RegisterByPeerFpfh<ComputeFpfhByOpen3d>},
#endif
#ifdef QUATRO_WITH_PCL
    {"pcl_icp",
     "clouds: ICP of PCL, starting at the identity, same voxels",
     nullptr,
     Ins::kRefused,
     RegisterByPeer<AlignByPcl, RefinementMethod::kIcp>},
    {"pcl_gicp",
     "clouds: G-ICP of PCL, starting at the identity, same voxels",
     nullptr,
     Ins::kRefused,
     RegisterByPeer<AlignByPcl, RefinementMethod::kGicp>},
    {"pcl_fpfh",
     "clouds: quatro on matches of PCL's FPFH, same normals",
     nullptr,
     Ins::kRefused,
     RegisterByPeerFpfh<ComputeFpfhByPcl>},
#endif
    {"aloam",
     "odometry (quatro_odometry): edges and planes, like A-LOAM",
     nullptr},
    {"suma",
     "odometry (quatro_odometry): surfels, projective, like SuMa",
     nullptr},
};

// The names of the methods that take an INS: "auto, quatro, ...".
std::string NamesThatTakeIns() {
  std::string names;
  for (const Method& method : kMethods) {
    if (method.ins == Ins::kRefused) continue;
    names += (names.empty() ? "" : ", ") + std::string(method.name);
  }
  return names;
}

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
    if (method.WorksOnClouds()) names.emplace_back(method.name);
  }
  return names;
}

std::vector<std::string> OdometryMethodNames() {
  std::vector<std::string> names;
  for (const Method& method : kMethods) {
    if (method.IsOdometry()) names.emplace_back(method.name);
  }
  return names;
}

std::string DescribeMethods(const std::vector<OwnMethod>& own) {
  std::string text;
  const auto describe = [&text](std::string name,
                                const std::string& description) {
    name.resize(std::max<std::size_t>(name.size() + 1, 16), ' ');
    text += name + description + "\n";
  };
  for (const Method& method : kMethods) {
    describe(method.name, method.description);
  }
  for (const OwnMethod& method : own) describe(method.name, method.description);
  return text;
}

PoseSolver MakeLevelSolver(const std::string& name,
                           const QuatroOptions& options,
                           const InsOptions& ins,
                           std::string* error) {
  for (const Method& method : kMethods) {
    if (name != method.name) continue;
    if (method.IsOdometry()) {
      *error =
          "--method=" + name +
          " is an odometry and needs successive scans: run quatro_odometry";
      return nullptr;
    }
    if (!method.make) {
      *error = "--method=" + name + " works on clouds, not on matches";
      return nullptr;
    }
    if (!ins.IsValid(error)) return nullptr;
    if (method.ins == Ins::kNeeded && ins.mode == InsMode::kNone) {
      *error = "--method=" + name +
               " needs an INS: --ins_mode=relative, leveled or fused, "
               "--source_rpy_deg and --target_rpy_deg";
      return nullptr;
    }
    if (method.ins == Ins::kRefused && !ins.IsPlain()) {
      *error =
          std::string(ins.mode == InsMode::kNone ? "--gravity" : "--ins_mode") +
          " needs one of --method=" + NamesThatTakeIns() + ", not " + name;
      return nullptr;
    }
    return method.make(options);
  }
  *error = "--method=" + name + ", must be one of";
  for (const Method& method : kMethods) {
    if (!method.IsOdometry()) *error += std::string(" ") + method.name;
  }
  return nullptr;
}

PoseSolver MakeSolver(const std::string& name,
                      const QuatroOptions& options,
                      const InsOptions& ins,
                      std::string* error) {
  PoseSolver solver = MakeLevelSolver(name, options, ins, error);
  if (!solver || ins.IsPlain()) return solver;
  return [solver, bound = options.noise_bound, ins](const PointsRef& source,
                                                    const PointsRef& target) {
    return SolveWithIns(source, target, solver, bound, ins);
  };
}

PoseSolver MakeSolver(const std::string& name,
                      const QuatroOptions& options,
                      std::string* error) {
  return MakeSolver(name, options, InsOptions(), error);
}

CloudSolver FindCloudSolver(const std::string& name) {
  for (const Method& method : kMethods) {
    if (name != method.name) continue;
    if (!method.register_matched) return method.register_clouds;
    return [matched = method.register_matched](
               const PointCloud& source,
               const PointCloud& target,
               const Rigid3&,
               const RegistrationOptions& options) {
      return matched(MatchClouds(source, target, options), options);
    };
  }
  return nullptr;
}

PairSolver FindPairSolver(const std::string& name, std::string* error) {
  for (const Method& method : kMethods) {
    if (name != method.name || method.IsOdometry()) continue;
    return [method](const PointCloud& source,
                    const PointCloud& target,
                    const MatchedClouds& matched,
                    const RegistrationOptions& options) {
      if (method.register_matched) {
        return method.register_matched(matched, options);
      }
      if (method.register_clouds) {
        return method.register_clouds(source, target, Rigid3(), options);
      }
      return RegisterBy(method.make, matched, options);
    };
  }
  // Sets *error if the name is unknown.
  MakeSolver(name, QuatroOptions(), error);
  return nullptr;
}

PairSolver FindPairSolver(const std::string& name,
                          const std::vector<OwnMethod>& own,
                          std::string* error) {
  for (const OwnMethod& method : own) {
    if (name != method.name) continue;
    for (const Method& known : kMethods) {
      if (name != known.name) continue;
      *error = "there is already a method " + name;
      return nullptr;
    }
    return [make = method.make](const PointCloud&,
                                const PointCloud&,
                                const MatchedClouds& matched,
                                const RegistrationOptions& options) {
      return RegisterBy(make, matched, options);
    };
  }
  return FindPairSolver(name, error);
}

bool NeedsIns(const std::string& name) {
  for (const Method& method : kMethods) {
    if (name == method.name) return method.ins == Ins::kNeeded;
  }
  return false;
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
