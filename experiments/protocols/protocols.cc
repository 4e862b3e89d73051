// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/protocols/protocols.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "experiments/base/number_text.h"
#include "experiments/protocols/added_yaw.h"
#include "experiments/protocols/interval_pairs.h"
#include "experiments/protocols/loop_pairs.h"
#include "features/base/cloud_text.h"

namespace quatro {
namespace {

std::optional<PairSelection> SelectPairsOf(const SequenceData& drive,
                                           const ProtocolOptions& options,
                                           std::string* error) {
  if (options.name == "loop" || options.name == "timing") {
    LoopPairOptions loops;
    loops.loop.min_frame_gap = options.min_frame_gap;
    loops.loop.min_path = options.min_path;
    loops.loop.min_pair_spacing = options.min_pair_spacing;
    loops.bins = options.bins;
    loops.max_pairs_per_bin = options.max_pairs;
    loops.max_pairs_per_source = options.max_pairs_per_source;
    loops.seed = options.seed;
    return SelectLoopPairs(drive, loops, error);
  }
  IntervalPairOptions intervals;
  intervals.intervals = options.intervals;
  intervals.max_pairs = options.max_pairs;
  intervals.seed = options.seed;
  if (options.name == "interval") {
    return SelectIntervalPairs(drive, intervals, error);
  }
  intervals.intervals = {options.intervals.back()};
  auto selection = SelectIntervalPairs(drive, intervals, error);
  if (selection) {
    selection->tasks =
        AddYaws(selection->tasks, YawSteps(options.yaw_step_deg));
  }
  return selection;
}

}  // namespace

std::vector<std::string> DriveProtocolNames() {
  return {"loop", "interval", "yaw", "timing"};
}

bool ProtocolOptions::IsValid(std::string* error) const {
  const std::vector<std::string> names = DriveProtocolNames();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    *error = "there is no protocol " + name;
  } else if (bins.empty()) {
    *error = "there is no distance bin";
  } else if (intervals.empty()) {
    *error = "there is no interval";
  } else if (max_pairs < 0) {
    *error = "max_pairs = " + std::to_string(max_pairs) + ", must be >= 0";
  } else if (max_pairs_per_source < 0) {
    *error = "max_pairs_per_source = " + std::to_string(max_pairs_per_source) +
             ", must be >= 0";
  } else if (!(yaw_step_deg >= 0.01 && yaw_step_deg <= 180.0)) {
    *error = (std::ostringstream() << "yaw_step_deg = " << yaw_step_deg
                                   << ", must be in [0.01, 180]")
                 .str();
  } else {
    return true;
  }
  return false;
}

std::optional<PairSelection> SelectPairs(
    const std::vector<SequenceData>& drives,
    const ProtocolOptions& options,
    std::string* error) {
  if (!options.IsValid(error)) return std::nullopt;
  PairSelection all;
  for (const SequenceData& drive : drives) {
    const auto selection = SelectPairsOf(drive, options, error);
    if (!selection) return std::nullopt;
    all.tasks.insert(
        all.tasks.end(), selection->tasks.begin(), selection->tasks.end());
    all.num_without_pose += selection->num_without_pose;
    all.num_missing_scans += selection->num_missing_scans;
    all.notes.insert(all.notes.end(), drive.notes.begin(), drive.notes.end());
    all.notes.insert(
        all.notes.end(), selection->notes.begin(), selection->notes.end());
  }
  return all;
}

std::optional<std::vector<DistanceBin>> ParseBins(const std::string& text,
                                                  std::string* error) {
  std::vector<DistanceBin> bins;
  for (const std::string_view field : SplitFields(text, ",")) {
    const auto ends = SplitFields(field, "-");
    const auto min =
        ends.size() == 2 ? ParseFiniteNumber(ends[0]) : std::nullopt;
    const auto max =
        ends.size() == 2 ? ParseFiniteNumber(ends[1]) : std::nullopt;
    if (!min || !max) {
      *error = Quoted(field) + " is not a bin, must be like 4-6";
      return std::nullopt;
    }
    bins.push_back({*min, *max});
    if (!bins.back().IsValid(error)) return std::nullopt;
  }
  if (!bins.empty()) return bins;
  *error = "there is no bin, must be like 0-2,4-6";
  return std::nullopt;
}

}  // namespace quatro
