// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "experiments/base/outputs.h"
#include "experiments/base/progress_line.h"
#include "experiments/pose_graphs/g2o.h"
#include "experiments/pose_graphs/pose_graph_problem.h"
#include "experiments/pose_graphs/pose_graph_protocol.h"
#include "experiments/pose_graphs/pose_graph_worlds.h"
#include "experiments/programs/flag_problems.h"
#include "experiments/programs/program.h"
#include "experiments/protocols/synthetic_protocols.h"

DEFINE_string(input, "", "g2o file; empty: a generated world");
DEFINE_string(output,
              "",
              "g2o file for the solution; with --protocol, a CSV file");
DEFINE_string(loss,
              "gnc",
              "Robust loss of the loops: gnc, none, huber, cauchy, tukey");
DEFINE_double(inlier_probability,
              0.99,
              "Share of inlier loops within the bound");
DEFINE_string(gnc_start,
              "plain_fit",
              "Residuals that determine the first mu: plain_fit, or identity "
              "for those of the given poses");
DEFINE_double(mu_step, 1.4, "Factor of mu per iteration");
DEFINE_bool(chain_odometry,
            false,
            "Start from the odometry instead of the poses of --input; a "
            "generated world always does");
DEFINE_string(world, "manhattan", "manhattan (in the plane) or sphere");
DEFINE_int32(poses, 400, "Poses of the generated world");
DEFINE_int32(loops, 200, "Loops of the generated world, inliers and outliers");
DEFINE_double(wrong_share, 0.5, "Share of outliers among the loops");
DEFINE_double(sigma_m,
              0.02,
              "Position noise of the generated world, per axis [m]");
DEFINE_double(sigma_deg,
              0.3,
              "Rotation noise of the generated world, per axis [deg]");
DEFINE_int32(max_wrong_steps,
             0,
             "Outlier loops join poses at most this many steps apart; 0: any");
DEFINE_uint64(seed, 0, "Random seed of the generated world");
DEFINE_string(world_output,
              "",
              "g2o file for the generated world before solving");
DEFINE_string(protocol,
              "",
              "wrong_loops: success over the share of outlier loops, for "
              "every loss; numbers for draw_wrong_loops.py");
DEFINE_int32(seeds, 10, "Worlds per kind, for --protocol");
DEFINE_bool(full_report, false, "Also print mu and cost of each iteration");

namespace {

using quatro::Fail;

constexpr char kUsage[] =
    "finds the poses of a graph whose loops may be outliers.\n"
    "\n"
    "  quatro_pose_graph --input=graph.g2o --output=answer.g2o\n"
    "  quatro_pose_graph --world=sphere --wrong_share=0.5\n"
    "  quatro_pose_graph --protocol=wrong_loops --output=wrong_loops.csv\n"
    "\n"
    "Edges between poses whose ids follow each other are odometry and assumed\n"
    "to be inliers; all others are loops. Without poses in the file, they are\n"
    "chained from the odometry. Prints a summary. Exits with 0; 1 if there is "
    "no\n"
    "answer, or if odometry and accepted loops leave the graph disconnected\n"
    "(nothing is written then); 2 if a flag or a file is invalid.";

std::optional<quatro::PoseGraphOptions> OptionsFromFlags(std::string* error) {
  quatro::PoseGraphOptions options;
  const auto loss = quatro::ParseLoopLoss(FLAGS_loss);
  if (!loss) {
    *error =
        "--loss=" + FLAGS_loss + ", must be gnc, none, huber, cauchy or tukey";
    return std::nullopt;
  }
  options.loss = *loss;
  options.inlier_probability = FLAGS_inlier_probability;
  if (!(FLAGS_inlier_probability > 0.0 && FLAGS_inlier_probability < 1.0)) {
    *error = quatro::FlagProblem(
        "inlier_probability", FLAGS_inlier_probability, "> 0 and < 1");
    return std::nullopt;
  }
  if (FLAGS_gnc_start != "plain_fit" && FLAGS_gnc_start != "identity") {
    *error =
        "--gnc_start=" + FLAGS_gnc_start + ", must be plain_fit or identity";
    return std::nullopt;
  }
  options.gnc.start = FLAGS_gnc_start == "identity"
                          ? quatro::GncStart::kIdentity
                          : quatro::GncStart::kPlainFit;
  options.gnc.mu_step = FLAGS_mu_step;
  if (!options.gnc.IsValid(error)) return std::nullopt;
  return options;
}

quatro::GraphWorldOptions WorldFromFlags() {
  quatro::GraphWorldOptions world;
  world.world = FLAGS_world;
  world.num_poses = FLAGS_poses;
  world.num_loops = FLAGS_loops;
  world.wrong_share = FLAGS_wrong_share;
  world.max_wrong_steps = FLAGS_max_wrong_steps;
  world.translation_sigma = FLAGS_sigma_m;
  world.rotation_sigma = FLAGS_sigma_deg * M_PI / 180.0;
  world.seed = FLAGS_seed;
  return world;
}

int RunProtocol(const quatro::PoseGraphOptions& options) {
  std::string error;
  if (FLAGS_protocol != "wrong_loops") {
    return Fail("--protocol=" + FLAGS_protocol + ", must be wrong_loops");
  }
  if (!FLAGS_input.empty() || !FLAGS_world_output.empty()) {
    return Fail(
        "--protocol generates its own worlds, must not be combined with "
        "--input or --world_output");
  }
  if (FLAGS_seeds < 1 || FLAGS_seeds > quatro::kMaxSeeds) {
    return Fail(quatro::FlagProblem(
        "seeds", FLAGS_seeds, "1 to " + std::to_string(quatro::kMaxSeeds)));
  }
  // The smallest outlier share needs the most inlier loops.
  for (const char* name : {"manhattan", "sphere"}) {
    for (int seed = 0; seed < FLAGS_seeds; ++seed) {
      quatro::GraphWorldOptions hardest = WorldFromFlags();
      hardest.world = name;
      hardest.wrong_share = 0.1;
      hardest.seed = static_cast<std::uint64_t>(seed);
      if (!quatro::MakeGraphWorld(hardest, &error)) return Fail(error);
    }
  }
  const quatro::Table table = quatro::RunWrongLoopProtocol(
      FLAGS_seeds, WorldFromFlags(), options, quatro::ProgressLine("worlds"));
  std::fputs(quatro::FormatTable(table).c_str(),
             quatro::SummaryStream({FLAGS_output}));
  if (!FLAGS_output.empty() &&
      !quatro::WriteOutputs({{FLAGS_output, quatro::FormatCsv(table)}},
                            &error)) {
    return Fail(error);
  }
  return quatro::kExitDone;
}

// Prints how many outliers kept some weight and how many inliers lost theirs.
void PrintTruth(std::FILE* out,
                const quatro::GraphWorld& world,
                const quatro::PoseGraphOptions& options,
                const quatro::PoseGraph& answer,
                const std::vector<double>& weights) {
  int num_wrong = 0, num_wrong_kept = 0, num_right_lost = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (world.is_wrong[i]) {
      ++num_wrong;
      if (weights[i] > 0.0) ++num_wrong_kept;
    } else if (weights[i] == 0.0) {
      ++num_right_lost;
    }
  }
  quatro::PoseGraph clean = quatro::WithoutWrongLoops(world);
  quatro::PoseGraphOptions plain = options;
  plain.loss = quatro::LoopLoss::kNone;
  quatro::SolvePoseGraph(plain, &clean);
  const auto difference =
      quatro::LargestDifference(answer.world_from_pose, clean.world_from_pose);
  std::fprintf(
      out,
      "%d outlier loops, %d of them accepted; %d inlier loops rejected; poses "
      "differ from those without outliers by at most %.3g m and %.3g rad\n",
      num_wrong,
      num_wrong_kept,
      num_right_lost,
      difference.translation,
      difference.rotation);
}

