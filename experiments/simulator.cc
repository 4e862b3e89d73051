// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator.h"

#include <unistd.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <sstream>
#include <system_error>
#include <vector>

#include "experiments/street.h"
#include "features/cloud_io.h"
#include "features/file.h"

namespace quatro {
namespace {

namespace fs = std::filesystem;

// Street before the first pose and after the last [m]: little that is further
// away returns an echo.
constexpr double kMargin = 90.0;
constexpr double kFramePeriod = 0.1;  // [s]

// The options that pairs and sequences share.
template <typename Options>
void CheckCommon(const Options& options, std::ostringstream* problem) {
  RoadOptions road;
  road.slope = options.slope;
  road.tilt_sigma = options.tilt_sigma;
  std::string error;
  if (options.num_threads < 0) {
    *problem << "num_threads = " << options.num_threads << ", must be >= 0";
  } else if (!road.IsValid(&error) || !options.lidar.IsValid(&error)) {
    *problem << error;
  }
}

template <typename Options>
RoadOptions RoadFor(const Options& options, double travel) {
  RoadOptions road;
  road.seed = options.seed;
  road.slope = options.slope;
  road.tilt_sigma = options.tilt_sigma;
  road.length = travel + 2.0 * kMargin;
  return road;
}

// Axes of cam0: x right, y down, z forward. Mounted half a degree askew, as
// no real camera is aligned.
Rigid3 Cam0FromSensor() {
  Eigen::Matrix3d axes;
  axes << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  const Eigen::Vector3d askew(0.004, -0.007, 0.003);  // [rad]
  return {
      Eigen::AngleAxisd(askew.norm(), askew.normalized()).toRotationMatrix() *
          axes,
      Eigen::Vector3d(0.0, -0.08, -0.27)};
}

// 3x4 row by row, as KITTI writes it, with digits enough to give it back.
std::string FormatRows(const Eigen::Matrix<double, 3, 4>& matrix) {
  std::string line;
  for (Eigen::Index i = 0; i < 12; ++i) {
    char number[32];
    std::snprintf(
        number, sizeof(number), "%s%.15e", i ? " " : "", matrix(i / 4, i % 4));
    line += number;
  }
  return line + "\n";
}

std::string FormatRigid3(const Rigid3& transform) {
  return FormatRows(transform.ToMatrix().topRows<3>());
}

// Rectified pinhole cameras [px] beside each other, 0 and 1 grey, 2 and 3
// colour, and the sensor in cam0.
std::string FormatCalibration() {
  constexpr double kOffsets[] = {0.0, 0.54, -0.06, 0.47};  // [m]
  std::string text;
  for (int camera = 0; camera < 4; ++camera) {
    constexpr double kFocalLength = 720.0;
    Eigen::Matrix<double, 3, 4> projection;
    projection << kFocalLength, 0, 610, -kFocalLength * kOffsets[camera],  //
        0, kFocalLength, 185, 0,                                           //
        0, 0, 1, 0;
    text += "P" + std::to_string(camera) + ": " + FormatRows(projection);
  }
  return text + "Tr: " + FormatRigid3(Cam0FromSensor());
}

// Nothing there, an empty folder or, with `overwrite`, a sequence.
bool MayReplace(const fs::path& output, bool overwrite, std::string* error) {
  const std::set<std::string> known = {
      "velodyne", "poses.txt", "calib.txt", "times.txt"};
  std::error_code code;
  if (!fs::exists(output, code)) return true;
  if (!fs::is_directory(output, code)) {
    *error = output.string() + ": exists and is not a folder";
    return false;
  }
  for (fs::directory_iterator entry(output, code), end; !code && entry != end;
       entry.increment(code)) {
    const std::string name = entry->path().filename().string();
    if (!overwrite) {
      *error = output.string() + ": folder is not empty";
      return false;
    }
    if (!known.contains(name)) {
      *error = output.string() + ": holds '" + name +
               "', which no sequence does; not overwritten";
      return false;
    }
  }
  if (code) *error = output.string() + ": " + code.message();
  return !code;
}

bool WriteSequence(const SimulateSequenceOptions& options,
                   const fs::path& folder,
                   const SimulateProgress& progress,
                   std::string* error) {
  const Road road(
      RoadFor(options, (options.num_frames - 1) * options.frame_spacing));
  const auto scene = LidarScene::Create(MakeStreet(road), error);
  if (scene == nullptr) return false;

  const Rigid3 cam0_from_sensor = Cam0FromSensor();
  const Rigid3 first_from_world =
      Inverse(road.WorldFromSensor(kMargin, 0.0, 0.0));
  std::string poses, times;
  for (int i = 0; i < options.num_frames; ++i) {
    const Rigid3 world_from_sensor =
        road.WorldFromSensor(kMargin + i * options.frame_spacing, 0.0, 0.0);
    const PointCloud cloud =
        scene->Scan(world_from_sensor,
                    options.lidar,
                    {options.seed, static_cast<uint64_t>(i)},
                    options.num_threads);
    char name[32];
    std::snprintf(name, sizeof(name), "%06d.bin", i);
    if (!WriteCloud(cloud, folder / "velodyne" / name, error)) return false;
    poses += FormatRigid3(cam0_from_sensor * first_from_world *
                          world_from_sensor * Inverse(cam0_from_sensor));
    char time[32];
    std::snprintf(time, sizeof(time), "%e\n", i * kFramePeriod);
    times += time;
    if (progress) progress(i + 1, options.num_frames);
  }
  return WriteFileAtomically(folder / "poses.txt", poses, error) &&
         WriteFileAtomically(
             folder / "calib.txt", FormatCalibration(), error) &&
         WriteFileAtomically(folder / "times.txt", times, error);
}

// Puts the complete folder in the place of what may be there.
bool MoveInto(const fs::path& folder,
              const fs::path& output,
              std::string* error) {
  const fs::path old = folder.string() + ".old";
  std::error_code code;
  const bool replaces = fs::exists(output, code);
  if (replaces) fs::rename(output, old, code);
  if (!code) {
    fs::rename(folder, output, code);
    std::error_code ignored;
    if (code && replaces) fs::rename(old, output, ignored);
  }
  if (code) {
    *error = output.string() + ": " + code.message();
    return false;
  }
  fs::remove_all(old, code);
  return true;
}

}  // namespace

bool SimulatePairOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(distance >= 0.0 && distance <= 1000.0)) {
    problem << "distance = " << distance << ", must be in [0, 1000]";
  } else if (!std::isfinite(yaw)) {
    problem << "yaw = " << yaw << ", must be finite";
  } else if (!(std::abs(lateral) <= 2.0)) {
    problem << "lateral = " << lateral << ", must be within +-2";
  } else {
    CheckCommon(*this, &problem);
  }
  *error = problem.str();
  return error->empty();
}

