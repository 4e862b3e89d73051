// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/base/outputs.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <system_error>

#include "features/base/file.h"

namespace quatro {

namespace fs = std::filesystem;

bool CanWrite(const std::string& path, std::string* error) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    *error = path + ": is a directory, must be a file to write";
    return false;
  }
  // It would be replaced: renaming onto /dev/null leaves a machine without it.
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
    *error = path + ": is not a regular file";
    return false;
  }
  const fs::path parent = fs::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  if (!fs::is_directory(folder, ignored)) {
    *error = path + ": there is no folder " + folder;
    return false;
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    *error = path + ": may not write into folder " + folder;
    return false;
  }
  return true;
}

bool CanWriteAll(const std::vector<std::string>& outputs,
                 const std::vector<std::string>& inputs,
                 std::string* error) {
  const auto full = [](const std::string& path) {
    std::error_code ignored;
    return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  };
  std::vector<std::string> taken = inputs;
  for (const std::string& output : outputs) {
    if (output.empty()) continue;
    if (!CanWrite(output, error)) return false;
    for (const std::string& other : taken) {
      if (full(output) != full(other)) continue;
      *error = output +
               ": is to be written, but is also an input or another "
               "output";
      return false;
    }
    taken.push_back(output);
  }
  return true;
}

std::vector<fs::path> MakeFolders(const fs::path& folder,
                                  std::error_code* error) {
  std::error_code ignored;
  std::vector<fs::path> made;
  for (fs::path part = folder; !part.empty() && !fs::exists(part, ignored);
       part = part.parent_path()) {
    made.push_back(part);
  }
  fs::create_directories(folder, *error);
  if (!*error) return made;
  for (const fs::path& part : made) fs::remove(part, ignored);
  return {};
}

bool FlushOutput(std::string* error) {
  std::cout.flush();
  if (std::fflush(stdout) == 0 && !std::ferror(stdout) && std::cout) {
    return true;
  }
  *error = "standard output: could not be written";
  return false;
}

bool WriteOutputs(const std::vector<OutputFile>& files, std::string* error) {
  std::vector<std::unique_ptr<PendingFile>> pending;
  for (const auto& [path, bytes] : files) {
    if (path.empty()) continue;
    pending.push_back(PendingFile::Write(path, bytes, error));
    if (!pending.back()) return false;
  }
  for (const auto& [path, bytes] : files) {
    if (path.empty()) std::fwrite(bytes.data(), 1, bytes.size(), stdout);
  }
  if (!FlushOutput(error)) return false;
  for (const auto& file : pending) {
    if (!file->Rename(error)) return false;
  }
  return true;
}

}  // namespace quatro
