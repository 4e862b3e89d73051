// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What holds of a cloud, whatever file it was read from.

#ifndef QUATRO_TESTS_FUZZ_CLOUD_CHECKS_H_
#define QUATRO_TESTS_FUZZ_CLOUD_CHECKS_H_

#include <glog/logging.h>

#include <optional>
#include <string>

#include "features/io/point_cloud.h"
#include "tests/fuzz/fuzz.h"

namespace quatro {

inline void CheckCloud(const std::optional<PointCloud>& cloud,
                       const std::string& error) {
  if (!cloud) {
    CheckIsOneLine(error);
    return;
  }
  CHECK_GT(cloud->points.cols(), 0);
  CHECK(cloud->points.allFinite());
  CHECK_GE(cloud->num_dropped, 0);
  if (cloud->intensity.size() != 0) {
    CHECK_EQ(cloud->intensity.size(), cloud->points.cols());
  }
}

}  // namespace quatro

#endif  // QUATRO_TESTS_FUZZ_CLOUD_CHECKS_H_
