// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The input of each stage between two clouds and a pose, computed once.

#ifndef QUATRO_EXPERIMENTS_BENCHMARKS_PAIR_INPUT_H_
#define QUATRO_EXPERIMENTS_BENCHMARKS_PAIR_INPUT_H_

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "features/base/types.h"
#include "features/fpfh.h"
#include "features/io/point_cloud.h"
#include "features/kd_tree.h"
#include "features/matching.h"
#include "robust/estimators/distinct_matches.h"
#include "robust/gnc/quasi_so3.h"
#include "robust/graph/consistency_graph.h"
#include "robust/registration/registration.h"
#include "robust/verdict/evidence.h"

namespace quatro {

struct CloudInput {
  PointCloud cloud;
  Points voxels;  // [m]
  std::unique_ptr<const KdTree> tree;
  Neighborhoods neighborhoods;
  Points normals;
  Fpfh fpfh;
};

struct PairInput {
  RegistrationOptions options;
  std::array<CloudInput, 2> clouds;  // Source, target.
  std::vector<Match> mutual_matches;
  MatchedClouds matched;
  DistinctMatches matches;  // Matches that pass the tuple test.
  ConsistencyOptions consistency;
  std::unique_ptr<const Graph> graph;
  Points clique_source, clique_target;  // [m]
  QuasiSo3 rotation;                    // On the ring of TIMs.
  RegistrationSummary summary;

  // Returns whether there is a pose, which the later stages need.
  bool IsSolved() const { return summary.target_from_source().has_value(); }
};

// Options and clouds must be valid for Register().
PairInput MakePairInput(PointCloud source,
                        PointCloud target,
                        const RegistrationOptions& options);

// Called when a stage first runs; never called if no stage runs.
using PairSource = std::function<const PairInput&()>;

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BENCHMARKS_PAIR_INPUT_H_
