// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/naver_layout.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "experiments/simulator/sequence_folder.h"
#include "features/base/file.h"
#include "features/io/cloud_io.h"

namespace quatro {
namespace {

namespace fs = std::filesystem;

constexpr char kVersion[] = "# kapture format: 1.1\n";

std::string FormatNumber(double value) {
  char number[40];
  std::snprintf(number, sizeof(number), ", %.17g", value);
  return number;
}

class NaverWriter final : public SequenceWriter {
 public:
  explicit NaverWriter(std::unique_ptr<SequenceFolder> folder)
      : folder_(std::move(folder)) {}

  bool Add(const PointCloud& cloud,
           const Rigid3& world_from_sensor,
           double time,
           const InsReading* reading,
           std::string* error) override;
  bool Finish(std::string* error) override;

 private:
  std::unique_ptr<SequenceFolder> folder_;
  int num_frames_ = 0;
  std::string records_, poses_, ins_;
};

bool NaverWriter::Add(const PointCloud& cloud,
                      const Rigid3& world_from_sensor,
                      double time,
                      const InsReading* reading,
                      std::string* error) {
  char name[32];
  std::snprintf(name, sizeof(name), "lidar0/%06d.pcd", num_frames_);
  const fs::path path = folder_->path() / "sensors" / "records_data" / name;
  if (!WriteCloud(cloud, path.string(), error)) return false;
  const std::string stamp = std::to_string(std::llround(time * 1e6));
  records_ += stamp + ", lidar0, " + name + "\n";

  const Rigid3 sensor_from_world = Inverse(world_from_sensor);
  const Eigen::Quaterniond q(sensor_from_world.rotation);
  poses_ += stamp + ", lidar0" + FormatNumber(q.w()) + FormatNumber(q.x()) +
            FormatNumber(q.y()) + FormatNumber(q.z());
  for (const double t : sensor_from_world.translation) {
    poses_ += FormatNumber(t);
  }
  poses_ += "\n";
  if (reading != nullptr) {
    ins_ += stamp + ", ins0" + FormatNumber(reading->attitude.roll) +
            FormatNumber(reading->attitude.pitch) +
            FormatNumber(reading->attitude.yaw) + "\n";
  }
  ++num_frames_;
  return true;
}

bool NaverWriter::Finish(std::string* error) {
  const fs::path folder = folder_->path() / "sensors";
  const auto write =
      [&](const char* name, const char* columns, const std::string& lines) {
        return WriteFileAtomically(
            (folder / name).string(),
            std::string(kVersion) + "# " + columns + "\n" + lines,
            error);
      };
  const std::string of_ins = ins_.empty() ? "" : "ins0, , ins\n";
  return write("sensors.txt",
               "sensor_device_id, name, sensor_type, [sensor_params]+",
               "lidar0, , lidar\n" + of_ins) &&
         write("records_lidar.txt",
               "timestamp, device_id, point_cloud_path",
               records_) &&
         write("trajectories.txt",
               "timestamp, device_id, qw, qx, qy, qz, tx, ty, tz",
               poses_) &&
         (ins_.empty() || write("records_ins.txt",
                                "timestamp, device_id, roll, pitch, yaw",
                                ins_)) &&
         folder_->Finish(error);
}

}  // namespace

std::unique_ptr<SequenceWriter> MakeNaverWriter(const std::string& output_dir,
                                                bool overwrite,
                                                std::string* error) {
  auto folder =
      SequenceFolder::Create(output_dir,
                             fs::path("sensors") / "records_data" / "lidar0",
                             overwrite,
                             error);
  if (folder == nullptr) return nullptr;
  return std::make_unique<NaverWriter>(std::move(folder));
}

}  // namespace quatro
