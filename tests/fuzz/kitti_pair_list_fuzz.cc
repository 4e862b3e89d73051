// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Published lists of pairs, without the scans.

#include "experiments/datasets/kitti_pair_list.h"

#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  static quatro::MemoryFile file;
  quatro::KittiPairListOptions options;
  options.list = file.Hold(quatro::AsText(data, size));
  std::string error;
  const auto pairs = quatro::ReadKittiPairList(options, &error);
  if (!pairs) {
    quatro::CheckIsOneLine(error);
    return 0;
  }
  for (const quatro::PairTask& task : pairs->tasks) {
    CHECK(task.true_target_from_source);
    CHECK(task.true_target_from_source->ToMatrix().allFinite());
  }
  return 0;
}
