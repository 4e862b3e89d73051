// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// quatro_register, whole: lines "--NAME=VALUE", then both clouds as bytes, as
// long as each other: three signed bytes a point, in half metres. A line
// "--raw=1" makes them KITTI .bin as they are.

#include <cstring>

#include "tests/fuzz/whole_program.h"

namespace quatro {
namespace {

const std::vector<std::string> kNames = {"preset",
                                         "method",
                                         "recover",
                                         "polish",
                                         "refine",
                                         "ins_mode",
                                         "source_rpy_deg",
                                         "target_rpy_deg",
                                         "gravity",
                                         "voxel_size",
                                         "normal_radius",
                                         "fpfh_radius",
                                         "noise_bound",
                                         "seed"};

bool TakeRaw(std::string_view* text) {
  constexpr std::string_view kRaw = "--raw=1\n";
  if (!text->starts_with(kRaw)) return false;
  text->remove_prefix(kRaw.size());
  return true;
}

std::string AsBin(std::string_view bytes) {
  std::string bin;
  for (std::size_t i = 0; i + 3 <= bytes.size(); i += 3) {
    for (std::size_t axis = 0; axis < 4; ++axis) {
      const float value =
          axis < 3 ? 0.5f * static_cast<signed char>(bytes[i + axis]) : 0.0f;
      char four[sizeof(value)];
      std::memcpy(four, &value, sizeof(value));
      bin.append(four, sizeof(four));
    }
  }
  return bin;
}

// A search of usual size takes half a minute when sanitized, and preset auto
// would make three. Methods without a search know no such options.
void LimitSearch() {
  std::string method, preset;
  gflags::GetCommandLineOption("method", &method);
  gflags::GetCommandLineOption("preset", &preset);
  if (method == "auto" ||
      (method.starts_with("quatro") && method != "quatro_single")) {
    SetFlag("options",
            preset == "auto" ? "max_rung=0"
                             : "max_num_proposals=2;num_aligned=1;max_rung=1");
  }
}

}  // namespace
}  // namespace quatro

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  static const quatro::ScratchFolder folder;
  const gflags::FlagSaver saver;
  std::string_view bytes = quatro::AsText(data, size);
  const bool is_raw = quatro::TakeRaw(&bytes);
  quatro::TakeFlags(quatro::kNames, &bytes);
  for (const bool is_source : {true, false}) {
    const std::string_view half = is_source ? bytes.substr(0, bytes.size() / 2)
                                            : bytes.substr(bytes.size() / 2);
    quatro::SetFlag(is_source ? "source" : "target",
                    folder.Write(is_source ? "source.bin" : "target.bin",
                                 is_raw ? half : quatro::AsBin(half)));
  }
  quatro::LimitSearch();
  const std::string json = folder.path() + "/answer.json";
  std::filesystem::remove(json);
  quatro::SetFlag("threads", "1");
  quatro::SetFlag("json", json);
  quatro::CheckReport(quatro::RunMain(), json);
  return 0;
}
