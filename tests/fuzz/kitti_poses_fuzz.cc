// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Poses of KITTI, written again, and its calibration.

#include "experiments/datasets/kitti_poses.h"

#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  static quatro::MemoryFile file;
  const std::string path = file.Hold(quatro::AsText(data, size));
  std::string error;
  const auto calibration = quatro::ReadKittiCalibration(path, &error);
  if (calibration) {
    CHECK(calibration->ToMatrix().allFinite());
  } else {
    quatro::CheckIsOneLine(error);
  }
  const auto poses = quatro::ReadKittiPoses(path, &error);
  if (!poses) {
    quatro::CheckIsOneLine(error);
    return 0;
  }
  for (const quatro::Rigid3& pose : *poses) {
    CHECK(pose.ToMatrix().allFinite());
    CHECK_NEAR(pose.rotation.determinant(), 1.0, 1e-9);
  }
  const auto again = quatro::ReadKittiPoses(
      file.Hold(quatro::FormatKittiPoses(*poses)), &error);
  CHECK(again) << error;
  CHECK_EQ(again->size(), poses->size());
  return 0;
}
