// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Whole files in and out. An error is one line, "<path>: <reason>".

#ifndef QUATRO_FEATURES_BASE_FILE_H_
#define QUATRO_FEATURES_BASE_FILE_H_

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace quatro {

// Returns nullopt and sets *error unless `path` is a regular file that can be
// read to its end. An empty file is an empty string.
std::optional<std::string> ReadWholeFile(const std::string& path,
                                         std::string* error);

// `path`.tmp.<process>.<number>, flushed to the disk; removed with this object
// unless it was renamed to `path`.
class PendingFile {
 public:
  // Returns a nullptr and sets *error if it can't be written.
  static std::unique_ptr<PendingFile> Write(const std::string& path,
                                            std::string_view bytes,
                                            std::string* error);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  // Under its name, in place of a file that was there. Returns false and sets
  // *error if it cannot be.
  bool Rename(std::string* error);

 private:
  PendingFile() = default;

  std::string path_, temporary_;  // The latter empty: there is none.
};

// Writes a PendingFile and renames it to `path`, which thus holds its old
// content or all of the new one. On failure removes what it wrote, sets *error
// and returns false.
bool WriteFileAtomically(const std::string& path,
                         std::string_view bytes,
                         std::string* error);

// Removes what WriteFileAtomically() had in `folder` when it was killed. Only
// while nobody writes there.
void RemoveTemporaries(const std::string& folder);

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_FILE_H_
