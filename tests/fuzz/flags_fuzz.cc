// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// All flags of quatro_experiment that it looks at before its data, which is not
// there: lines "--NAME=VALUE".

#include "tests/fuzz/whole_program.h"

namespace quatro {
namespace {

const std::vector<std::string> kNames = {"methods",
                                         "sequences",
                                         "preset",
                                         "ins_mode",
                                         "bins",
                                         "min_frame_gap",
                                         "min_path",
                                         "min_pair_spacing",
                                         "intervals",
                                         "yaw_step_deg",
                                         "max_pairs",
                                         "max_pairs_per_source",
                                         "max_frames",
                                         "seed",
                                         "shard",
                                         "merge",
                                         "threads"};

}  // namespace
}  // namespace quatro

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  static const quatro::ScratchFolder folder;
  const std::string output = folder.path() + "/run";
  for (const char* protocol :
       {"loop", "interval", "yaw", "timing", "pairs", "odometry", "tilt"}) {
    const gflags::FlagSaver saver;
    std::string_view text = quatro::AsText(data, size);
    quatro::SetFlag("protocol", protocol);
    quatro::SetFlag("data", folder.path() + "/nowhere");
    quatro::SetFlag("output", output);
    quatro::TakeFlags(quatro::kNames, &text);
    CHECK_EQ(quatro::RunMain(), 2) << protocol;
    CHECK(!std::filesystem::exists(output)) << protocol;
  }
  return 0;
}
