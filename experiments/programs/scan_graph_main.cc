// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gflags/gflags.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "experiments/base/outputs.h"
#include "experiments/pose_graphs/g2o.h"
#include "experiments/pose_graphs/pose_graph_problem.h"
#include "experiments/pose_graphs/scan_graph.h"
#include "experiments/programs/flag_problems.h"
#include "experiments/programs/program.h"
#include "experiments/programs/progress_line.h"
#include "features/io/cloud_io.h"

DEFINE_string(scans,
              "",
              "Clouds in the order they were taken: a.bin,b.bin,...");
DEFINE_string(odometry,
              "",
              "g2o file in space with a pose for each scan and edges between "
              "those that follow each other, which are taken as right");
DEFINE_int32(point_floats,
             0,
             "Numbers of a point of a .bin: x, y, z, the intensity, others; 0: "
             "told by the file");
DEFINE_string(preset, "kitti", "kitti, paper, reference or indoor");
DEFINE_string(loss,
              "gnc",
              "Robust loss of the loops: gnc, none, huber, cauchy or tukey");
DEFINE_double(loop_sigma_m,
              0.1,
              "Position noise of an inlier loop, per axis [m]");
DEFINE_double(loop_sigma_deg,
              0.5,
              "Rotation noise of an inlier loop, per axis [deg]");
DEFINE_double(inlier_probability,
              0.999999,
              "Share of inlier loops within the bound");
DEFINE_uint64(seed, 0, "Random seed");
DEFINE_int32(threads,
             0,
             "Threads; 0: one per core. Does not affect the result");
DEFINE_string(output, "", "g2o file for poses, odometry and all loops");

