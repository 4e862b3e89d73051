// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Points as text, .xyz, .txt or .csv.

#include "features/io/point_text.h"

#include "tests/fuzz/cloud_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  std::string error;
  const auto cloud = quatro::ParsePointText(quatro::AsText(data, size), &error);
  quatro::CheckCloud(cloud, error);
  return 0;
}
