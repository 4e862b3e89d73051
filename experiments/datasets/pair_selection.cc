// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/datasets/pair_selection.h"

#include <filesystem>
#include <set>
#include <system_error>

namespace quatro {

void CountMissingScans(PairSelection* selection) {
  std::set<std::string> seen;
  std::string first;
  int num_missing = 0;
  for (const PairTask& task : selection->tasks) {
    for (const std::string* path : {&task.source, &task.target}) {
      if (!seen.insert(*path).second) continue;
      std::error_code ignored;
      if (std::filesystem::is_regular_file(*path, ignored)) continue;
      if (num_missing++ == 0) first = *path;
    }
  }
  selection->num_missing_scans = num_missing;
  if (num_missing > 0) {
    selection->notes.push_back(std::to_string(num_missing) + " of " +
                               std::to_string(seen.size()) +
                               " scans are missing, the first is " + first);
  }
}

}  // namespace quatro
