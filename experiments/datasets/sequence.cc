// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/datasets/sequence.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <system_error>

#include "features/io/cloud_format.h"

namespace quatro {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxMissing = 10000;  // In a row.

std::optional<int> FrameNumber(const std::string& stem) {
  int number = 0;
  const char* end = stem.data() + stem.size();
  const auto result = std::from_chars(stem.data(), end, number);
  if (result.ec != std::errc() || result.ptr != end || number < 0) {
    return std::nullopt;
  }
  return number;
}

}  // namespace

bool IsHiddenFile(const fs::path& path) {
  return path.filename().string().starts_with('.');
}

std::optional<std::map<int, std::string>> ListScans(const std::string& folder,
                                                    std::string* error) {
  std::error_code status;
  fs::path place = fs::path(folder) / "velodyne";
  if (!fs::is_directory(place, status)) place = folder;
  if (fs::is_regular_file(place, status)) {
    *error = folder + ": is a file, must be a folder of scans";
    return std::nullopt;
  }
  std::map<int, std::string> scans;
  for (fs::directory_iterator it(place, status), end; !status && it != end;
       it.increment(status)) {
    const fs::path& path = it->path();
    const auto type = FindCloudFileType(path.string());
    // Text files in this folder are time stamps, poses or calibration, not
    // scans.
    if (IsHiddenFile(path) || !type || type->format == CloudFormat::kText) {
      continue;
    }
    const fs::path stem = type->is_gzip ? path.stem().stem() : path.stem();
    const auto number = FrameNumber(stem.string());
    if (!number) {
      *error =
          path.string() +
          ": the name is not a frame number, as in 000000.bin; move it away";
      return std::nullopt;
    }
    if (!scans.emplace(*number, path.string()).second) {
      *error = path.string() + ": there is another scan of frame " +
               std::to_string(*number);
      return std::nullopt;
    }
  }
  if (status) {
    *error = place.string() + ": " + status.message();
    return std::nullopt;
  }
  if (scans.empty()) {
    *error = place.string() + ": holds no .bin, .ply, .pcd or .npy";
    return std::nullopt;
  }
  return scans;
}

bool SequenceOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (interval < 1) {
    problem << "interval = " << interval << ", must be >= 1";
  } else if (first_frame < -1) {
    problem << "first_frame = " << first_frame
            << ", must be -1 (the first file) or >= 0";
  } else if (last_frame != -1 && last_frame < first_frame) {
    problem << "last_frame = " << last_frame
            << ", must be -1 or >= first_frame = " << first_frame;
  }
  *error = problem.str();
  return error->empty() && reading.IsValid(error);
}

std::optional<std::vector<int>> FramesOf(
    const std::map<int, std::string>& scans,
    const SequenceOptions& options,
    std::string* error) {
  int last = scans.empty() ? -1 : scans.rbegin()->first;
  if (options.last_frame >= 0) last = std::min(last, options.last_frame);
  const int first = options.first_frame >= 0 || scans.empty()
                        ? options.first_frame
                        : scans.begin()->first;
  if (first > last || first < 0) {
    *error = "no frame is left: first_frame = " + std::to_string(first) +
             " is after the last one, " + std::to_string(last);
    return std::nullopt;
  }
  int previous = first - 1;
  for (auto scan = scans.lower_bound(first); previous < last; ++scan) {
    const int num_missing = std::min(scan->first, last) - previous - 1;
    if (num_missing > kMaxMissing) {
      *error = scan->second + ": more than " + std::to_string(kMaxMissing) +
               " frames before it have no file; move it away, or leave it "
               "out with first_frame or last_frame";
      return std::nullopt;
    }
    previous = scan->first;
  }
  std::vector<int> frames;
  for (std::int64_t frame = first; frame <= last; frame += options.interval) {
    frames.push_back(static_cast<int>(frame));
  }
  return frames;
}

double OdometryRun::MedianSeconds() const {
  if (steps.empty()) return std::nan("");
  std::vector<double> seconds;
  for (const OdometryStep& step : steps) seconds.push_back(step.seconds);
  const auto middle =
      seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
  std::nth_element(seconds.begin(), middle, seconds.end());
  return *middle;
}

std::vector<Rigid3> OdometryRun::Poses() const {
  std::vector<Rigid3> poses;
  for (const OdometryStep& step : steps) poses.push_back(step.world_from_scan);
  return poses;
}

std::optional<OdometryRun> RunOdometry(const std::map<int, std::string>& scans,
                                       const SequenceOptions& options,
                                       Odometry* odometry,
                                       const OdometryProgress& progress,
                                       std::string* error) {
  if (!options.IsValid(error)) return std::nullopt;
  const auto frames = FramesOf(scans, options, error);
  if (!frames) return std::nullopt;
  OdometryRun run;
  run.frames = *frames;
  for (const int frame : run.frames) {
    const auto found = scans.find(frame);
    std::string unreadable;
    std::optional<PointCloud> scan;
    if (found == scans.end()) {
      unreadable = "there is no file of frame " + std::to_string(frame);
    } else {
      scan = ReadCloud(found->second, options.reading, &unreadable);
    }
    OdometryStep step = odometry->AddScan(scan ? *scan : PointCloud{});
    if (!scan) {
      ++run.num_unreadable;
      step.message = unreadable;
    }
    step.status == OdometryStatus::kLost ? ++run.num_lost : ++run.num_tracked;
    run.steps.push_back(step);
    if (progress) {
      progress(static_cast<int>(run.steps.size()),
               static_cast<int>(run.frames.size()));
    }
  }
  return run;
}

}  // namespace quatro
