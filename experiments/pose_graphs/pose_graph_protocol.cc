// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/pose_graphs/pose_graph_protocol.h"

#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace quatro {
namespace {

constexpr double kRight = 0.1;   // [m]
constexpr double kEqual = 1e-6;  // [m] and [rad]
constexpr std::array<const char*, 5> kLosses = {
    "gnc", "tukey", "cauchy", "huber", "none"};

struct Tally {
  int num_right = 0;
  int num_equal = 0;
  int num_rejected_all = 0;    // Exactly the outliers have weight 0.
  std::vector<double> errors;  // [m]
  std::vector<double> seconds;
};

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

bool AreWrongOnesZero(const GraphWorld& world,
                      const std::vector<double>& weights) {
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (world.is_wrong[i] != (weights[i] == 0.0)) return false;
  }
  return true;
}

std::string Format(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

}  // namespace

PoseDifference LargestDifference(const std::vector<Rigid3>& a,
                                 const std::vector<Rigid3>& b) {
  CHECK_EQ(a.size(), b.size());
  PoseDifference largest;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest.translation = std::max(
        largest.translation, (a[i].translation - b[i].translation).norm());
    largest.rotation =
        std::max(largest.rotation, AngleBetween(a[i].rotation, b[i].rotation));
  }
  return largest;
}

Table RunWrongLoopProtocol(int num_seeds,
                           const GraphWorldOptions& world_options,
                           const PoseGraphOptions& options,
                           const Progress& progress) {
  Table table;
  table.columns = {"world",
                   "sigma_m",
                   "sigma_deg",
                   "wrong_share",
                   "loss",
                   "runs",
                   "correct",
                   "equal",
                   "rejected",
                   "median_error_m",
                   "median_seconds"};
  int num_done = 0;
  for (const char* name : {"manhattan", "sphere"}) {
    for (int tenths = 1; tenths <= 9; ++tenths) {
      std::array<Tally, kLosses.size()> tallies;
      for (int seed = 0; seed < num_seeds; ++seed) {
        GraphWorldOptions own = world_options;
        own.world = name;
        own.wrong_share = 0.1 * tenths;
        own.seed = static_cast<std::uint64_t>(seed);
        std::string error;
        const auto world = MakeGraphWorld(own, &error);
        CHECK(world.has_value()) << error;

        PoseGraph clean = WithoutWrongLoops(*world);
        PoseGraphOptions plain = options;
        plain.loss = LoopLoss::kNone;
        CHECK(SolvePoseGraph(plain, &clean).is_usable);

        for (std::size_t k = 0; k < kLosses.size(); ++k) {
          PoseGraph graph = world->graph;
          PoseGraphOptions with_loss = options;
          with_loss.loss = *ParseLoopLoss(kLosses[k]);
          const auto summary = SolvePoseGraph(with_loss, &graph);
          const PoseDifference difference =
              LargestDifference(graph.world_from_pose, clean.world_from_pose);
          Tally& tally = tallies[k];
          tally.errors.push_back(difference.translation);
          tally.seconds.push_back(summary.seconds);
          if (!summary.is_usable) continue;
          if (difference.translation <= kRight) ++tally.num_right;
          if (difference.translation <= kEqual &&
              difference.rotation <= kEqual) {
            ++tally.num_equal;
          }
          if (AreWrongOnesZero(*world, summary.weights)) {
            ++tally.num_rejected_all;
          }
        }
        progress(++num_done, 18 * num_seeds);
      }
      for (std::size_t k = 0; k < kLosses.size(); ++k) {
        const Tally& tally = tallies[k];
        table.rows.push_back(
            {name,
             Format("%g", world_options.translation_sigma),
             Format("%g", world_options.rotation_sigma * 180.0 / M_PI),
             Format("%.1f", 0.1 * tenths),
             kLosses[k],
             std::to_string(num_seeds),
             std::to_string(tally.num_right),
             std::to_string(tally.num_equal),
             k == 0 ? std::to_string(tally.num_rejected_all) : "",
             Format("%.2e", Median(tally.errors)),
             Format("%.3f", Median(tally.seconds))});
      }
    }
  }
  return table;
}

}  // namespace quatro
