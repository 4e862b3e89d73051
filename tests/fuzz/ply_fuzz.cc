// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A PLY, and the same points written as one.

#include "features/io/ply.h"

#include "tests/fuzz/cloud_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  std::string error;
  const auto cloud = quatro::ParsePly(quatro::AsText(data, size), &error);
  quatro::CheckCloud(cloud, error);
  if (!cloud) return 0;
  const auto again = quatro::ParsePly(quatro::FormatPly(*cloud), &error);
  CHECK(again) << error;
  CHECK_EQ(again->num_dropped, 0);
  CHECK(again->points == cloud->points);
  return 0;
}
