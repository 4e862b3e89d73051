// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/table_two.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include "experiments/datasets/kitti_poses.h"
#include "experiments/tables/latex.h"
#include "experiments/tables/published_figures.h"

namespace quatro {
namespace {

const char* OriginName(DriftOrigin origin) {
  switch (origin) {
    case DriftOrigin::kMeasured:
      return "measured";
    case DriftOrigin::kFile:
      return "file";
    case DriftOrigin::kQuoted:
      break;
  }
  return "quoted";
}

std::set<int> IntervalsOf(const std::vector<DriftEntry>& entries) {
  std::set<int> intervals;
  for (const DriftEntry& entry : entries) intervals.insert(entry.interval);
  return intervals;
}

// Methods and origins in order of first occurrence.
std::vector<std::pair<std::string, DriftOrigin>> RowsOf(
    const std::vector<DriftEntry>& entries) {
  std::vector<std::pair<std::string, DriftOrigin>> rows;
  for (const DriftEntry& entry : entries) {
    const std::pair key(entry.method, entry.origin);
    if (std::find(rows.begin(), rows.end(), key) == rows.end()) {
      rows.push_back(key);
    }
  }
  return rows;
}

// Returns null if there is no such entry.
const DriftEntry* Find(const std::vector<DriftEntry>& entries,
                       const std::string& method,
                       DriftOrigin origin,
                       int interval) {
  for (const DriftEntry& entry : entries) {
    if (entry.method == method && entry.origin == origin &&
        entry.interval == interval) {
      return &entry;
    }
  }
  return nullptr;
}

std::string Number(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", digits, value);
  return text;
}

}  // namespace

std::vector<DriftEntry> QuotedTableTwo() {
  std::vector<DriftEntry> entries;
  for (const PublishedDrift& quoted : PublishedTableTwo()) {
    DriftEntry entry;
    entry.method = quoted.method;
    entry.interval = quoted.interval;
    entry.translation_percent = quoted.translation_percent;
    entry.rotation_deg_per_100m = quoted.rotation_deg_per_100m;
    entry.origin = DriftOrigin::kQuoted;
    entries.push_back(entry);
  }
  return entries;
}

std::optional<DriftEntry> DriftOfPoseFile(const std::string& method,
                                          int interval,
                                          const std::string& path,
                                          const std::vector<Rigid3>& true_poses,
                                          const std::vector<int>& frames,
                                          std::string* error) {
  auto estimated = ReadKittiPoses(path, error);
  if (!estimated) return std::nullopt;
  const auto truth = SelectFrames(true_poses, frames, error);
  if (!truth) return std::nullopt;
  if (estimated->size() == true_poses.size()) {
    estimated = SelectFrames(*estimated, frames, error);
  } else if (estimated->size() != frames.size()) {
    *error = path + ": has " + std::to_string(estimated->size()) +
             " poses, must have " + std::to_string(frames.size()) +
             " (of the run) or " + std::to_string(true_poses.size()) +
             " (of the drive)";
    return std::nullopt;
  }
  const auto drift = ComputeKittiDrift(*truth, *estimated, {}, error);
  if (!drift) return std::nullopt;
  DriftEntry entry;
  entry.method = method;
  entry.interval = interval;
  entry.translation_percent = drift->translation_percent;
  entry.rotation_deg_per_100m = drift->rotation_deg_per_100m;
  entry.origin = DriftOrigin::kFile;
  return entry;
}

Table MakeTableTwo(const std::vector<DriftEntry>& entries) {
  const auto intervals = IntervalsOf(entries);
  Table table;
  table.columns = {"method", "origin"};
  for (const int interval : intervals) {
    const std::string at = " at " + std::to_string(interval);
    table.columns.push_back("t_rel %" + at);
    table.columns.push_back("r_rel deg/100m" + at);
    table.columns.push_back("lost" + at);
    table.columns.push_back("ms" + at);
  }
  for (const auto& [method, origin] : RowsOf(entries)) {
    std::vector<std::string> row = {method, OriginName(origin)};
    for (const int interval : intervals) {
      const DriftEntry* const found = Find(entries, method, origin, interval);
      if (!found) {
        row.insert(row.end(), 4, "-");
        continue;
      }
      row.push_back(Number(found->translation_percent, 2));
      row.push_back(Number(found->rotation_deg_per_100m, 2));
      row.push_back(found->num_lost ? std::to_string(*found->num_lost) : "-");
      row.push_back(found->median_seconds
                        ? Number(1e3 * *found->median_seconds, 0)
                        : "-");
    }
    table.rows.push_back(row);
  }
  return table;
}

Table MakeDriftTable(const std::vector<DriftEntry>& entries) {
  const auto intervals = IntervalsOf(entries);
  Table table;
  table.columns = {"method", "origin"};
  for (const int interval : intervals) {
    const std::string group = "interval " + std::to_string(interval) + " / ";
    table.columns.push_back(group + "t_rel %");
    table.columns.push_back(group + "r_rel deg/100m");
  }
  for (const auto& [method, origin] : RowsOf(entries)) {
    std::vector<std::string> row = {method, OriginName(origin)};
    for (const int interval : intervals) {
      const DriftEntry* const found = Find(entries, method, origin, interval);
      row.push_back(found ? Number(found->translation_percent, 2) : "-");
      row.push_back(found ? Number(found->rotation_deg_per_100m, 2) : "-");
    }
    table.rows.push_back(row);
  }
  return table;
}

std::string FormatTableTwoLatex(const std::vector<DriftEntry>& entries) {
  return FormatLatex(MakeDriftTable(entries),
                     {.caption = "Drift of odometries at frame intervals.",
                      .label = "tab:drift"});
}

}  // namespace quatro
