// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A folder that is written beside its final place and renamed when it is
// complete. An incomplete folder is removed.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_SEQUENCE_FOLDER_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_SEQUENCE_FOLDER_H_

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace quatro {

class SequenceFolder {
 public:
  // Makes the folder, and in it the folder `scans`. Returns nullptr and sets
  // *error if the folder is not empty (with `overwrite`: contains anything but
  // a sequence, in any layout), or if it cannot be written.
  static std::unique_ptr<SequenceFolder> Create(
      const std::string& output_dir,
      const std::filesystem::path& scans,
      bool overwrite,
      std::string* error);
  ~SequenceFolder();
  SequenceFolder(const SequenceFolder&) = delete;
  SequenceFolder& operator=(const SequenceFolder&) = delete;

  // The temporary place of the folder.
  const std::filesystem::path& path() const { return folder_; }

  bool Finish(std::string* error);

 private:
  SequenceFolder() = default;

  std::filesystem::path output_, folder_;
  std::vector<std::filesystem::path> made_;  // folder_ and its new parents.
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_SEQUENCE_FOLDER_H_
