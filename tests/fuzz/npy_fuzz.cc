// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A .npy array.

#include "features/io/npy.h"

#include "tests/fuzz/cloud_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  std::string error;
  const auto cloud = quatro::ParseNpy(quatro::AsText(data, size), &error);
  quatro::CheckCloud(cloud, error);
  return 0;
}
