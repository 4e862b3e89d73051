// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/table_two.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include "experiments/odometry/kitti_poses.h"

namespace quatro {
namespace {

struct Quoted {
  const char* method;
  int interval;
  double translation_percent;
  double rotation_deg_per_100m;
};

constexpr Quoted kQuoted[] = {
    {"ICP", 1, 6.88, 2.99},           {"ICP", 3, 21.92, 8.70},
    {"ICP", 5, 21.14, 8.51},          {"G-ICP", 1, 1.26, 0.45},
    {"G-ICP", 3, 5.50, 1.45},         {"G-ICP", 5, 14.20, 3.32},
    {"VG-ICP", 1, 1.03, 0.30},        {"VG-ICP", 3, 11.83, 1.65},
    {"VG-ICP", 5, 19.11, 6.32},       {"FGR", 1, 2.73, 0.69},
    {"FGR", 3, 7.17, 1.58},           {"FGR", 5, 14.66, 4.12},
    {"TEASER++", 1, 2.11, 0.91},      {"TEASER++", 3, 2.64, 1.11},
    {"TEASER++", 5, 3.19, 0.91},      {"Quatro", 1, 1.45, 0.41},
    {"Quatro", 3, 1.38, 0.24},        {"Quatro", 5, 1.94, 0.46},
    {"SUMA", 1, 0.68, 0.23},          {"SUMA", 3, 1.69, 0.61},
    {"SUMA", 5, 2.36, 0.51},          {"A-LOAM", 1, 0.70, 0.27},
    {"A-LOAM", 3, 0.97, 0.38},        {"A-LOAM", 5, 31.16, 12.10},
    {"LO-Net", 1, 1.47, 0.72},        {"LO-Net+M", 1, 0.78, 0.42},
    {"DMLO", 1, 0.83, 0.44},          {"DMLO+M", 1, 0.73, 0.44},
    {"StickyPillars", 1, 0.65, 0.26}, {"StickyPillars", 3, 0.79, 0.31},
    {"StickyPillars", 5, 1.29, 0.48}, {"Quatro-c2f", 1, 0.65, 0.21},
    {"Quatro-c2f", 3, 0.67, 0.21},    {"Quatro-c2f", 5, 0.67, 0.21},
};

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

std::string Number(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", digits, value);
  return text;
}

}  // namespace

std::vector<DriftEntry> QuotedTableTwo() {
  std::vector<DriftEntry> entries;
  for (const Quoted& quoted : kQuoted) {
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
  std::set<int> intervals;
  std::vector<std::pair<std::string, DriftOrigin>> rows;
  for (const DriftEntry& entry : entries) {
    intervals.insert(entry.interval);
    const std::pair key(entry.method, entry.origin);
    if (std::find(rows.begin(), rows.end(), key) == rows.end()) {
      rows.push_back(key);
    }
  }
  Table table;
  table.columns = {"method", "origin"};
  for (const int interval : intervals) {
    const std::string at = " at " + std::to_string(interval);
    table.columns.push_back("t_rel %" + at);
    table.columns.push_back("r_rel deg/100m" + at);
    table.columns.push_back("lost" + at);
    table.columns.push_back("ms" + at);
  }
  for (const auto& [method, origin] : rows) {
    std::vector<std::string> row = {method, OriginName(origin)};
    for (const int interval : intervals) {
      const auto found =
          std::find_if(entries.begin(), entries.end(), [&](const auto& entry) {
            return entry.method == method && entry.origin == origin &&
                   entry.interval == interval;
          });
      if (found == entries.end()) {
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

}  // namespace quatro
