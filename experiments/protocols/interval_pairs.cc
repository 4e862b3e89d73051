// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/protocols/interval_pairs.h"

#include <cstdint>
#include <sstream>

#include "experiments/protocols/draw_evenly.h"
#include "features/base/random.h"

namespace quatro {

bool IntervalPairOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (intervals.empty()) {
    problem << "intervals is empty, must have one";
  } else if (first_frame < -1) {
    problem << "first_frame = " << first_frame
            << ", must be -1 (the first scan) or >= 0";
  } else if (last_frame != -1 && last_frame < first_frame) {
    problem << "last_frame = " << last_frame
            << ", must be -1 or >= first_frame = " << first_frame;
  } else if (max_pairs < 0) {
    problem << "max_pairs = " << max_pairs << ", must be >= 0";
  }
  for (const int interval : intervals) {
    if (interval < 1 && problem.str().empty()) {
      problem << "interval = " << interval << ", must be >= 1";
    }
  }
  *error = problem.str();
  return error->empty();
}

std::optional<PairSelection> SelectIntervalPairs(
    const SequenceData& data,
    const IntervalPairOptions& options,
    std::string* error) {
  if (!options.IsValid(error)) return std::nullopt;
  PairSelection selection;
  const int last = options.last_frame >= 0 ? options.last_frame
                   : data.scans.empty()    ? -1
                                           : data.scans.rbegin()->first;
  const int first =
      options.first_frame >= 0 ? options.first_frame : FirstScan(data);
  for (const int interval : options.intervals) {
    std::vector<PairTask> tasks;
    int num_without_pose = 0;
    const int step = options.is_chain ? interval : 1;
    for (std::int64_t i = first; i + interval <= last; i += step) {
      const int target = static_cast<int>(i);
      auto task = MakePairTask(data, target + interval, target);
      if (!task) {
        ++num_without_pose;
        continue;
      }
      task->bin = "interval " + std::to_string(interval);
      tasks.push_back(std::move(*task));
    }
    if (num_without_pose > 0) {
      selection.num_without_pose += num_without_pose;
      selection.notes.push_back(
          data.name + ": " + std::to_string(num_without_pose) +
          " pairs of interval " + std::to_string(interval) + " lack a pose");
    }
    Random random(Mix(options.seed) ^ static_cast<uint64_t>(interval));
    for (const std::size_t i :
         DrawEvenly(tasks.size(),
                    static_cast<std::size_t>(options.max_pairs),
                    random)) {
      selection.tasks.push_back(std::move(tasks[i]));
    }
  }
  return selection;
}

}  // namespace quatro
