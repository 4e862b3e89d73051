// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A PCD of any kind, and the same points written as a binary one.

#include "features/io/pcd.h"

#include "tests/fuzz/cloud_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  std::string error;
  const auto cloud = quatro::ParsePcd(quatro::AsText(data, size), &error);
  quatro::CheckCloud(cloud, error);
  if (!cloud) return 0;
  const std::string bytes = quatro::FormatPcd(*cloud);
  // Points that float32 rounds to the origin are dropped.
  const quatro::Points rounded = cloud->points.cast<float>().cast<double>();
  if ((rounded.array() == 0.0).colwise().all().any()) return 0;
  const auto again = quatro::ParsePcd(bytes, &error);
  CHECK(again) << error;
  CHECK_EQ(again->num_dropped, 0);
  CHECK(again->points == cloud->points || again->points == rounded);
  return 0;
}
