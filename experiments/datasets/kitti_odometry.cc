// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/datasets/kitti_odometry.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <system_error>

#include "experiments/datasets/kitti_poses.h"
#include "experiments/datasets/oxts.h"
#include "experiments/datasets/sequence.h"

namespace quatro {
namespace {

namespace fs = std::filesystem;

bool IsFile(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool IsFolder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

// Folders that may hold sequences.
std::vector<fs::path> PlacesOfSequences(const fs::path& root) {
  return {root / "sequences", root / "dataset" / "sequences", root};
}

std::optional<fs::path> FindSequence(const KittiOdometryOptions& options,
                                     std::string* error) {
  const fs::path root = options.folder;
  if (!IsFolder(root)) {
    *error = options.folder + ": is not a folder";
    return std::nullopt;
  }
  if (options.sequence.empty()) {
    const fs::path folder = fs::absolute(root).lexically_normal();
    return folder.has_filename() ? folder : folder.parent_path();
  }
  for (const fs::path& place : PlacesOfSequences(root)) {
    if (IsFolder(place / options.sequence)) return place / options.sequence;
  }
  *error = options.folder + ": holds no sequence '" + options.sequence +
           "'; looked for sequences/" + options.sequence +
           ", dataset/sequences/" + options.sequence + " and " +
           options.sequence;
  return std::nullopt;
}

// The poses of the sensor by equation (1).
std::optional<std::map<int, Rigid3>> ReadPoses(const std::string& path,
                                               const Rigid3& cam0_from_sensor,
                                               std::string* error) {
  const auto poses = ReadKittiPoses(path, error);
  if (!poses) return std::nullopt;
  const Rigid3 sensor_from_cam0 = Inverse(cam0_from_sensor);
  std::map<int, Rigid3> world_from_sensor;
  for (std::size_t i = 0; i < poses->size(); ++i) {
    world_from_sensor[static_cast<int>(i)] =
        sensor_from_cam0 * (*poses)[i] * cam0_from_sensor;
  }
  return world_from_sensor;
}

bool ReadInsOfPoses(const std::string& path,
                    const Rigid3& cam0_from_sensor,
                    SequenceData* data,
                    std::string* error) {
  const auto poses = ReadPoses(path, cam0_from_sensor, error);
  if (!poses) return false;
  for (const auto& [frame, pose] : *poses) {
    data->ins[frame] = AttitudeOf(pose.rotation);
  }
  data->notes.push_back(data->name + ": INS from " + path);
  return true;
}

bool ReadInsOfOxts(const fs::path& folder,
                   SequenceData* data,
                   std::string* error) {
  const auto readings = ReadOxts((folder / "oxts").string(), error);
  if (!readings) return false;
  Rigid3 velodyne_from_imu;
  const fs::path calibration = folder / "calib_imu_to_velo.txt";
  if (IsFile(calibration)) {
    const auto read = ReadImuToVelodyne(calibration.string(), error);
    if (!read) return false;
    velodyne_from_imu = *read;
  }
  for (const auto& [frame, reading] : *readings) {
    data->ins[frame] = AttitudeOf(WorldFromBody(reading.attitude) *
                                  velodyne_from_imu.rotation.transpose());
  }
  data->notes.push_back(data->name + ": INS from " +
                        (folder / "oxts").string());
  return true;
}

}  // namespace

bool KittiOdometryOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (folder.empty()) {
    problem << "folder is empty, must name one";
  } else if (!(ins_std > 0.0 && ins_std <= 0.2)) {
    problem << "ins_std = " << ins_std << ", must be in (0, 0.2]";
  }
  *error = problem.str();
  return error->empty();
}

std::vector<std::string> ListKittiSequences(const std::string& folder) {
  std::vector<std::string> names;
  for (const fs::path& place : PlacesOfSequences(folder)) {
    std::error_code status;
    for (fs::directory_iterator it(place, status), end; !status && it != end;
         it.increment(status)) {
      if (IsFile(it->path() / "calib.txt")) {
        names.push_back(it->path().filename().string());
      }
    }
    if (!names.empty()) break;
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::optional<SequenceData> ReadKittiOdometry(
    const KittiOdometryOptions& options, std::string* error) {
  if (!options.IsValid(error)) return std::nullopt;
  const auto folder = FindSequence(options, error);
  if (!folder) return std::nullopt;
  SequenceData data;
  data.name = folder->filename().string();
  data.ins_std = options.ins_std;

  const auto cam0_from_sensor = ReadKittiCalibration(
      options.calibration.empty() ? (*folder / "calib.txt").string()
                                  : options.calibration,
      error);
  if (!cam0_from_sensor) return std::nullopt;

  const fs::path own = *folder / "poses.txt";
  const fs::path official =
      folder->parent_path().parent_path() / "poses" / (data.name + ".txt");
  if (options.poses.empty() && !IsFile(own) && !IsFile(official)) {
    *error = folder->string() +
             ": there are no poses; looked for poses.txt and " +
             official.string() + "; name the file by --poses";
    return std::nullopt;
  }
  const std::string poses = !options.poses.empty() ? options.poses
                            : IsFile(own)          ? own.string()
                                                   : official.string();
  auto world_from_sensor = ReadPoses(poses, *cam0_from_sensor, error);
  if (!world_from_sensor) return std::nullopt;
  data.world_from_sensor = std::move(*world_from_sensor);
  data.notes.push_back(data.name + ": poses from " + poses);

  const fs::path velodyne = *folder / "velodyne";
  if (!options.poses_only) {
    auto scans = ListScans(velodyne.string(), error);
    if (!scans) return std::nullopt;
    data.scans = std::move(*scans);
  }
  CountMissing(
      [&](int frame) {
        char name[32];
        std::snprintf(name, sizeof(name), "%06d.bin", frame);
        return (velodyne / name).string();
      },
      &data);

  bool is_read = true;
  if (!options.ins_poses.empty()) {
    is_read =
        ReadInsOfPoses(options.ins_poses, *cam0_from_sensor, &data, error);
  } else if (IsFolder(*folder / "oxts")) {
    is_read = ReadInsOfOxts(*folder, &data, error);
  } else if (poses != official.string() && IsFile(official)) {
    is_read =
        ReadInsOfPoses(official.string(), *cam0_from_sensor, &data, error);
  }
  if (!is_read) return std::nullopt;
  return data;
}

}  // namespace quatro
