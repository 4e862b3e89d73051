// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Reads and writes whole files. An error is one line, "<path>: <reason>".

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

// The bytes as text: without a byte order mark, and with LF at the end of each
// line in place of LF, CR LF or CR. Returns nullopt and sets *error if the
// bytes are a file of another kind (features/base/foreign_file.h). `name` is
// that of the file.
std::optional<std::string> AsText(std::string_view bytes,
                                  const std::string& name,
                                  std::string* error);

// Reads a whole file as text.
std::optional<std::string> ReadTextFile(const std::string& path,
                                        std::string* error);

// A temporary file next to `path`, named `path`.tmp.<process>.<number> and
// flushed to the disk. It is removed with this object unless it was renamed to
// `path`.
class PendingFile {
 public:
  // Returns nullptr and sets *error if the file cannot be written. If `path` is
  // a symbolic link, the file that it points to is meant.
  static std::unique_ptr<PendingFile> Write(const std::string& path,
                                            std::string_view bytes,
                                            std::string* error);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  // Renames the file to `path` and replaces a file of that name. Returns false
  // and sets *error if that fails.
  bool Rename(std::string* error);

 private:
  PendingFile() = default;

  std::string path_, temporary_;  // temporary_ is empty once renamed.
};

// Writes a PendingFile and renames it to `path`. So `path` has either its old
// content or all of the new one. On failure, removes the temporary file, sets
// *error and returns false.
bool WriteFileAtomically(const std::string& path,
                         std::string_view bytes,
                         std::string* error);

// Removes the temporary files that interrupted calls of WriteFileAtomically()
// left in `folder`. Call it only while nothing writes there.
void RemoveTemporaries(const std::string& folder);

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_FILE_H_
