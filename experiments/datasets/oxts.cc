// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/datasets/oxts.h"

#include <Eigen/Core>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "experiments/base/number_text.h"
#include "experiments/datasets/kitti_poses.h"
#include "experiments/datasets/sequence.h"
#include "features/base/degree.h"
#include "features/base/file.h"

namespace quatro {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kNumNumbers = 30;
constexpr double kMaxAltitude = 1e5;  // [m]

std::optional<OxtsReading> ReadReading(const std::string& path,
                                       std::string* error) {
  const auto text = ReadTextFile(path, error);
  if (!text) return std::nullopt;
  std::vector<std::string_view> lines = SplitLines(*text);
  while (!lines.empty() && SplitFields(lines.back(), kBlanks).empty()) {
    lines.pop_back();
  }
  if (lines.size() != 1) {
    *error =
        path + ": has " + std::to_string(lines.size()) + " lines, must have 1";
    return std::nullopt;
  }
  const auto fields = SplitFields(lines[0], kBlanks);
  if (fields.size() != kNumNumbers) {
    *error = path + ": line 1 has " + std::to_string(fields.size()) +
             " numbers, must have 30";
    return std::nullopt;
  }
  double values[6];
  for (std::size_t i = 0; i < 6; ++i) {
    const auto value = ParseFiniteNumber(fields[i]);
    if (!value) {
      *error = path + ": line 1 number " + std::to_string(i + 1) +
               " is not a finite number";
      return std::nullopt;
    }
    values[i] = *value;
  }
  if (!(std::abs(values[0]) < 90.0)) {
    *error = path + ": line 1 has a latitude that is not within 90 deg";
    return std::nullopt;
  }
  if (!(std::abs(values[1]) <= 360.0)) {
    *error = path + ": line 1 has a longitude that is not within 360 deg";
    return std::nullopt;
  }
  if (!(std::abs(values[2]) <= kMaxAltitude)) {
    *error = path + ": line 1 has an altitude of more than 100 km";
    return std::nullopt;
  }
  OxtsReading reading;
  reading.latitude = values[0];
  reading.longitude = values[1];
  reading.altitude = values[2];
  reading.attitude = {values[3], values[4], values[5]};
  return reading;
}

// The position by equation (1), with the longitude relative to `first`.
Eigen::Vector3d Project(const OxtsReading& reading,
                        const OxtsReading& first,
                        double scale) {
  constexpr double kEarth = 6378137.0;  // Radius [m].
  const double longitude =
      std::remainder(reading.longitude - first.longitude, 360.0);
  return {scale * kEarth * longitude * kDegree,
          scale * kEarth *
              std::log(std::tan((90.0 + reading.latitude) * kDegree / 2.0)),
          reading.altitude};
}

}  // namespace

std::optional<std::map<int, OxtsReading>> ReadOxts(const std::string& folder,
                                                   std::string* error) {
  const fs::path place = fs::path(folder) / "data";
  std::map<int, OxtsReading> readings;
  std::error_code status;
  for (fs::directory_iterator it(place, status), end; !status && it != end;
       it.increment(status)) {
    const fs::path& path = it->path();
    if (path.extension() != ".txt" || IsHiddenFile(path)) continue;
    const std::string stem = path.stem().string();
    int frame = -1;
    const char* const stop = stem.data() + stem.size();
    const auto parsed = std::from_chars(stem.data(), stop, frame);
    if (parsed.ec != std::errc() || parsed.ptr != stop || frame < 0) {
      *error = path.string() + ": the name is not a frame number";
      return std::nullopt;
    }
    const auto reading = ReadReading(path.string(), error);
    if (!reading) return std::nullopt;
    if (!readings.emplace(frame, *reading).second) {
      *error = path.string() + ": there is another reading of frame " +
               std::to_string(frame);
      return std::nullopt;
    }
  }
  if (status) {
    *error = place.string() + ": " + status.message();
    return std::nullopt;
  }
  if (readings.empty()) {
    *error = place.string() + ": holds no readings of an INS, *.txt";
    return std::nullopt;
  }
  return readings;
}

std::map<int, Rigid3> PosesOfOxts(const std::map<int, OxtsReading>& readings) {
  std::map<int, Rigid3> world_from_imu;
  if (readings.empty()) return world_from_imu;
  const OxtsReading& first = readings.begin()->second;
  const double scale = std::cos(first.latitude * kDegree);
  const Eigen::Vector3d origin = Project(first, first, scale);
  for (const auto& [frame, reading] : readings) {
    world_from_imu[frame] = {WorldFromBody(reading.attitude),
                             Project(reading, first, scale) - origin};
  }
  return world_from_imu;
}

std::optional<Rigid3> ReadImuToVelodyne(const std::string& path,
                                        std::string* error) {
  const auto text = ReadTextFile(path, error);
  if (!text) return std::nullopt;
  Eigen::Matrix<double, 3, 4> matrix;
  bool has_rotation = false, has_translation = false;
  int line_number = 0;
  for (const std::string_view line : SplitLines(*text)) {
    ++line_number;
    const auto fields = SplitFields(line, kBlanks);
    if (fields.empty() || (fields[0] != "R:" && fields[0] != "T:")) continue;
    const bool is_rotation = fields[0] == "R:";
    const std::size_t num_numbers = is_rotation ? 9 : 3;
    const std::string where = path + ": line " + std::to_string(line_number);
    if (fields.size() != num_numbers + 1) {
      *error = where + " has " + std::to_string(fields.size() - 1) +
               " numbers, must have " + std::to_string(num_numbers);
      return std::nullopt;
    }
    for (std::size_t i = 0; i < num_numbers; ++i) {
      const auto value = ParseFiniteNumber(fields[i + 1]);
      if (!value) {
        *error = where + " number " + std::to_string(i + 1) +
                 " is not a finite number";
        return std::nullopt;
      }
      const auto row = static_cast<Eigen::Index>(is_rotation ? i / 3 : i);
      matrix(row, is_rotation ? static_cast<Eigen::Index>(i % 3) : 3) = *value;
    }
    (is_rotation ? has_rotation : has_translation) = true;
  }
  if (!has_rotation || !has_translation) {
    *error = path + ": has no line " + (has_rotation ? "T:" : "R:");
    return std::nullopt;
  }
  auto velodyne_from_imu = NearestRigid3(matrix);
  if (!velodyne_from_imu) *error = path + ": R: is not a rotation";
  return velodyne_from_imu;
}

}  // namespace quatro
