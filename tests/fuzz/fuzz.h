// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What fuzz targets share: bytes as files, and what holds of every error. A
// target is one file, NAME_fuzz.cc, with seeds in corpus/NAME; it CHECKs what
// must hold of any input (glog), and the sanitizers do the rest.

#ifndef QUATRO_TESTS_FUZZ_FUZZ_H_
#define QUATRO_TESTS_FUZZ_FUZZ_H_

#include <glog/logging.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

// Called by libFuzzer for each input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size);

namespace quatro {

inline std::string_view AsText(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// An error is one line for a terminal, and never empty.
inline void CheckIsOneLine(const std::string& error) {
  CHECK(!error.empty());
  for (const char c : error) {
    CHECK(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f)
        << "control character in: " << error;
  }
}

// A file in memory, for readers that take a path.
class MemoryFile {
 public:
  MemoryFile() : fd_(memfd_create("fuzz", MFD_CLOEXEC)) { PCHECK(fd_ >= 0); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { close(fd_); }

  // Its path, with these bytes and no others in it.
  std::string Hold(std::string_view bytes) {
    PCHECK(ftruncate(fd_, 0) == 0);
    PCHECK(pwrite(fd_, bytes.data(), bytes.size(), 0) ==
           static_cast<ssize_t>(bytes.size()));
    return "/proc/self/fd/" + std::to_string(fd_);
  }

 private:
  int fd_;
};

// A folder, in memory where the machine has such, removed at the end.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
    name += "/quatro_fuzz_XXXXXX";
    PCHECK(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  const std::string& path() const { return path_; }

  std::string Write(const std::string& name, std::string_view bytes) const {
    const std::string path = path_ + "/" + name;
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    CHECK(file.good()) << path;
    return path;
  }

 private:
  std::string path_;
};

// Several files in one text: each begins with a line "== NAME". Only those of
// `names` are taken; of two with one name, the last.
inline std::map<std::string, std::string_view> SplitFiles(
    std::string_view text, const std::vector<std::string>& names) {
  constexpr std::string_view kMark = "== ";
  std::map<std::string, std::string_view> files;
  while (text.starts_with(kMark)) {
    text.remove_prefix(kMark.size());
    const std::size_t name_end = text.find('\n');
    const std::string name(text.substr(0, name_end));
    text.remove_prefix(name_end == std::string_view::npos ? text.size()
                                                          : name_end + 1);
    std::size_t end =
        text.starts_with(kMark) ? 0 : text.find("\n" + std::string(kMark));
    end = end == std::string_view::npos ? text.size() : end + (end > 0 ? 1 : 0);
    for (const std::string& known : names) {
      if (name == known) files[name] = text.substr(0, end);
    }
    text.remove_prefix(end);
  }
  return files;
}

}  // namespace quatro

#endif  // QUATRO_TESTS_FUZZ_FUZZ_H_
