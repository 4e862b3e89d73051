// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/benchmarks/pair_input.h"

#include <glog/logging.h>

#include <optional>
#include <string>
#include <utility>

#include "features/normals.h"
#include "features/voxel_grid.h"
#include "robust/estimators/tims.h"
#include "robust/graph/max_clique.h"

namespace quatro {

PairInput MakePairInput(PointCloud source,
                        PointCloud target,
                        const RegistrationOptions& options) {
  PairInput input;
  input.options = options;
  input.clouds[0].cloud = std::move(source);
  input.clouds[1].cloud = std::move(target);
  const int threads = options.num_threads;
  const FrontEndOptions& front_end = options.front_end;
  for (CloudInput& cloud : input.clouds) {
    std::string error;
    auto voxels =
        SampleVoxels(cloud.cloud.points, front_end.voxel_size, &error);
    CHECK(voxels) << error;
    cloud.voxels = *std::move(voxels);
    cloud.tree = std::make_unique<const KdTree>(cloud.voxels);
    cloud.neighborhoods =
        FindNeighborhoods(*cloud.tree, front_end.fpfh_radius, threads);
    cloud.normals = EstimateNormals(cloud.voxels,
                                    cloud.neighborhoods,
                                    front_end.normal_radius,
                                    Eigen::Vector3d::Zero(),
                                    threads);
    cloud.fpfh =
        ComputeFpfh(cloud.voxels, cloud.normals, cloud.neighborhoods, threads);
  }
  auto& [a, b] = input.clouds;
  input.mutual_matches = MatchMutualNearest(a.fpfh, b.fpfh, threads);

  input.matched = MatchClouds(a.cloud, b.cloud, options);
  CHECK(input.matched.error.empty()) << input.matched.error;
  input.matches = FindDistinctMatches(input.matched.matched_source,
                                      input.matched.matched_target);
  const QuatroOptions quatro = WithSharedValues(options).quatro;
  input.consistency.test = quatro.consistency_test;
  input.consistency.bound = 2.0 * quatro.noise_bound;
  input.consistency.max_tilt = quatro.max_tilt;
  input.graph = std::make_unique<const Graph>(BuildConsistencyGraph(
      input.matches.source, input.matches.target, input.consistency, threads));
  const std::vector<int> clique = FindCliqueGreedily(*input.graph);
  const std::vector<Eigen::Index> columns(clique.begin(), clique.end());
  input.clique_source = Columns(input.matches.source, columns);
  input.clique_target = Columns(input.matches.target, columns);
  const auto pairs =
      MakeTimPairs(input.clique_source.cols(), TimLayout::kRing, 0, 0);
  input.rotation = {ComputeTims(input.clique_source, pairs),
                    ComputeTims(input.clique_target, pairs),
                    quatro.tim_bound_factor * quatro.noise_bound};
  input.summary = RegisterMatched(input.matched, options);
  return input;
}

}  // namespace quatro