std::optional<SimulatedPair> SimulatePair(const SimulatePairOptions& options,
                                          std::string* error) {
  if (!options.IsValid(error)) return std::nullopt;
  const Road road(RoadFor(options, options.distance));
  const auto scene = LidarScene::Create(MakeStreet(road), error);
  if (scene == nullptr) return std::nullopt;

  const Rigid3 world_from_target = road.WorldFromSensor(kMargin, 0.0, 0.0);
  const Rigid3 world_from_source = road.WorldFromSensor(
      kMargin + options.distance, options.lateral, options.yaw);
  const auto scan = [&](const Rigid3& world_from_sensor, uint64_t frame) {
    return scene->Scan(world_from_sensor,
                       options.lidar,
                       {options.seed, frame},
                       options.num_threads);
  };
  return SimulatedPair{scan(world_from_source, 1),
                       scan(world_from_target, 0),
                       Inverse(world_from_target) * world_from_source};
}

bool SimulateSequenceOptions::IsValid(std::string* error) const {
  constexpr double kMaxTravel = 5000.0;  // [m]; some 10 million triangles.
  std::ostringstream problem;
  if (num_frames < 1 || num_frames > 1000000) {
    problem << "num_frames = " << num_frames << ", must be in [1, 1000000]";
  } else if (!(frame_spacing > 0.0)) {
    problem << "frame_spacing = " << frame_spacing << ", must be > 0";
  } else if (!(num_frames * frame_spacing <= kMaxTravel)) {
    problem << "num_frames * frame_spacing = " << num_frames * frame_spacing
            << ", must be <= " << kMaxTravel;
  } else {
    CheckCommon(*this, &problem);
  }
  *error = problem.str();
  return error->empty();
}

bool SimulateSequence(const SimulateSequenceOptions& options,
                      const std::string& output_dir,
                      const SimulateProgress& progress,
                      std::string* error) {
  if (!options.IsValid(error)) return false;
  if (output_dir.empty()) {
    *error = "output_dir is empty, must name a folder";
    return false;
  }
  std::error_code code;
  fs::path output = fs::weakly_canonical(fs::absolute(output_dir), code);
  if (!code && !output.has_filename()) output = output.parent_path();
  if (code) {
    *error = output_dir + ": " + code.message();
    return false;
  }
  if (!MayReplace(output, options.overwrite, error)) return false;

  const fs::path folder =
      output.string() + ".partial." + std::to_string(getpid());
  fs::create_directories(folder / "velodyne", code);
  if (code) {
    *error = folder.string() + ": " + code.message();
    return false;
  }
  const bool ok = WriteSequence(options, folder, progress, error) &&
                  MoveInto(folder, output, error);
  if (!ok) fs::remove_all(folder, code);
  return ok;
}

}  // namespace quatro
