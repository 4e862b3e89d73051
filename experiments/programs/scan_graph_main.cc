// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/base/outputs.h"
#include "experiments/base/progress_line.h"
#include "experiments/pose_graphs/g2o.h"
#include "experiments/pose_graphs/pose_graph_problem.h"
#include "experiments/pose_graphs/scan_graph.h"
#include "experiments/programs/flag_problems.h"
#include "experiments/programs/program.h"
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

// The clouds that --scans names. Returns nullopt and sets *error if a name is
// missing.
std::optional<std::vector<std::string>> PathsFromFlag(std::string* error) {
  const std::vector<std::string> paths = SplitAtCommas(FLAGS_scans);
  if (paths.size() < 3) {
    *error = quatro::FlagProblem(
        "scans", FLAGS_scans, "three clouds or more: a.bin,b.bin,c.bin");
    return std::nullopt;
  }
  if (std::find(paths.begin(), paths.end(), "") != paths.end()) {
    *error = quatro::FlagProblem(
        "scans", FLAGS_scans, "names of clouds; one between commas is empty");
    return std::nullopt;
  }
  return paths;
}

std::optional<quatro::RegistrationOptions> RegistrationFromFlags(
    std::string* error) {
  auto registration = quatro::FindPreset(FLAGS_preset, error);
  if (!registration) return std::nullopt;
  registration->seed = FLAGS_seed;
  registration->num_threads = FLAGS_threads;
  if (!registration->IsValid(error)) return std::nullopt;
  return registration;
}

std::optional<quatro::PoseGraphOptions> GraphOptionsFromFlags(
    std::string* error) {
  const auto loss = quatro::ParseLoopLoss(FLAGS_loss);
  if (!loss) {
    *error =
        "--loss=" + FLAGS_loss + ", must be gnc, none, huber, cauchy or tukey";
    return std::nullopt;
  }
  quatro::PoseGraphOptions options;
  options.loss = *loss;
  options.inlier_probability = FLAGS_inlier_probability;
  if (!(FLAGS_inlier_probability > 0.0 && FLAGS_inlier_probability < 1.0)) {
    *error = quatro::FlagProblem(
        "inlier_probability", FLAGS_inlier_probability, "> 0 and < 1");
  } else if (!(FLAGS_loop_sigma_m >= quatro::kMinSigma &&
               FLAGS_loop_sigma_m <= quatro::kMaxSigmaM)) {
    *error = quatro::FlagProblem(
        "loop_sigma_m", FLAGS_loop_sigma_m, "1e-6 to 1e6 [m]");
  } else if (!(FLAGS_loop_sigma_deg >= quatro::kMinSigma &&
               FLAGS_loop_sigma_deg <= quatro::kMaxSigmaDeg)) {
    *error = quatro::FlagProblem(
        "loop_sigma_deg", FLAGS_loop_sigma_deg, "1e-6 to 180 [deg]");
  } else {
    return options;
  }
  return std::nullopt;
}

// Whether the graph has a pose for each scan, and as edges only the odometry
// from each scan to the next.
bool IsOdometryOf(const quatro::PoseGraph& graph,
                  std::size_t num_scans,
                  std::string* error) {
  *error = FLAGS_odometry + ": ";
  if (graph.dimension != 3 || graph.ids.size() != num_scans) {
    *error += "has " + std::to_string(graph.ids.size()) +
              (graph.dimension == 3 ? " poses" : " poses in the plane") +
              ", must have a pose in space for each of the " +
              std::to_string(num_scans) + " clouds of --scans";
    return false;
  }
  std::vector<bool> is_reached(num_scans);
  for (const quatro::PoseEdge& edge : graph.edges) {
    if (!edge.IsOdometry()) {
      *error += "has an edge from pose " +
                std::to_string(graph.ids[edge.from]) + " to pose " +
                std::to_string(graph.ids[edge.to]) +
                ", must have edges between poses that follow each other "
                "alone; loops are found by registration";
      return false;
    }
    is_reached[std::max(edge.from, edge.to)] = true;
  }
  for (std::size_t i = 1; i < is_reached.size(); ++i) {
    if (is_reached[i]) continue;
    *error += "must have an edge from pose " +
              std::to_string(graph.ids[i - 1]) + " to pose " +
              std::to_string(graph.ids[i]) + " (the next one)";
    return false;
  }
  return true;
}

std::optional<std::vector<quatro::PointCloud>> ReadScans(
    const std::vector<std::string>& paths, std::string* error) {
  const quatro::ReadCloudOptions reading = {FLAGS_point_floats};
  if (!reading.IsValid(error)) return std::nullopt;
  std::vector<quatro::PointCloud> scans;
  for (const std::string& path : paths) {
    auto scan = quatro::ReadCloud(path, reading, error);
    if (!scan) return std::nullopt;
    scans.push_back(std::move(*scan));
  }
  return scans;
}

// Prints a line per pair. `weights` has one weight for each edge of the graph;
// `first_loop` is the index of the first loop.
void PrintPairs(std::FILE* out,
                const std::vector<std::string>& paths,
                const std::vector<quatro::ScanPair>& pairs,
                const std::vector<double>& weights,
                std::size_t first_loop) {
  std::size_t edge = first_loop;
  for (const quatro::ScanPair& pair : pairs) {
    const std::string weight =
        pair.from_from_to ? std::to_string(weights[edge++]) : "none";
    std::fprintf(out,
                 "%s,%s,%s,%s\n",
                 paths[pair.from].c_str(),
                 paths[pair.to].c_str(),
                 quatro::StatusName(pair.verdict.status),
                 weight.c_str());
  }
}

int Main(int argc, char** argv) {
  if (const auto exit_code = quatro::ParseFlags(kUsage, argc, argv)) {
    return *exit_code;
  }
  std::string error;
  const auto paths = PathsFromFlag(&error);
  if (!paths) return Fail(error);
  if (FLAGS_odometry.empty()) {
    return Fail("--odometry is empty, must name a g2o file");
  }
  const auto registration = RegistrationFromFlags(&error);
  if (!registration) return Fail(error);
  const auto options = GraphOptionsFromFlags(&error);
  if (!options) return Fail(error);
  std::vector<std::string> inputs = *paths;
  inputs.push_back(FLAGS_odometry);
  if (!quatro::CanWriteAll({{"output", FLAGS_output}}, inputs, &error))
    return Fail(error);
  auto graph = quatro::ReadG2o(FLAGS_odometry, &error);
  if (!graph || !IsOdometryOf(*graph, paths->size(), &error)) {
    return Fail(error);
  }
  const auto scans = ReadScans(*paths, &error);
  if (!scans) return Fail(error);

  const auto pairs = quatro::RegisterPairs(
      *scans, *registration, quatro::ProgressLine("pairs"));
  const std::size_t num_odometry = graph->edges.size();
  quatro::AddLoops(pairs,
                   quatro::DiagonalInformation(
                       FLAGS_loop_sigma_m, FLAGS_loop_sigma_deg * M_PI / 180.0),
                   &*graph);
  const auto summary = quatro::SolvePoseGraph(*options, &*graph);
  std::FILE* const out = quatro::SummaryStream({FLAGS_output});
  PrintPairs(out, *paths, pairs, summary.weights, num_odometry);
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
