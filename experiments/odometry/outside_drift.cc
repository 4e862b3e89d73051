// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/outside_drift.h"

#include <string_view>

#include "experiments/base/number_text.h"
#include "features/base/cloud_text.h"

namespace quatro {

std::optional<std::vector<OutsideResult>> ParseOutside(const std::string& text,
                                                       std::string* error) {
  std::vector<OutsideResult> results;
  for (const std::string_view part : SplitFields(text, ",")) {
    const std::size_t equals = part.find('=');
    if (equals == 0 || equals == std::string_view::npos ||
        equals + 1 == part.size()) {
      *error = "--outside: " + Quoted(part) + " is not NAME=POSES";
      return std::nullopt;
    }
    results.push_back({std::string(part.substr(0, equals)),
                       std::string(part.substr(equals + 1))});
  }
  return results;
}

DriftEntry MeasuredEntry(const std::string& method,
                         int interval,
                         const OdometryRun& run,
                         const KittiDrift& drift) {
  DriftEntry entry;
  entry.method = method;
  entry.interval = interval;
  entry.translation_percent = drift.translation_percent;
  entry.rotation_deg_per_100m = drift.rotation_deg_per_100m;
  entry.num_lost = run.num_lost;
  entry.median_seconds = run.MedianSeconds();
  return entry;
}

}  // namespace quatro
