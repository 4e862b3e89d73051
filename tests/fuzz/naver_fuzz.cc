// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A sequence of NAVER LABS, in the text of its files: "== trajectories.txt",
// ... (SplitFiles).

#include "experiments/datasets/naver.h"

#include "tests/fuzz/fuzz.h"

namespace quatro {
namespace {

const std::vector<std::string> kNames = {
    "records_lidar.txt", "trajectories.txt", "rigs.txt", "records_ins.txt"};

// FOLDER/sensors of the files that are there.
void WriteSensors(std::string_view text, const std::string& folder) {
  std::filesystem::create_directories(folder + "/sensors");
  const auto files = SplitFiles(text, kNames);
  for (const std::string& name : kNames) {
    const std::string path = folder + "/sensors/" + name;
    const auto file = files.find(name);
    if (file == files.end()) {
      std::filesystem::remove(path);
    } else {
      std::ofstream(path, std::ios::binary) << file->second;
    }
  }
}

}  // namespace
}  // namespace quatro

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  static const quatro::ScratchFolder folder;
  quatro::WriteSensors(quatro::AsText(data, size), folder.path());
  quatro::NaverOptions options;
  options.folder = folder.path();
  std::string error;
  const auto sequence = quatro::ReadNaver(options, &error);
  if (!sequence) {
    quatro::CheckIsOneLine(error);
    return 0;
  }
  for (const auto& [frame, pose] : sequence->world_from_sensor) {
    CHECK(pose.ToMatrix().allFinite()) << frame;
  }
  for (const std::string& note : sequence->notes) quatro::CheckIsOneLine(note);
  return 0;
}
