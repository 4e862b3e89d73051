// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A pose graph, and the same one written again.

#include "experiments/pose_graphs/g2o.h"

#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  static quatro::MemoryFile file;
  std::string error;
  const auto graph =
      quatro::ReadG2o(file.Hold(quatro::AsText(data, size)), &error);
  if (!graph) {
    quatro::CheckIsOneLine(error);
    return 0;
  }
  CHECK(!graph->world_from_pose.empty());
  const auto again =
      quatro::ReadG2o(file.Hold(quatro::FormatG2o(*graph)), &error);
  CHECK(again) << error;
  CHECK_EQ(again->world_from_pose.size(), graph->world_from_pose.size());
  CHECK_EQ(again->edges.size(), graph->edges.size());
  return 0;
}
