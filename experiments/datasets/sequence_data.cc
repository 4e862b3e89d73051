// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/datasets/sequence_data.h"

#include <cstdio>
#include <filesystem>
#include <system_error>

namespace quatro {
namespace {

void Note(const std::vector<int>& frames,
          std::size_t num_frames,
          const std::string& lack,
          SequenceData* data) {
  if (frames.empty()) return;
  data->notes.push_back(data->name + ": " + std::to_string(frames.size()) +
                        " of " + std::to_string(num_frames) + " frames have " +
                        lack + ": " + FormatFrames(frames));
}

}  // namespace

void CountMissing(const std::function<std::string(int frame)>& path_of_scan,
                  SequenceData* data) {
  std::vector<int> without_scan, without_pose;
  for (const auto& [frame, path] : data->scans) {
    if (!data->world_from_sensor.contains(frame)) without_pose.push_back(frame);
  }
  for (const auto& [frame, pose] : data->world_from_sensor) {
    const auto [scan, is_new] = data->scans.try_emplace(frame);
    if (is_new) scan->second = path_of_scan(frame);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(scan->second, ignored)) {
      without_scan.push_back(frame);
    }
  }
  data->num_missing_scans = static_cast<int>(without_scan.size());
  data->num_missing_poses = static_cast<int>(without_pose.size());
  Note(without_scan, data->scans.size(), "no scan", data);
  Note(without_pose, data->scans.size(), "no pose", data);
}

int FirstScan(const SequenceData& data) {
  for (const auto& [frame, path] : data.scans) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) return frame;
  }
  return data.scans.empty() ? 0 : data.scans.begin()->first;
}

std::string FormatFrames(const std::vector<int>& frames) {
  constexpr int kMaxRuns = 5;
  std::string text;
  int num_runs = 0;
  for (std::size_t i = 0; i < frames.size();) {
    std::size_t end = i + 1;
    while (end < frames.size() && frames[end] == frames[end - 1] + 1) ++end;
    if (++num_runs > kMaxRuns) {
      return text + " ... (" + std::to_string(frames.size()) + " in all)";
    }
    if (i > 0) {
      text += end == frames.size() ? " and " : ", ";
    }
    text += std::to_string(frames[i]);
    if (end > i + 1) text += "-" + std::to_string(frames[end - 1]);
    i = end;
  }
  return text;
}

std::optional<PairTask> MakePairTask(const SequenceData& data,
                                     int source_frame,
                                     int target_frame) {
  const auto source = data.world_from_sensor.find(source_frame);
  const auto target = data.world_from_sensor.find(target_frame);
  if (source == data.world_from_sensor.end() ||
      target == data.world_from_sensor.end()) {
    return std::nullopt;
  }
  PairTask task;
  char frames[40];
  std::snprintf(
      frames, sizeof(frames), "/%06d-%06d", source_frame, target_frame);
  task.name = data.name + frames;
  task.set = data.name;
  const auto path_of = [&](int frame) {
    const auto scan = data.scans.find(frame);
    return scan == data.scans.end() ? std::string() : scan->second;
  };
  task.source = path_of(source_frame);
  task.target = path_of(target_frame);
  task.true_target_from_source = Inverse(target->second) * source->second;
  const auto source_ins = data.ins.find(source_frame);
  const auto target_ins = data.ins.find(target_frame);
  if (source_ins != data.ins.end() && target_ins != data.ins.end()) {
    task.ins = PairIns{source_ins->second, target_ins->second, data.ins_std};
  }
  return task;
}

}  // namespace quatro
