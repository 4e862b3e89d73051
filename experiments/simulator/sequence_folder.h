// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A folder that is written beside its place and renamed when it is complete;
// what is not finished is removed.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_SEQUENCE_FOLDER_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_SEQUENCE_FOLDER_H_

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace quatro {

class SequenceFolder {
 public:
  // Returns a nullptr and sets *error if the folder holds anything (with
  // `overwrite`: anything but a sequence, of any layout), or if it can't be
  // written.
  static std::unique_ptr<SequenceFolder> Create(const std::string& output_dir,
                                                bool overwrite,
                                                std::string* error);
  ~SequenceFolder();
  SequenceFolder(const SequenceFolder&) = delete;
  SequenceFolder& operator=(const SequenceFolder&) = delete;

  // Where to write until then.
  const std::filesystem::path& path() const { return folder_; }

  bool Finish(std::string* error);

 private:
  SequenceFolder() = default;

  std::filesystem::path output_, folder_;
  std::vector<std::filesystem::path> made_;  // folder_ and new parents of it.
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_SEQUENCE_FOLDER_H_
