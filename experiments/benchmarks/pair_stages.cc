// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <benchmark/benchmark.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "experiments/benchmarks/limits.h"
#include "experiments/benchmarks/stages.h"
#include "features/base/simd.h"
#include "features/normals.h"
#include "features/voxel_grid.h"
#include "robust/estimators/arc_consensus.h"
#include "robust/estimators/fgr.h"
#include "robust/estimators/quatro.h"
#include "robust/estimators/ransac.h"
#include "robust/gnc/gnc.h"
#include "robust/gnc/surrogate.h"
#include "robust/graph/max_clique.h"
#include "robust/verdict/surface_observability.h"
#include "solvers/closed_form/exact_yaw.h"
#include "solvers/closed_form/translation.h"
#include "solvers/local/gicp.h"
#include "solvers/local/icp.h"
#if defined(QUATRO_WITH_OPEN3D)
#include "experiments/peers/open3d.h"
#include "experiments/peers/open3d_fpfh.h"
#include "experiments/peers/open3d_icp.h"
#endif
#if defined(QUATRO_WITH_PCL)
#include "experiments/peers/pcl_fpfh.h"
#include "experiments/peers/pcl_icp.h"
#include "experiments/peers/pcl_ransac.h"
#endif

namespace quatro {
namespace {

using Counters = benchmark::UserCounters;

// One run of a stage; may set counters.
using Stage = std::function<void(const PairInput& pair, Counters* counters)>;
enum class Needs { kClouds, kPose };

class Adder {
 public:
  explicit Adder(PairSource pair) : pair_(std::move(pair)) {}

  void operator()(const std::string& name,
                  Needs needs,
                  const Stage& stage) const {
    const auto run = [pair = pair_, needs, stage](benchmark::State& state) {
      const PairInput& input = pair();
      if (needs == Needs::kPose && !input.IsSolved()) {
        state.SkipWithError("the pair has no pose");
        return;
      }
      for (auto _ : state) stage(input, &state.counters);
    };
    benchmark::RegisterBenchmark(name.c_str(), run)
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
  }

