// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <regex>
#include <system_error>

#include "features/base/cloud_text.h"
#include "features/base/foreign_file.h"

namespace quatro {
namespace {

class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) : fd_(fd) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() { Close(); }

  int get() const { return fd_; }

  // Returns false on failure. Some file systems report a full disk only here.
  bool Close() {
    const int fd = fd_;
    fd_ = -1;
    return fd < 0 || close(fd) == 0;
  }

 private:
  int fd_;
};

std::string SystemError(const std::string& path, const std::string& what) {
  const int code = errno;
  return path + ": " + what + ": " + std::system_category().message(code);
}

bool WriteAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  // EINVAL: the file system has no disk to flush to.
  return fsync(fd) == 0 || errno == EINVAL;
}

// Creates a temporary file that no other process or thread writes to. Returns
// its descriptor.
int CreateTemporary(const std::string& path, std::string* temporary) {
  constexpr int kMaxAttempts = 1000;
  int fd = -1;
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    *temporary = path + ".tmp." + std::to_string(getpid()) + "." +
                 std::to_string(attempt);
    fd =
        open(temporary->c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd >= 0 || errno != EEXIST) break;
  }
  return fd;
}

}  // namespace

std::optional<std::string> ReadWholeFile(const std::string& path,
                                         std::string* error) {
  // Without O_NONBLOCK, opening a pipe would wait for its writer.
  const FileDescriptor file(
      open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status = {};
  if (file.get() < 0 || fstat(file.get(), &status) != 0) {
    *error = SystemError(path, "cannot open");
    if (path.starts_with("~/")) {
      *error += "; the shell left ~ as it is, write $HOME in its place";
    }
    return std::nullopt;
  }
  if (!S_ISREG(status.st_mode)) {
    *error = path + (S_ISDIR(status.st_mode) ? ": is a directory, not a file"
                                             : ": is not a regular file");
    return std::nullopt;
  }

  std::string bytes;
  try {
    bytes.resize(static_cast<std::size_t>(status.st_size));
  } catch (const std::exception&) {
    *error = path + ": its " + std::to_string(status.st_size) +
             " bytes do not fit in memory";
    return std::nullopt;
  }
  std::size_t size = 0;
  while (size < bytes.size()) {
    const ssize_t count =
        read(file.get(), bytes.data() + size, bytes.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      *error = SystemError(path, "cannot read");
      return std::nullopt;
    }
    if (count == 0) break;  // The file was shortened meanwhile.
    size += static_cast<std::size_t>(count);
  }
  bytes.resize(size);
  return bytes;
}

std::optional<std::string> AsText(std::string_view bytes,
                                  const std::string& name,
                                  std::string* error) {
  const std::string_view foreign = DescribeForeignFile(bytes);
  if (!foreign.empty()) {
    *error = name + ": " + std::string(foreign);
    return std::nullopt;
  }
  const char* const end = bytes.data() + bytes.size();
  SkipByteOrderMark(&bytes);
  std::string text;
  text.reserve(bytes.size());
  while (!bytes.empty()) {
    const std::string_view line = TakeLine(&bytes);
    const bool has_end = line.data() + line.size() < end;
    text.append(line);
    if (has_end) text += '\n';
  }
  return text;
}

std::optional<std::string> ReadTextFile(const std::string& path,
                                        std::string* error) {
  const auto bytes = ReadWholeFile(path, error);
  return bytes ? AsText(*bytes, path, error) : std::nullopt;
}

std::unique_ptr<PendingFile> PendingFile::Write(const std::string& name,
                                                std::string_view bytes,
                                                std::string* error) {
  // A link is followed, not replaced.
  std::error_code not_there;
  const std::string path =
      std::filesystem::is_symlink(name, not_there)
          ? std::filesystem::weakly_canonical(name, not_there).string()
          : name;
  std::string temporary;
  FileDescriptor file(CreateTemporary(path, &temporary));
  if (file.get() < 0) {
    *error = SystemError(path, "cannot create");
    return nullptr;
  }
  std::unique_ptr<PendingFile> pending(new PendingFile);
  pending->path_ = path;
  pending->temporary_ = temporary;
  if (!WriteAll(file.get(), bytes) || !file.Close()) {
    *error = SystemError(path, "cannot write");
    return nullptr;
  }
  return pending;
}

PendingFile::~PendingFile() {
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

bool PendingFile::Rename(std::string* error) {
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) {
    *error = SystemError(path_, "cannot write");
    return false;
  }
  temporary_.clear();
  return true;
}

bool WriteFileAtomically(const std::string& path,
                         std::string_view bytes,
                         std::string* error) {
  const auto pending = PendingFile::Write(path, bytes, error);
  return pending && pending->Rename(error);
}

void RemoveTemporaries(const std::string& folder) {
  const std::regex temporary(R"(.+\.tmp\.[0-9]+\.[0-9]+)");
  std::error_code status;
  std::filesystem::directory_iterator entry(folder, status);
  for (; !status && entry != std::filesystem::directory_iterator();
       entry.increment(status)) {
    if (!std::regex_match(entry->path().filename().string(), temporary)) {
      continue;
    }
    std::error_code ignored;
    std::filesystem::remove(entry->path(), ignored);
  }
}

}  // namespace quatro
