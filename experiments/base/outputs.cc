// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/base/outputs.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string_view>
#include <system_error>

#include "features/base/file.h"

namespace quatro {

namespace fs = std::filesystem;

namespace {

constexpr char kStandard[] = "-";

// The number of an open file that the path names: 1 for /dev/stdout. The file
// itself may be behind further links.
std::optional<int> DescriptorOf(const std::string& path) {
  if (path == "/dev/stdin") return STDIN_FILENO;
  if (path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!path.starts_with(folder)) continue;
    int fd = -1;
    const char* const end = path.data() + path.size();
    const auto parsed = std::from_chars(path.data() + folder.size(), end, fd);
    if (parsed.ec == std::errc() && parsed.ptr == end && fd >= 0) return fd;
  }
  return std::nullopt;
}

// Follows symbolic links, also to a missing file, as far as to an open file
// (DescriptorOf). Returns nullopt if there are more than 40, as Linux does.
std::optional<std::string> FollowLinks(std::string path) {
  constexpr int kMaxLinks = 40;
  std::error_code ignored;
  for (int i = 0; i <= kMaxLinks; ++i) {
    if (DescriptorOf(path) || !fs::is_symlink(path, ignored)) return path;
    // An absolute target replaces the folder.
    path = (fs::path(path).parent_path() / fs::read_symlink(path, ignored))
               .string();
  }
  return std::nullopt;
}

std::optional<int> OpenFileOf(const std::string& path) {
  const auto followed = FollowLinks(path);
  return followed ? DescriptorOf(*followed) : std::nullopt;
}

// Whether the path is not empty and names standard output.
bool NamesStandardOutput(const std::string& path) {
  return path == kStandard || OpenFileOf(path) == STDOUT_FILENO;
}

bool IsStandardOutput(const std::string& path) {
  return path.empty() || NamesStandardOutput(path);
}

// Whether bytes are written to the path itself: renaming a file to it would
// replace, for example, /dev/null or the file behind /dev/stderr.
bool IsDevice(const std::string& path) {
  std::error_code ignored;
  return OpenFileOf(path) || fs::is_character_file(path, ignored);
}

bool WriteToDevice(const std::string& path,
                   const std::string& bytes,
                   std::string* error) {
  const auto fd = OpenFileOf(path);
  std::FILE* const device =
      fd ? fdopen(dup(*fd), "w") : std::fopen(path.c_str(), "w");
  const bool is_written =
      device &&
      std::fwrite(bytes.data(), 1, bytes.size(), device) == bytes.size();
  const bool is_closed = device && std::fclose(device) == 0;
  if (!is_written || !is_closed) *error = path + ": could not be written";
  return is_written && is_closed;
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

// Writes a PendingFile with the permissions of the file that it replaces.
std::unique_ptr<PendingFile> WritePending(const std::string& path,
                                          const std::string& bytes,
                                          std::string* error) {
  const std::string followed = FollowLinks(path).value_or(path);
  struct stat old = {};
  if (stat(followed.c_str(), &old) != 0) {
    return PendingFile::Write(followed, bytes, error);
  }
  const mode_t before = umask(0777 & ~old.st_mode);
  auto pending = PendingFile::Write(followed, bytes, error);
  umask(before);
  return pending;
}

}  // namespace

bool CanWrite(const std::string& name, std::string* error) {
  std::error_code ignored;
  if (const auto fd = OpenFileOf(name)) {
    const int flags = fcntl(*fd, F_GETFL);
    if (flags >= 0 && (flags & O_ACCMODE) != O_RDONLY) return true;
    *error = name + ": is not open for writing";
    return false;
  }
  const auto followed = FollowLinks(name);
  if (!followed) {
    *error = name + ": is a loop of symbolic links; name another file";
    return false;
  }
  const std::string& path = *followed;
  if (fs::is_directory(path, ignored)) {
    *error = path + ": is a directory, must be a file to write";
    return false;
  }
  if (IsDevice(path) && access(path.c_str(), W_OK) == 0) return true;
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
    return fs::weakly_canonical(
        fs::absolute(FollowLinks(path).value_or(path), ignored), ignored);
  };
  std::vector<std::string> taken = inputs;
  std::string on_standard_output;  // The flag.
  for (const auto& [name, output] : outputs) {
    if (output.empty()) continue;
    if (NamesStandardOutput(output)) {
      if (!on_standard_output.empty()) {
        *error = "--" + on_standard_output + " and --" + name +
                 " would both go to standard output; name a file for one of "
                 "them";
        return false;
      }
      on_standard_output = name;
      if (output != kStandard && !CanWrite(output, error)) return false;
      continue;
    }
    if (!CanWrite(output, error)) return false;
    if (IsDevice(output)) continue;
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
  const bool is_taken = std::ranges::any_of(outputs, NamesStandardOutput);
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
    if (IsStandardOutput(path) || IsDevice(path)) continue;
    pending.push_back(WritePending(path, bytes, error));
    if (!pending.back()) return false;
  }
  // If the reader of a pipe has exited (| head), SIGPIPE would end the program
  // and leave temporary files.
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  bool has_arrived = true;
  for (const auto& [path, bytes] : files) {
    if (IsStandardOutput(path)) {
      std::fwrite(bytes.data(), 1, bytes.size(), stdout);
    } else if (IsDevice(path)) {
      has_arrived = WriteToDevice(path, bytes, error) && has_arrived;
    }
  }
  has_arrived = FlushOutput(error) && has_arrived;
  std::signal(SIGPIPE, before);
  if (!has_arrived) return false;
  for (const auto& file : pending) {
    if (!file->Rename(error)) return false;
  }
  return true;
}

}  // namespace quatro