 private:
  PairSource pair_;
};

double AsCount(Eigen::Index n) { return static_cast<double>(n); }

// Computes `body` for both clouds.
template <typename Body>
void ForBoth(const PairInput& pair, const Body& body) {
  for (const CloudInput& cloud : pair.clouds) {
    benchmark::DoNotOptimize(body(cloud));
  }
}

void AddVoxelsAndNeighbors(const Adder& add) {
  add("voxels/quatro", Needs::kClouds, [](const PairInput& pair, Counters* c) {
    std::string error;
    const double size = pair.options.front_end.voxel_size;
    ForBoth(pair, [&](const CloudInput& cloud) {
      return SampleVoxels(cloud.cloud.points, size, &error);
    });
    (*c)["points"] = AsCount(pair.clouds[0].cloud.points.cols() +
                             pair.clouds[1].cloud.points.cols());
    (*c)["voxels"] =
        AsCount(pair.clouds[0].voxels.cols() + pair.clouds[1].voxels.cols());
  });
  // Reading every point is the lower limit for any sampling.
  add("voxels/limit", Needs::kClouds, [](const PairInput& pair, Counters*) {
    ForBoth(pair, [](const CloudInput& cloud) -> Points {
      return cloud.cloud.points;
    });
  });
  add("kd_tree/quatro", Needs::kClouds, [](const PairInput& pair, Counters*) {
    // The first query builds the tree.
    ForBoth(pair, [](const CloudInput& cloud) {
      return KdTree(cloud.voxels).Nearest(cloud.voxels.col(0), 1);
    });
  });
  add("neighborhoods/quatro",
      Needs::kClouds,
      [](const PairInput& pair, Counters* c) {
        ForBoth(pair, [&](const CloudInput& cloud) {
          return FindNeighborhoods(*cloud.tree,
                                   pair.options.front_end.fpfh_radius,
                                   pair.options.num_threads);
        });
        (*c)["neighbors"] =
            static_cast<double>(pair.clouds[0].neighborhoods.num_neighbors() +
                                pair.clouds[1].neighborhoods.num_neighbors());
      });
  add("neighborhoods/nanoflann",
      Needs::kClouds,
      [](const PairInput& pair, Counters*) {
        ForBoth(pair, [&](const CloudInput& cloud) {
          return FindNeighborhoodsByTree(*cloud.tree,
                                         pair.options.front_end.fpfh_radius,
                                         /*num_threads=*/1);
        });
      });
}

void AddFrontEnd(const Adder& add) {
  add("normals/quatro", Needs::kClouds, [](const PairInput& pair, Counters*) {
    ForBoth(pair, [&](const CloudInput& cloud) {
      return EstimateNormals(cloud.voxels,
                             cloud.neighborhoods,
                             pair.options.front_end.normal_radius,
                             Eigen::Vector3d::Zero(),
                             pair.options.num_threads);
    });
  });
  add("fpfh/quatro", Needs::kClouds, [](const PairInput& pair, Counters*) {
    ForBoth(pair, [&](const CloudInput& cloud) {
      return ComputeFpfh(cloud.voxels,
                         cloud.normals,
                         cloud.neighborhoods,
                         pair.options.num_threads);
    });
  });
  add("matching/quatro",
      Needs::kClouds,
      [](const PairInput& pair, Counters* c) {
        benchmark::DoNotOptimize(MatchMutualNearest(pair.clouds[0].fpfh,
                                                    pair.clouds[1].fpfh,
                                                    pair.options.num_threads));
        (*c)["matches"] = static_cast<double>(pair.mutual_matches.size());
      });
  add("tuple_test/quatro",
      Needs::kClouds,
      [](const PairInput& pair, Counters* c) {
        benchmark::DoNotOptimize(
            FilterByTupleTest(pair.mutual_matches,
                              pair.clouds[0].voxels,
                              pair.clouds[1].voxels,
                              pair.options.front_end.tuple));
        (*c)["matches"] = AsCount(pair.matched.matched_source.cols());
      });
}

// The descriptors from voxels and normals, including the search of neighbors.
void AddDescriptors(const Adder& add) {
  const auto add_one =
      [&](const std::string& who,
          const std::function<Fpfh(const CloudInput& cloud,
                                   const PairInput& pair)>& describe) {
        add("search_and_fpfh/" + who,
            Needs::kClouds,
            [describe](const PairInput& pair, Counters*) {
              ForBoth(pair, [&](const CloudInput& cloud) {
                return describe(cloud, pair);
              });
            });
      };
  add_one("quatro", [](const CloudInput& cloud, const PairInput& pair) {
    const KdTree tree(cloud.voxels);
    const int threads = pair.options.num_threads;
    return ComputeFpfh(
        cloud.voxels,
        cloud.normals,
        FindNeighborhoods(tree, pair.options.front_end.fpfh_radius, threads),
        threads);
  });
#if defined(QUATRO_WITH_PCL)
  add_one("pcl", [](const CloudInput& cloud, const PairInput& pair) {
    return ComputeFpfhByPcl(
        cloud.voxels, cloud.normals, pair.options.front_end.fpfh_radius);
  });
#endif
#if defined(QUATRO_WITH_OPEN3D)
  add_one("open3d", [](const CloudInput& cloud, const PairInput& pair) {
    return ComputeFpfhByOpen3d(
        cloud.voxels, cloud.normals, pair.options.front_end.fpfh_radius);
  });
#endif
}

void AddEstimation(const Adder& add) {
  add("pair_graph/quatro",
      Needs::kClouds,
      [](const PairInput& pair, Counters* c) {
        benchmark::DoNotOptimize(
            BuildConsistencyGraph(pair.matches.source,
                                  pair.matches.target,
                                  pair.consistency,
                                  pair.options.num_threads));
        (*c)["matches"] = AsCount(pair.matches.source.cols());
      });
  add("pair_graph/limit", Needs::kClouds, [](const PairInput& pair, Counters*) {
    // Created in the first run, so that its memory is not measured.
    static const PairInput* made_for = nullptr;
    static std::unique_ptr<PairTestLimit> limit;
    if (made_for != &pair) {
      limit = std::make_unique<PairTestLimit>(
          pair.matches.source, pair.matches.target, pair.consistency.bound);
      made_for = &pair;
    }
    limit->Run(BestSimdLevel());
    benchmark::ClobberMemory();
  });
  add("pair_clique/quatro",
      Needs::kClouds,
      [](const PairInput& pair, Counters* c) {
        benchmark::DoNotOptimize(FindCliqueGreedily(*pair.graph));
        (*c)["clique"] = AsCount(pair.clique_source.cols());
      });
  add("yaw_gnc/quatro", Needs::kPose, [](const PairInput& pair, Counters*) {
    benchmark::DoNotOptimize(SolveGnc<TruncatedLeastSquares>(
        pair.rotation, pair.options.quatro.gnc));
  });
  add("yaw_exact/quatro", Needs::kPose, [](const PairInput& pair, Counters*) {
    const Weights weights = Weights::Ones(pair.rotation.NumMeasurements());
    const Weights bounds =
        Weights::Constant(weights.size(), pair.rotation.noise_bound);
    benchmark::DoNotOptimize(EstimateExactYaw(
        pair.rotation.source, pair.rotation.target, weights, bounds));
  });
  add("translation/quatro", Needs::kPose, [](const PairInput& pair, Counters*) {
    const Rigid3& pose = *pair.summary.target_from_source();
    benchmark::DoNotOptimize(
        EstimateTranslation(pose.rotation * pair.clique_source,
                            pair.clique_target,
                            pair.options.noise_bound));
  });
  add("solve/quatro", Needs::kClouds, [](const PairInput& pair, Counters*) {
    const QuatroOptions options = WithSharedValues(pair.options).quatro;
    benchmark::DoNotOptimize(SolveQuatro(
        pair.matched.matched_source, pair.matched.matched_target, options));
  });
  add("arc_consensus/quatro",
      Needs::kClouds,
      [](const PairInput& pair, Counters*) {
        ArcConsensusOptions options;
        options.noise_bound = pair.options.noise_bound;
        options.num_threads = pair.options.num_threads;
        benchmark::DoNotOptimize(SolveArcConsensus(
            pair.matched.matched_source, pair.matched.matched_target, options));
      });
}

// Estimators that other libraries have too, on the same matches.
void AddOtherEstimators(const Adder& add) {
  using Solve = std::function<PoseSummary(
      const Points& source, const Points& target, double noise_bound)>;
  const auto add_one = [&](const std::string& name, const Solve& solve) {
    add(name, Needs::kClouds, [solve](const PairInput& pair, Counters* c) {
      const PoseSummary summary = solve(pair.matched.matched_source,
                                        pair.matched.matched_target,
                                        pair.options.noise_bound);
      (*c)["inliers"] = AsCount(summary.num_translation_inliers);
    });
  };
  add_one("ransac/quatro", [](const Points& p, const Points& q, double bound) {
    RansacOptions options;
    options.minimal.noise_bound = bound;
    return SolveRansac(p, q, options);
  });
  add_one("fgr/quatro", [](const Points& p, const Points& q, double bound) {
    FgrOptions options;
    options.noise_bound = bound;
    return SolveFgr(p, q, options);
  });
#if defined(QUATRO_WITH_PCL)
  add_one("ransac/pcl", [](const Points& p, const Points& q, double bound) {
    return SolveByPclRansac(p, q, bound, {});
  });
#endif
#if defined(QUATRO_WITH_OPEN3D)
  add_one("ransac/open3d", [](const Points& p, const Points& q, double bound) {
    return SolveByOpen3dRansac(p, q, bound, {});
  });
  add_one("fgr/open3d", [](const Points& p, const Points& q, double bound) {
    return SolveByOpen3dFgr(p, q, bound, {});
  });
#endif
}

RefinementOptions RefinementOf(const PairInput& pair, RefinementMethod method) {
  RefinementOptions options = pair.options.refinement;
  options.method = method;
  options.alignment.num_threads = pair.options.num_threads;
  return options;
}

AlignmentSummary AlignFromPoints(const Points& source,
                                 const Points& target,
                                 const Rigid3& initial_target_from_source,
                                 const RefinementOptions& options) {
  if (options.method == RefinementMethod::kIcp) {
    return SolveIcp(
        source, target, initial_target_from_source, options.alignment);
  }
  GicpOptions gicp;
  gicp.alignment = options.alignment;
  gicp.epsilon = options.epsilon;
  return SolveGicp(source, target, initial_target_from_source, gicp);
}

// Refinement from the estimated pose: with trees and normals available, as in
// Register(), and from bare points, which is all that other libraries take.
void AddRefinement(const Adder& add) {
  using Method = RefinementMethod;
  for (const Method method : {Method::kIcp, Method::kGicp, Method::kVgicp}) {
    const std::string name = RefinementName(method);
    add(name + "/quatro",
        Needs::kPose,
        [method](const PairInput& pair, Counters* c) {
          const AlignmentSummary summary =
              Align(pair.matched.source,
                    pair.matched.target,
                    *pair.summary.target_from_source(),
                    RefinementOf(pair, method));
          (*c)["inliers"] = AsCount(summary.num_inliers);
        });
    if (method == Method::kVgicp) continue;
    const std::string name_from_points = name + "_from_points/";
    const auto add_one = [&](const std::string& who,
                             decltype(&AlignFromPoints) align) {
      add(name_from_points + who,
          Needs::kPose,
          [method, align](const PairInput& pair, Counters* c) {
            const AlignmentSummary summary =
                align(pair.clouds[0].voxels,
                      pair.clouds[1].voxels,
                      *pair.summary.target_from_source(),
                      RefinementOf(pair, method));
            (*c)["inliers"] = AsCount(summary.num_inliers);
          });
    };
    add_one("quatro", AlignFromPoints);
#if defined(QUATRO_WITH_PCL)
    add_one("pcl", AlignByPcl);
#endif
#if defined(QUATRO_WITH_OPEN3D)
    add_one("open3d", AlignByOpen3d);
#endif
  }
}

void AddVerdict(const Adder& add) {
  add("evidence/quatro", Needs::kPose, [](const PairInput& pair, Counters*) {
    const EvidenceOptions& evidence = pair.options.evidence;
    const double voxel_size = pair.options.front_end.voxel_size;
    const DescribedCloud& source = pair.matched.source;
    const DescribedCloud& target = pair.matched.target;
    const Rigid3& pose = *pair.summary.target_from_source();
    const int threads = pair.options.num_threads;
    const MutualContacts contacts = FindMutualContacts(
        source, target, pose, evidence.MaxDistance(voxel_size), threads);
    benchmark::DoNotOptimize(
        MeasureSurfaceObservability(source,
                                    target,
                                    pose,
                                    contacts,
                                    pair.options.surface_observability,
                                    threads));
    benchmark::DoNotOptimize(MeasureGeometricEvidence(
        source, target, pose, contacts, voxel_size, evidence, threads));
  });
  add("verdict/quatro", Needs::kPose, [](const PairInput& pair, Counters* c) {
    VerdictOptions options = pair.options.verdict;
    options.rival.num_threads = pair.options.num_threads;
    const Verdict verdict = Judge(pair.matched.matched_source,
                                  pair.matched.matched_target,
                                  pair.summary.solution,
                                  pair.options.noise_bound,
                                  pair.summary.verdict.geometry,
                                  options);
    (*c)["registered"] = verdict.IsRegistered();
  });
}

void AddRegister(const Adder& add) {
  for (const int threads : {1, 2}) {
    add("register/quatro/threads:" + std::to_string(threads),
        Needs::kClouds,
        [threads](const PairInput& pair, Counters* c) {
          RegistrationOptions options = pair.options;
          options.num_threads = threads;
          const RegistrationSummary summary =
              Register(pair.clouds[0].cloud, pair.clouds[1].cloud, options);
          (*c)["registered"] = summary.verdict.IsRegistered();
        });
  }
}

}  // namespace

void AddPairStages(const PairSource& pair) {
  const Adder add(pair);
  AddVoxelsAndNeighbors(add);
  AddFrontEnd(add);
  AddDescriptors(add);
  AddEstimation(add);
  AddOtherEstimators(add);
  AddRefinement(add);
  AddVerdict(add);
  AddRegister(add);
}

}  // namespace quatro
