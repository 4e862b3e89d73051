// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/kitti_layout.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <system_error>
#include <utility>

#include "experiments/simulator/sequence_folder.h"
#include "features/base/degree.h"
#include "features/base/file.h"
#include "features/io/cloud_io.h"

namespace quatro {
namespace {

namespace fs = std::filesystem;

// Formats a 3x4 matrix row by row, as in KITTI, with enough digits to recover
// it.
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

// Rectified pinhole cameras [px] in a row, 0 and 1 gray, 2 and 3 color, and the
// sensor in cam0.
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

class KittiWriter final : public SequenceWriter {
 public:
  explicit KittiWriter(std::unique_ptr<SequenceFolder> folder)
      : folder_(std::move(folder)) {}

  bool Add(const PointCloud& cloud,
           const Rigid3& world_from_sensor,
           double time,
           const InsReading* reading,
           std::string* error) override;
  bool Finish(std::string* error) override;

 private:
  std::unique_ptr<SequenceFolder> folder_;
  Rigid3 first_from_world_;
  int num_frames_ = 0;
  std::string poses_, times_;
};

bool KittiWriter::Add(const PointCloud& cloud,
                      const Rigid3& world_from_sensor,
                      double time,
                      const InsReading* reading,
                      std::string* error) {
  char name[32];
  std::snprintf(name, sizeof(name), "%06d.bin", num_frames_);
  const fs::path& folder = folder_->path();
  if (!WriteCloud(cloud, folder / "velodyne" / name, error)) return false;
  if (reading != nullptr) {
    std::error_code code;
    fs::create_directories(folder / "oxts" / "data", code);
    std::snprintf(name, sizeof(name), "%010d.txt", num_frames_);
    if (!WriteFileAtomically((folder / "oxts" / "data" / name).string(),
                             FormatOxts(*reading),
                             error)) {
      return false;
    }
  }
  if (num_frames_ == 0) first_from_world_ = Inverse(world_from_sensor);
  const Rigid3 cam0_from_sensor = Cam0FromSensor();
  poses_ += FormatRigid3(cam0_from_sensor * first_from_world_ *
                         world_from_sensor * Inverse(cam0_from_sensor));
  char stamp[32];
  std::snprintf(stamp, sizeof(stamp), "%e\n", time);
  times_ += stamp;
  ++num_frames_;
  return true;
}

bool KittiWriter::Finish(std::string* error) {
  const fs::path& folder = folder_->path();
  return WriteFileAtomically((folder / "poses.txt").string(), poses_, error) &&
         WriteFileAtomically(
             (folder / "calib.txt").string(), FormatCalibration(), error) &&
         WriteFileAtomically((folder / "times.txt").string(), times_, error) &&
         folder_->Finish(error);
}

}  // namespace

std::string FormatOxts(const InsReading& reading) {
  constexpr double kEarth = 6378137.0;  // Radius [m].
  constexpr double kLatitude = 49.0;    // Latitude of the origin [deg].
  constexpr double kLongitude = 8.4;    // Longitude of the origin [deg].
  constexpr double kGravity = 9.81;     // [m/s^2]
  const double scale = std::cos(kLatitude * kDegree);
  const double north = std::log(std::tan((90.0 + kLatitude) * kDegree / 2.0)) +
                       reading.position.y() / (scale * kEarth);
  const double latitude = 2.0 * std::atan(std::exp(north)) / kDegree - 90.0;
  const double longitude =
      kLongitude + reading.position.x() / (scale * kEarth) / kDegree;

  const Eigen::Matrix3d body_from_world =
      WorldFromBody(reading.attitude).transpose();
  const Eigen::Matrix3d level_from_world =
      RotationZ(-reading.attitude.yaw);  // Forward, left, up.
  const Eigen::Matrix3d level_from_body =
      LevelFromBody(reading.attitude.roll, reading.attitude.pitch);
  const Eigen::Vector3d felt =
      reading.acceleration + Eigen::Vector3d(0.0, 0.0, kGravity);

  std::string line;
  const auto add = [&](std::initializer_list<double> values) {
    for (const double value : values) {
      char number[32];
      std::snprintf(
          number, sizeof(number), "%s%.12g", line.empty() ? "" : " ", value);
      line += number;
    }
  };
  const auto add_vector = [&](const Eigen::Vector3d& vector) {
    add({vector.x(), vector.y(), vector.z()});
  };
  add({latitude, longitude, reading.position.z()});
  add({reading.attitude.roll, reading.attitude.pitch, reading.attitude.yaw});
  add({reading.velocity.y(), reading.velocity.x()});
  add_vector(level_from_world * reading.velocity);
  add_vector(body_from_world * felt);
  add_vector(level_from_world * felt);
  add_vector(reading.turn_rate);
  add_vector(level_from_body * reading.turn_rate);
  add({0.1, 0.02});       // Accuracies [m], [m/s].
  add({4, 10, 4, 4, 4});  // States; the second is the number of satellites.
  return line + "\n";
}

// Rotated by about half a degree, because no real camera is perfectly aligned.
Rigid3 Cam0FromSensor() {
  Eigen::Matrix3d axes;
  axes << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  const Eigen::Vector3d askew(0.004, -0.007, 0.003);  // [rad]
  return {
      Eigen::AngleAxisd(askew.norm(), askew.normalized()).toRotationMatrix() *
          axes,
      Eigen::Vector3d(0.0, -0.08, -0.27)};
}

std::unique_ptr<SequenceWriter> MakeKittiWriter(const std::string& output_dir,
                                                bool overwrite,
                                                std::string* error) {
  auto folder =
      SequenceFolder::Create(output_dir, "velodyne", overwrite, error);
  if (folder == nullptr) return nullptr;
  return std::make_unique<KittiWriter>(std::move(folder));
}

}  // namespace quatro
