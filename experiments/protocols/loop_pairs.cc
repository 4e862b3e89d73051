// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/protocols/loop_pairs.h"

#include <bit>
#include <sstream>

#include "experiments/protocols/draw_evenly.h"
#include "features/base/random.h"

namespace quatro {
namespace {

// One random generator for each seed and bin.
Random RandomOf(uint64_t seed, const DistanceBin& bin) {
  const uint64_t key = Mix(Mix(seed) ^ std::bit_cast<uint64_t>(bin.min));
  return Random(Mix(key ^ std::bit_cast<uint64_t>(bin.max)));
}

void SelectBin(const SequenceData& data,
               const DistanceBin& bin,
               const LoopPairOptions& options,
               PairSelection* selection) {
  const std::vector<Loop> loops = FindLoops(data, bin, options.loop);
  Random random = RandomOf(options.seed, bin);
  const auto max_per_source =
      static_cast<std::size_t>(options.max_pairs_per_source);
  std::vector<Loop> some_a_source;
  for (std::size_t begin = 0; begin < loops.size();) {
    std::size_t end = begin + 1;
    while (end < loops.size() && loops[end].source == loops[begin].source) {
      ++end;
    }
    for (const std::size_t i :
         DrawEvenly(end - begin, max_per_source, random)) {
      some_a_source.push_back(loops[begin + i]);
    }
    begin = end;
  }
  const auto max = static_cast<std::size_t>(options.max_pairs_per_bin);
  for (const std::size_t i : DrawEvenly(some_a_source.size(), max, random)) {
    const Loop& loop = some_a_source[i];
    PairTask task = *MakePairTask(data, loop.source, loop.target);
    task.bin = bin.Name();
    selection->tasks.push_back(std::move(task));
  }
  if (some_a_source.empty() || some_a_source.size() < max) {
    selection->notes.push_back(
        data.name + ": " + std::to_string(some_a_source.size()) + " pairs of " +
        bin.Name() +
        (max > 0 ? ", not " + std::to_string(max) : std::string()));
  }
}

}  // namespace

bool LoopOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (min_frame_gap < 0) {
    problem << "min_frame_gap = " << min_frame_gap << ", must be >= 0";
  } else if (!(min_path >= 0.0 && min_path <= 1e6)) {
    problem << "min_path = " << min_path << ", must be in [0, 1e6]";
  } else if (!(min_pair_spacing >= 0.0 && min_pair_spacing <= 1e6)) {
    problem << "min_pair_spacing = " << min_pair_spacing
            << ", must be in [0, 1e6]";
  }
  *error = problem.str();
  return error->empty();
}

bool LoopPairOptions::IsValid(std::string* error) const {
  if (!loop.IsValid(error)) return false;
  std::ostringstream problem;
  if (bins.empty()) {
    problem << "bins is empty, must have one";
  } else if (max_pairs_per_bin < 0) {
    problem << "max_pairs_per_bin = " << max_pairs_per_bin << ", must be >= 0";
  } else if (max_pairs_per_source < 0) {
    problem << "max_pairs_per_source = " << max_pairs_per_source
            << ", must be >= 0";
  }
  *error = problem.str();
  if (!error->empty()) return false;
  for (const DistanceBin& bin : bins) {
    if (!bin.IsValid(error)) return false;
  }
  return true;
}

std::vector<Loop> FindLoops(const SequenceData& data,
                            const DistanceBin& bin,
                            const LoopOptions& options) {
  struct Place {
    int frame;
    Eigen::Vector3d position;
    double path;  // s_i
  };
  std::vector<Place> places;
  std::vector<Loop> loops;
  double path = 0.0;
  std::optional<Eigen::Vector3d> last;
  for (const auto& [frame, pose] : data.world_from_sensor) {
    if (last) path += (pose.translation - *last).norm();
    last = pose.translation;
    if (!places.empty() &&
        path - places.back().path < options.min_pair_spacing) {
      continue;
    }
    for (const Place& earlier : places) {
      // For later places, both gaps are smaller still.
      if (frame - earlier.frame <= options.min_frame_gap ||
          path - earlier.path < options.min_path) {
        break;
      }
      const double distance = (pose.translation - earlier.position).norm();
      if (bin.Contains(distance)) {
        loops.push_back({frame, earlier.frame, distance});
      }
    }
    places.push_back({frame, pose.translation, path});
  }
  return loops;
}

std::optional<PairSelection> SelectLoopPairs(const SequenceData& data,
                                             const LoopPairOptions& options,
                                             std::string* error) {
  if (!options.IsValid(error)) return std::nullopt;
  PairSelection selection;
  for (const DistanceBin& bin : options.bins) {
    SelectBin(data, bin, options, &selection);
  }
  return selection;
}

}  // namespace quatro