namespace {

using quatro::Fail;

constexpr char kUsage[] =
    "registers every pair of many scans and finds consistent poses.\n"
    "\n"
    "  quatro_scan_graph --scans=0.bin,1.bin,2.bin --odometry=odometry.g2o\n"
    "\n"
    "Prints a line per loop, from,to,status,weight, and a summary. Exits with\n"
    "0; 1 if there is no answer; 2 if a flag or a file is invalid.";

std::vector<std::string> SplitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

int Main(int argc, char** argv) {
  if (const auto exit_code =
          quatro::ParseFlags(kUsage, "scan_graph_main", argc, argv)) {
    return *exit_code;
  }
  std::string error;
  const std::vector<std::string> paths = SplitAtCommas(FLAGS_scans);
  if (paths.size() < 3) {
    return Fail(quatro::FlagProblem(
        "scans", FLAGS_scans, "three clouds or more: a.bin,b.bin,c.bin"));
  }
  for (const std::string& path : paths) {
    if (!path.empty()) continue;
    return Fail(quatro::FlagProblem(
        "scans", FLAGS_scans, "names of clouds; one between commas is empty"));
  }
  if (FLAGS_odometry.empty()) {
    return Fail("--odometry is empty, must name a g2o file");
  }
  auto registration = quatro::FindPreset(FLAGS_preset, &error);
  if (!registration) return Fail(error);
  registration->seed = FLAGS_seed;
  registration->num_threads = FLAGS_threads;
  if (!registration->IsValid(&error)) return Fail(error);
  quatro::PoseGraphOptions options;
  const auto loss = quatro::ParseLoopLoss(FLAGS_loss);
  if (!loss) {
    return Fail("--loss=" + FLAGS_loss +
                ", must be gnc, none, huber, cauchy or tukey");
  }
  options.loss = *loss;
  options.inlier_probability = FLAGS_inlier_probability;
  if (!(FLAGS_inlier_probability > 0.0 && FLAGS_inlier_probability < 1.0)) {
    return Fail(quatro::FlagProblem(
        "inlier_probability", FLAGS_inlier_probability, "> 0 and < 1"));
  }
  if (!(FLAGS_loop_sigma_m >= quatro::kMinSigma &&
        FLAGS_loop_sigma_m <= quatro::kMaxSigmaM)) {
    return Fail(quatro::FlagProblem(
        "loop_sigma_m", FLAGS_loop_sigma_m, "1e-6 to 1e6 [m]"));
  }
  if (!(FLAGS_loop_sigma_deg >= quatro::kMinSigma &&
        FLAGS_loop_sigma_deg <= quatro::kMaxSigmaDeg)) {
    return Fail(quatro::FlagProblem(
        "loop_sigma_deg", FLAGS_loop_sigma_deg, "1e-6 to 180 [deg]"));
  }
  std::vector<std::string> inputs = paths;
  inputs.push_back(FLAGS_odometry);
  if (!quatro::CanWriteAll({{"output", FLAGS_output}}, inputs, &error))
    return Fail(error);

  auto graph = quatro::ReadG2o(FLAGS_odometry, &error);
  if (!graph) return Fail(error);
  if (graph->dimension != 3 || graph->ids.size() != paths.size()) {
    return Fail(FLAGS_odometry + ": has " + std::to_string(graph->ids.size()) +
                (graph->dimension == 3 ? " poses" : " poses in the plane") +
                ", must have a pose in space for each of the " +
                std::to_string(paths.size()) + " clouds of --scans");
  }
  std::vector<bool> is_reached(paths.size());
  for (const quatro::PoseEdge& edge : graph->edges) {
    if (!edge.IsOdometry()) {
      return Fail(FLAGS_odometry + ": has an edge from pose " +
                  std::to_string(graph->ids[edge.from]) + " to pose " +
                  std::to_string(graph->ids[edge.to]) +
                  ", must have edges between poses that follow each other "
                  "alone; loops are found by registration");
    }
    is_reached[edge.to] = true;
  }
  for (std::size_t i = 1; i < is_reached.size(); ++i) {
    if (is_reached[i]) continue;
    return Fail(FLAGS_odometry + ": must have an edge from pose " +
                std::to_string(graph->ids[i - 1]) + " to pose " +
                std::to_string(graph->ids[i]) + " (the next one)");
  }
  const quatro::ReadCloudOptions reading = {FLAGS_point_floats};
  if (!reading.IsValid(&error)) return Fail(error);
  std::vector<quatro::PointCloud> scans;
  for (const std::string& path : paths) {
    auto scan = quatro::ReadCloud(path, reading, &error);
    if (!scan) return Fail(error);
    scans.push_back(std::move(*scan));
  }

  const auto pairs = quatro::RegisterPairs(
      scans, *registration, quatro::ProgressLine("pairs"));
  const std::size_t num_odometry = graph->edges.size();
  quatro::AddLoops(pairs,
                   quatro::DiagonalInformation(
                       FLAGS_loop_sigma_m, FLAGS_loop_sigma_deg * M_PI / 180.0),
                   &*graph);
  const auto summary = quatro::SolvePoseGraph(options, &*graph);
  std::FILE* const out = quatro::SummaryStream({FLAGS_output});
  std::size_t edge = num_odometry;
  for (const quatro::ScanPair& pair : pairs) {
    const std::string weight =
        pair.from_from_to ? std::to_string(summary.weights[edge++]) : "none";
    std::fprintf(out,
                 "%s,%s,%s,%s\n",
                 paths[pair.from].c_str(),
                 paths[pair.to].c_str(),
                 quatro::StatusName(pair.verdict.status),
                 weight.c_str());
  }
  std::fprintf(out, "%s\n", summary.report.c_str());
  if (!summary.is_usable) return quatro::kExitNotVouchedFor;
  if (!FLAGS_output.empty() &&
      !quatro::WriteOutputs({{FLAGS_output, quatro::FormatG2o(*graph)}},
                            &error)) {
    return Fail(error);
  }
  return quatro::kExitDone;
}

}  // namespace

int main(int argc, char** argv) { return quatro::RunProgram(Main, argc, argv); }
