// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/base/outputs.h"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <system_error>

#include "features/base/file.h"

namespace quatro {

namespace fs = std::filesystem;

namespace {

constexpr char kStandard[] = "-";

bool IsStandardOutput(const std::string& path) {
  return path.empty() || path == kStandard;
}

std::string StandardInput(std::string* error) {
  std::string bytes;
  char buffer[1 << 16];
  while (const std::size_t n = std::fread(buffer, 1, sizeof(buffer), stdin)) {
    bytes.append(buffer, n);
  }
  if (std::ferror(stdin)) *error = "standard input: could not be read";
  return bytes;
}

}  // namespace

bool CanWrite(const std::string& path, std::string* error) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    *error = path + ": is a directory, must be a file to write";
    return false;
  }
  // Renaming a file to this path would replace, for example, /dev/null.
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
    *error = path + ": is not a regular file; - is standard output";
    return false;
  }
  if (fs::exists(path, ignored) && access(path.c_str(), W_OK) != 0) {
    *error = path + ": is write-protected; name another file";
    return false;
  }
  const fs::path parent = fs::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored)) {
    *error = path + ": " + folder + " is a file, not a folder";
    return false;
  }
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

bool CanWriteAll(const std::vector<OutputFlag>& outputs,
                 const std::vector<std::string>& inputs,
                 std::string* error) {
  const auto full = [](const std::string& path) {
    std::error_code ignored;
    return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  };
  std::vector<std::string> taken = inputs;
  std::string on_standard_output;  // The flag.
  for (const auto& [name, output] : outputs) {
    if (output.empty()) continue;
    if (output == kStandard) {
      if (!on_standard_output.empty()) {
        *error = "--" + on_standard_output + " and --" + name +
                 " would both go to standard output; name a file for one of "
                 "them";
        return false;
      }
      on_standard_output = name;
      continue;
    }
    if (!CanWrite(output, error)) return false;
    for (const std::string& other : taken) {
      if (other == kStandard || full(output) != full(other)) continue;
      *error = output +
               ": is to be written, but is also an input or another "
               "output; name another file";
      return false;
    }
    taken.push_back(output);
  }
  return true;
}

bool HasEnding(const OutputFlag& output,
               const std::string& ending,
               std::string* error) {
  if (IsStandardOutput(output.path) || output.path.ends_with(ending)) {
    return true;
  }
  *error = "--" + output.name + "=" + output.path + ", must end with " +
           ending + ", the only format that it is written in";
  return false;
}

bool CanBeFolder(const OutputFlag& output, std::string* error) {
  if (output.path.empty()) {
    *error = "--" + output.name + " is empty, must name a folder";
  } else if (output.path == kStandard) {
    *error = "--" + output.name +
             "=-: a folder cannot go to standard output; ./- is one named -";
  } else {
    return true;
  }
  return false;
}

std::FILE* SummaryStream(const std::vector<std::string>& outputs) {
  const bool is_taken = std::ranges::find(outputs, kStandard) != outputs.end();
  return is_taken ? stderr : stdout;
}

std::optional<std::string> ReadInput(const std::string& path,
                                     std::string* error) {
  if (path != kStandard) return ReadTextFile(path, error);
  std::string problem;
  const std::string bytes = StandardInput(&problem);
  if (problem.empty()) return AsText(bytes, "standard input", error);
  *error = problem;
  return std::nullopt;
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
    if (IsStandardOutput(path)) continue;
    pending.push_back(PendingFile::Write(path, bytes, error));
    if (!pending.back()) return false;
  }
  // If the reader of a pipe has exited (| head), SIGPIPE would end the program
  // and leave temporary files.
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  for (const auto& [path, bytes] : files) {
    if (IsStandardOutput(path))
      std::fwrite(bytes.data(), 1, bytes.size(), stdout);
  }
  const bool has_arrived = FlushOutput(error);
  std::signal(SIGPIPE, before);
  if (!has_arrived) return false;
  for (const auto& file : pending) {
    if (!file->Rename(error)) return false;
  }
  return true;
}

}  // namespace quatro
