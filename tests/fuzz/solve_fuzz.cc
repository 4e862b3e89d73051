// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// quatro_solve, whole: lines "--NAME=VALUE", then matches as text.

#include "tests/fuzz/whole_program.h"

namespace quatro {
namespace {

const std::vector<std::string> kNames = {"preset",
                                         "method",
                                         "recover",
                                         "polish",
                                         "ins_mode",
                                         "source_rpy_deg",
                                         "target_rpy_deg",
                                         "ins_std_deg",
                                         "gravity",
                                         "crosscheck",
                                         "noise_bound",
                                         "seed",
                                         "explain"};

// More would only be slower.
constexpr int kMaxLines = 24;

}  // namespace
}  // namespace quatro

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  static quatro::MemoryFile matches;
  static const quatro::ScratchFolder folder;
  const gflags::FlagSaver saver;
  std::string_view text = quatro::AsText(data, size);
  quatro::TakeFlags(quatro::kNames, &text);
  if (std::count(text.begin(), text.end(), '\n') > quatro::kMaxLines) return -1;
  const std::string json = folder.path() + "/answer.json";
  std::filesystem::remove(json);
  quatro::SetFlag("threads", "1");
  quatro::SetFlag("correspondences", matches.Hold(text));
  quatro::SetFlag("json", json);
  quatro::CheckReport(quatro::RunMain(), json);
  return 0;
}