int Main(int argc, char** argv) {
  if (const auto exit_code = quatro::ParseFlags(kUsage, argc, argv)) {
    return *exit_code;
  }
  std::string error;
  const auto options = OptionsFromFlags(&error);
  if (!options) return Fail(error);
  if (!quatro::CanWriteAll(
          {{"output", FLAGS_output}, {"world_output", FLAGS_world_output}},
          {FLAGS_input},
          &error)) {
    return Fail(error);
  }
  if (!FLAGS_protocol.empty()) return RunProtocol(*options);

  std::optional<quatro::GraphWorld> world;
  quatro::PoseGraph graph;
  if (FLAGS_input.empty()) {
    world = quatro::MakeGraphWorld(WorldFromFlags(), &error);
    if (!world) return Fail(error);
    graph = world->graph;
  } else {
    if (!FLAGS_world_output.empty()) {
      return Fail("--world_output requires a generated world, not --input");
    }
    auto read = quatro::ReadG2o(FLAGS_input, &error);
    if (!read) return Fail(error);
    graph = std::move(*read);
    if (FLAGS_chain_odometry) quatro::ChainOdometry(&graph);
  }
  std::FILE* const out =
      quatro::SummaryStream({FLAGS_output, FLAGS_world_output});
  const auto summary = quatro::SolvePoseGraph(*options, &graph);
  std::fprintf(out,
               "%zu poses, %zu edges, of them %td odometry, %.3f s\n%s\n",
               graph.ids.size(),
               graph.edges.size(),
               std::count_if(graph.edges.begin(),
                             graph.edges.end(),
                             [](const quatro::PoseEdge& edge) {
                               return edge.IsOdometry();
                             }),
               summary.seconds,
               summary.report.c_str());
  if (FLAGS_full_report) {
    std::fputs(summary.gnc.FullReport().c_str(), out);
  }
  if (!summary.is_usable) return quatro::kExitNotVouchedFor;
  const auto parts = quatro::FirstOfParts(graph, summary.weights);
  if (parts.size() > 1) {
    std::fprintf(
        out,
        "the graph has %zu components: neither odometry nor an accepted loop "
        "joins pose %lld to pose %lld; add edges between them\n",
        parts.size(),
        static_cast<long long>(graph.ids[parts[1]]),
        static_cast<long long>(graph.ids[parts[0]]));
    return quatro::kExitNotVouchedFor;
  }
  if (world) PrintTruth(out, *world, *options, graph, summary.weights);

  std::vector<quatro::OutputFile> files;
  if (!FLAGS_output.empty()) {
    files.push_back({FLAGS_output, quatro::FormatG2o(graph)});
  }
  if (world && !FLAGS_world_output.empty()) {
    files.push_back({FLAGS_world_output, quatro::FormatG2o(world->graph)});
  }
  if (!quatro::WriteOutputs(files, &error)) return Fail(error);
  return quatro::kExitDone;
}

}  // namespace

int main(int argc, char** argv) { return quatro::RunProgram(Main, argc, argv); }
