// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/protocols/odometry_runs.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/datasets/kitti_poses.h"
#include "experiments/datasets/sequence.h"
#include "experiments/metrics/kitti_metrics.h"
#include "experiments/odometry/odometry_methods.h"
#include "experiments/odometry/outside_drift.h"
#include "features/base/file.h"

namespace quatro {
namespace {

using Json = nlohmann::ordered_json;

struct PlannedRun {
  const SequenceData* drive = nullptr;
  std::string method;
  int interval = 1;
  std::map<int, std::string> scans;  // By frame, as selected.
  std::vector<int> frames;
  std::vector<Rigid3> true_poses;
  std::string path;  // Without file extension.
};

// Returns nullopt with *error set if the run is not possible.
std::optional<PlannedRun> Plan(const SequenceData& drive,
                               const std::string& method,
                               int interval,
                               int max_frames,
                               const std::string& folder,
                               std::string* error) {
  PlannedRun run{&drive, method, interval, {}, {}, {}, {}};
  const int first = FirstScan(drive);
  for (const auto& [frame, path] : drive.scans) {
    if (frame < first) continue;
    if (max_frames > 0 && static_cast<int>(run.scans.size()) == max_frames) {
      break;
    }
    run.scans[frame] = path;
  }
  SequenceOptions options;
  options.interval = interval;
  if (run.scans.empty()) {
    *error = drive.name + ": there are no scans";
    return std::nullopt;
  }
  const auto frames = FramesOf(run.scans, options, error);
  if (!frames) return std::nullopt;
  run.frames = *frames;
  for (const int frame : run.frames) {
    const auto pose = drive.world_from_sensor.find(frame);
    if (pose == drive.world_from_sensor.end()) {
      *error =
          drive.name + ": frame " + std::to_string(frame) + " has no true pose";
      return std::nullopt;
    }
    run.true_poses.push_back(pose->second);
  }
  run.path =
      folder + "/" + drive.name + "_" + method + "_" + std::to_string(interval);
  return run;
}

Json DescribeRun(const PlannedRun& run) {
  return {{"drive", run.drive->name},
          {"method", run.method},
          {"interval", run.interval},
          {"frames", run.frames.size()},
          {"first_frame", run.frames.front()},
          {"last_frame", run.frames.back()}};
}

// Names of folders need not be UTF-8.
std::string Dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// Writes the files of a completed run.
bool WriteRun(const PlannedRun& plan,
              const OdometryRun& run,
              std::string* error) {
  Json json = DescribeRun(plan);
  json["num_lost"] = run.num_lost;
  json["median_seconds"] = run.MedianSeconds();
  return WriteFileAtomically(
             plan.path + ".txt", FormatKittiPoses(run.Poses()), error) &&
         WriteFileAtomically(plan.path + ".json", Dump(json), error);
}

// Reads the result of a completed run from its files. Returns nullopt without
// *error if there are none.
std::optional<OdometryResult> ReadRun(const PlannedRun& plan,
                                      std::string* error) {
  error->clear();
  std::error_code ignored;
  if (!std::filesystem::exists(plan.path + ".json", ignored)) {
    return std::nullopt;
  }
  const auto text = ReadWholeFile(plan.path + ".json", error);
  if (!text) return std::nullopt;
  const Json json = Json::parse(*text, nullptr, false);
  const Json expected = Json::parse(Dump(DescribeRun(plan)));
  for (const auto& [key, value] : expected.items()) {
    if (json.is_object() && json.value(key, Json()) == value) continue;
    *error = plan.path + ".json: belongs to another run (" + key +
             "); choose another --output";
    return std::nullopt;
  }
  const auto poses = ReadKittiPoses(plan.path + ".txt", error);
  if (!poses) return std::nullopt;
  const auto drift = ComputeKittiDrift(plan.true_poses, *poses, {}, error);
  if (!drift) {
    *error = plan.path + ".txt: " + *error;
    return std::nullopt;
  }
  OdometryResult result;
  result.drive = plan.drive->name;
  result.drift.method = plan.method;
  result.drift.interval = plan.interval;
  result.drift.translation_percent = drift->translation_percent;
  result.drift.rotation_deg_per_100m = drift->rotation_deg_per_100m;
  result.drift.num_lost = json.value("num_lost", 0);
  result.drift.median_seconds = json.value("median_seconds", 0.0);
  result.path_length = drift->path_length;
  result.end_translation_error = drift->end_translation_error;
  return result;
}

bool RunOne(const PlannedRun& plan,
            const OdometryRunOptions& all,
            const std::function<void(const OdometryRunProgress&)>& progress,
            std::string* error) {
  const std::unique_ptr<Odometry> odometry =
      MakeOdometry(plan.method, all.registration, error);
  if (!odometry) return false;
  SequenceOptions options;
  options.interval = plan.interval;
  options.reading = all.reading;
  const auto run = RunOdometry(
      plan.scans,
      options,
      odometry.get(),
      [&](int num_done, int num_scans) {
        if (!progress) return;
        progress({plan.drive->name,
                  plan.method,
                  plan.interval,
                  num_done,
                  num_scans});
      },
      error);
  return run && WriteRun(plan, *run, error);
}

}  // namespace

bool OdometryRunOptions::IsValid(std::string* error) const {
  if (methods.empty() || intervals.empty()) {
    *error = methods.empty() ? "there is no method" : "there is no interval";
    return false;
  }
  for (const int interval : intervals) {
    SequenceOptions options;
    options.interval = interval;
    options.reading = reading;
    if (!options.IsValid(error)) return false;
  }
  if (max_frames < 0) {
    *error = "max_frames = " + std::to_string(max_frames) + ", must be >= 0";
    return false;
  }
  for (const std::string& method : methods) {
    if (!MakeOdometry(method, registration, error)) return false;
  }
  return true;
}

std::optional<std::vector<OdometryResult>> RunOdometries(
    const std::vector<SequenceData>& drives,
    const OdometryRunOptions& options,
    const std::string& output,
    const std::function<void(const OdometryRunProgress&)>& progress,
    std::string* error) {
  if (!options.IsValid(error)) return std::nullopt;
  const std::string folder = output + "/odometry";
  std::error_code status;
  std::filesystem::create_directories(folder, status);
  if (status) {
    *error = folder + ": " + status.message();
    return std::nullopt;
  }
  std::vector<OdometryResult> results;
  for (const SequenceData& drive : drives) {
    for (const int interval : options.intervals) {
      for (const std::string& method : options.methods) {
        const auto plan =
            Plan(drive, method, interval, options.max_frames, folder, error);
        if (!plan) return std::nullopt;
        auto result = ReadRun(*plan, error);
        if (!result && error->empty()) {
          if (!RunOne(*plan, options, progress, error)) {
            return std::nullopt;
          }
          result = ReadRun(*plan, error);
        }
        if (!result) return std::nullopt;
        results.push_back(*result);
      }
    }
  }
  return results;
}

std::vector<DriftEntry> MeanDrifts(const std::vector<OdometryResult>& results) {
  std::vector<DriftEntry> means;
  std::vector<int> counts;
  for (const OdometryResult& result : results) {
    if (!std::isfinite(result.drift.translation_percent)) continue;
    std::size_t i = 0;
    while (i < means.size() && (means[i].method != result.drift.method ||
                                means[i].interval != result.drift.interval)) {
      ++i;
    }
    if (i == means.size()) {
      means.push_back(result.drift);
      counts.push_back(1);
      continue;
    }
    means[i].translation_percent += result.drift.translation_percent;
    means[i].rotation_deg_per_100m += result.drift.rotation_deg_per_100m;
    *means[i].num_lost += *result.drift.num_lost;
    *means[i].median_seconds += *result.drift.median_seconds;
    ++counts[i];
  }
  for (std::size_t i = 0; i < means.size(); ++i) {
    means[i].translation_percent /= counts[i];
    means[i].rotation_deg_per_100m /= counts[i];
    *means[i].median_seconds /= counts[i];
  }
  return means;
}

}  // namespace quatro
