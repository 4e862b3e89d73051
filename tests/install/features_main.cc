// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A program of somebody else's that links one part of the library: a cloud is
// written and read again.
//   features_consumer [file.ply]

#include <quatro/features/io/cloud_io.h>
#include <quatro/version.h>

#include <iostream>
#include <string>

#include "features/io/point_cloud.h"

int main(int argc, char** argv) {
  const std::string path =
      argc > 1 ? argv[1] : std::string(argv[0]) + "_cloud.ply";
  quatro::PointCloud cloud;
  cloud.points.resize(3, 1000);
  for (int i = 0; i < 1000; ++i) {
    cloud.points.col(i) << i % 10 + 0.5, i / 10 % 10 + 0.5, i / 100 + 0.5;
  }
  std::string error;
  if (!quatro::WriteCloud(cloud, path, &error)) {
    std::cout << error << "\n";
    return 1;
  }
  const auto read = quatro::ReadCloud(path, &error);
  if (!read || read->points != cloud.points) {
    std::cout << path << ": " << (read ? "other points" : error) << "\n";
    return 1;
  }
  std::cout << "quatro " QUATRO_VERSION ": " << read->points.cols()
            << " points\n";
  return 0;
}
