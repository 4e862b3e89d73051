// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/peers/peer_methods.h"

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
#include "robust/registration/local_registration.h"
#include "robust/registration/registration.h"

namespace quatro {
namespace {

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

#if defined(QUATRO_WITH_OPEN3D) || defined(QUATRO_WITH_PCL)
using Aligner = AlignmentSummary (*)(const Points& source,
                                     const Points& target,
                                     const Rigid3& initial_target_from_source,
                                     const RefinementOptions& options);

template <Aligner align, RefinementMethod method>
RegistrationSummary RegisterByPeer(const PointCloud& source,
                                   const PointCloud& target,
                                   const RegistrationOptions& options) {
  RegistrationOptions local = options;
  local.refinement.method = method;
  return RegisterLocally(source, target, options.bounds.guess, local, align);
}

using Describer = Fpfh (*)(const Points& points,
                           const Points& normals,
                           double radius);

template <Describer describe>
RegistrationSummary RegisterByPeerFpfh(const PointCloud& source,
                                       const PointCloud& target,
                                       const RegistrationOptions& options) {
  RegistrationOptions described = options;
  described.solver = nullptr;
  described.method = "quatro";
  described.front_end.describe = describe;
  return Register(source, target, described);
}
#endif

std::vector<PeerMethod> MakePeerMethods() {
  std::vector<PeerMethod> methods;
#ifdef QUATRO_WITH_OPEN3D
  methods.push_back(
      {"open3d_fgr", "FGR of Open3D, the same matches", MakeOpen3dFgr});
  methods.push_back({"open3d_ransac",
                     "RANSAC of Open3D, 10,000 samples at most",
                     MakeOpen3dRansac});
  methods.push_back({"open3d_icp",
                     "clouds: ICP of Open3D, the same voxels",
                     nullptr,
                     RegisterByPeer<AlignByOpen3d, RefinementMethod::kIcp>});
  methods.push_back({"open3d_gicp",
                     "clouds: G-ICP of Open3D, the same voxels",
                     nullptr,
                     RegisterByPeer<AlignByOpen3d, RefinementMethod::kGicp>});
  methods.push_back(
      {"open3d_fpfh",
       "clouds: quatro on matches of Open3D's FPFH, the same normals",
       nullptr,
       RegisterByPeerFpfh<ComputeFpfhByOpen3d>});
#endif
#ifdef QUATRO_WITH_PCL
  methods.push_back(
      {"pcl_ransac", "RANSAC of PCL, 10,000 samples at most", MakePclRansac});
  methods.push_back({"pcl_icp",
                     "clouds: ICP of PCL, the same voxels",
                     nullptr,
                     RegisterByPeer<AlignByPcl, RefinementMethod::kIcp>});
  methods.push_back({"pcl_gicp",
                     "clouds: G-ICP of PCL, the same voxels",
                     nullptr,
                     RegisterByPeer<AlignByPcl, RefinementMethod::kGicp>});
  methods.push_back(
      {"pcl_fpfh",
       "clouds: quatro on matches of PCL's FPFH, the same normals",
       nullptr,
       RegisterByPeerFpfh<ComputeFpfhByPcl>});
#endif
  return methods;
}

}  // namespace

const std::vector<PeerMethod>& PeerMethods() {
  static const auto* const methods =
      new std::vector<PeerMethod>(MakePeerMethods());
  return *methods;
}

}  // namespace quatro
