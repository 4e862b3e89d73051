// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/datasets/naver.h"

#include <Eigen/Geometry>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "experiments/base/number_text.h"
#include "features/base/cloud_text.h"
#include "features/base/file.h"

namespace quatro {
namespace {

namespace fs = std::filesystem;

struct Row {
  std::string where;  // File and line.
  std::vector<std::string> values;
};

std::optional<std::vector<Row>> ReadRows(const fs::path& path,
                                         std::size_t num_values,
                                         std::string* error) {
  const auto text = ReadTextFile(path.string(), error);
  if (!text) return std::nullopt;
  std::vector<Row> rows;
  int line_number = 0;
  for (std::string_view line : SplitLines(*text)) {
    ++line_number;
    line = Trim(line);
    if (line.empty() || line.starts_with('#')) continue;
    Row row;
    row.where = path.string() + ": line " + std::to_string(line_number);
    for (std::size_t end = 0; end != std::string_view::npos;) {
      end = line.find(',');
      row.values.emplace_back(Trim(line.substr(0, end)));
      if (end != std::string_view::npos) line.remove_prefix(end + 1);
    }
    if (row.values.size() != num_values) {
      *error = row.where + " has " + std::to_string(row.values.size()) +
               " values, must have " + std::to_string(num_values);
      return std::nullopt;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::optional<std::int64_t> ParseStamp(const Row& row, std::string* error) {
  const std::string& text = row.values[0];
  std::int64_t stamp = 0;
  const auto parsed =
      std::from_chars(text.data(), text.data() + text.size(), stamp);
  if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size()) {
    *error = row.where + ": " + Quoted(text) + " is not an integer";
    return std::nullopt;
  }
  return stamp;
}

// Parses all values from the third on.
std::optional<std::vector<double>> ParseNumbers(const Row& row,
                                                std::string* error) {
  std::vector<double> numbers;
  for (std::size_t i = 2; i < row.values.size(); ++i) {
    const auto number = ParseFiniteNumber(row.values[i]);
    if (!number) {
      *error = row.where + " value " + std::to_string(i + 1) +
               " is not a finite number";
      return std::nullopt;
    }
    numbers.push_back(*number);
  }
  return numbers;
}

std::optional<Rigid3> ParsePose(const Row& row, std::string* error) {
  constexpr double kMaxDeviation = 1e-3;  // Deviation from unit length.
  const auto n = ParseNumbers(row, error);
  if (!n) return std::nullopt;
  const Eigen::Quaterniond q((*n)[0], (*n)[1], (*n)[2], (*n)[3]);
  if (!(std::abs(q.norm() - 1.0) <= kMaxDeviation)) {
    *error = row.where + ": the quaternion is not of length 1";
    return std::nullopt;
  }
  return Rigid3{q.normalized().toRotationMatrix(), {(*n)[4], (*n)[5], (*n)[6]}};
}

using Stamped = std::pair<std::int64_t, std::string>;

// Finds poses by equation (1), from the trajectories and the rigs.
class Trajectories {
 public:
  bool Read(const fs::path& sensors, std::string* error) {
    const auto rows = ReadRows(sensors / "trajectories.txt", 9, error);
    if (!rows) return false;
    for (const Row& row : *rows) {
      const auto stamp = ParseStamp(row, error);
      const auto pose = stamp ? ParsePose(row, error) : std::nullopt;
      if (!pose) return false;
      if (!poses_.emplace(Stamped(*stamp, row.values[1]), *pose).second) {
        *error = row.where + " has a pose that was there before";
        return false;
      }
    }
    std::error_code ignored;
    if (!fs::exists(sensors / "rigs.txt", ignored)) return true;
    const auto rigs = ReadRows(sensors / "rigs.txt", 9, error);
    if (!rigs) return false;
    for (const Row& row : *rigs) {
      const auto pose = ParsePose(row, error);
      if (!pose) return false;
      if (!rig_of_.emplace(row.values[1], std::pair(row.values[0], *pose))
               .second) {
        *error = row.where + " has a device that is in a rig already";
        return false;
      }
    }
    return true;
  }

  // device_from_world
  std::optional<Rigid3> Find(std::int64_t stamp,
                             const std::string& device) const {
    constexpr int kMaxDepth = 4;  // Nested rigs; also ends a cycle.
    Rigid3 sensor_from_device;
    std::string name = device;
    for (int depth = 0; depth < kMaxDepth; ++depth) {
      const auto pose = poses_.find({stamp, name});
      if (pose != poses_.end()) return sensor_from_device * pose->second;
      const auto rig = rig_of_.find(name);
      if (rig == rig_of_.end()) break;
      sensor_from_device = sensor_from_device * rig->second.second;
      name = rig->second.first;
    }
    return std::nullopt;
  }

 private:
  std::map<Stamped, Rigid3> poses_;
  std::map<std::string, std::pair<std::string, Rigid3>> rig_of_;
};

// Stamp -> path of the scans of the requested lidar, or of the first lidar by
// name if `lidar` is empty.
std::optional<std::map<std::int64_t, std::string>> ReadRecords(
    const fs::path& sensors,
    std::string lidar,
    SequenceData* data,
    std::string* lidar_read,
    std::string* error) {
  const fs::path file = sensors / "records_lidar.txt";
  const auto rows = ReadRows(file, 3, error);
  if (!rows) return std::nullopt;
  std::set<std::string> lidars;
  for (const Row& row : *rows) lidars.insert(row.values[1]);
  if (lidar.empty() && !lidars.empty()) {
    lidar = *lidars.begin();
    if (lidars.size() > 1) {
      data->notes.push_back(data->name + ": of " +
                            std::to_string(lidars.size()) + " lidars " +
                            Quoted(lidar));
    }
  }
  std::map<std::int64_t, std::string> scans;
  for (const Row& row : *rows) {
    const auto stamp = ParseStamp(row, error);
    if (!stamp) return std::nullopt;
    if (row.values[1] != lidar) continue;
    const fs::path path = sensors / "records_data" / row.values[2];
    if (!scans.emplace(*stamp, path.string()).second) {
      *error = row.where + " has a record that was there before";
      return std::nullopt;
    }
  }
  if (scans.empty()) {
    *error = file.string() + ": has no records of a lidar" +
             (lidar.empty() ? "" : " " + Quoted(lidar));
    return std::nullopt;
  }
  *lidar_read = lidar;
  return scans;
}

bool ReadIns(const fs::path& file,
             const std::map<std::int64_t, int>& frames,
             SequenceData* data,
             std::string* error) {
  const auto rows = ReadRows(file, 5, error);
  if (!rows) return false;
  for (const Row& row : *rows) {
    const auto stamp = ParseStamp(row, error);
    const auto angles = stamp ? ParseNumbers(row, error) : std::nullopt;
    if (!angles) return false;
    const auto frame = frames.find(*stamp);
    if (frame == frames.end()) continue;
    data->ins[frame->second] = {(*angles)[0], (*angles)[1], (*angles)[2]};
  }
  data->notes.push_back(data->name + ": INS from " + file.string());
  return true;
}

std::string NameOf(fs::path folder) {
  const std::set<std::string> parts = {
      "mapping", "mapping_lidar_only", "validation", "test", "release", ""};
  folder = fs::absolute(folder).lexically_normal();
  while (folder.has_relative_path() &&
         parts.contains(folder.filename().string())) {
    folder = folder.parent_path();
  }
  return folder.filename().string();
}

}  // namespace

bool NaverOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (folder.empty()) {
    problem << "folder is empty, must name one";
  } else if (!(ins_std > 0.0 && ins_std <= 0.2)) {
    problem << "ins_std = " << ins_std << ", must be in (0, 0.2]";
  }
  *error = problem.str();
  return error->empty();
}

std::optional<SequenceData> ReadNaver(const NaverOptions& options,
                                      std::string* error) {
  if (!options.IsValid(error)) return std::nullopt;
  fs::path sensors;
  for (const char* below :
       {"sensors", "mapping/sensors", "release/mapping/sensors"}) {
    std::error_code ignored;
    if (sensors.empty() &&
        fs::is_directory(fs::path(options.folder) / below, ignored)) {
      sensors = fs::path(options.folder) / below;
    }
  }
  if (sensors.empty()) {
    *error = options.folder +
             ": holds none of sensors, mapping/sensors and "
             "release/mapping/sensors";
    return std::nullopt;
  }
  SequenceData data;
  data.name = options.name.empty() ? NameOf(options.folder) : options.name;
  data.ins_std = options.ins_std;
  std::string lidar;
  const auto scans = ReadRecords(sensors, options.lidar, &data, &lidar, error);
  if (!scans) return std::nullopt;
  Trajectories trajectories;
  if (!trajectories.Read(sensors, error)) return std::nullopt;

  std::map<std::int64_t, int> frames;
  for (const auto& [stamp, path] : *scans) {
    const auto frame = static_cast<int>(frames.size());
    frames[stamp] = frame;
    data.scans[frame] = path;
    if (const auto lidar_from_world = trajectories.Find(stamp, lidar)) {
      data.world_from_sensor[frame] = Inverse(*lidar_from_world);
    }
  }
  CountMissing([](int) { return std::string(); }, &data);
  std::error_code ignored;
  const fs::path ins = sensors / "records_ins.txt";
  if (fs::exists(ins, ignored) && !ReadIns(ins, frames, &data, error)) {
    return std::nullopt;
  }
  return data;
}

}  // namespace quatro
