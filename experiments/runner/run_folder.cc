// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/runner/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>

#include "experiments/runner/data_checksum.h"
#include "features/base/file.h"

namespace quatro {
namespace {

namespace fs = std::filesystem;

std::string WhyNot(const std::string& path) {
  return path + ": " + std::strerror(errno);
}

// Writes all bytes at an offset, or returns false with errno set.
bool WriteAt(int file, std::string_view bytes, std::uint64_t offset) {
  while (!bytes.empty()) {
    const ssize_t written =
        pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
    offset += static_cast<std::uint64_t>(written);
  }
  return true;
}

// Whether the folder may be used for a run: it has a lock, or contains nothing
// but parts.
bool MayBeARun(const std::string& folder) {
  std::error_code status;
  if (fs::exists(fs::path(folder) / "run.lock", status)) return true;
  for (fs::directory_iterator it(folder, status), end; !status && it != end;
       it.increment(status)) {
    if (!it->path().filename().string().starts_with("shard_")) return false;
  }
  return true;
}

}  // namespace

// Uses a hash, because names of pairs need not be valid file names.
std::string ViewPath(const std::string& folder, const std::string& pair) {
  char name[32];
  std::snprintf(name,
                sizeof(name),
                "%016llx",
                static_cast<unsigned long long>(Fnv1a(pair)));
  return folder + "/views/" + name + ".json";
}

std::unique_ptr<RunFolder> RunFolder::Open(
    const std::string& path,
    const std::vector<std::string>& methods,
    std::string* error) {
  std::error_code status;
  if (fs::exists(path, status) && !fs::is_directory(path, status)) {
    *error = path + ": is not a folder";
    return nullptr;
  }
  if (fs::is_directory(path, status) && !MayBeARun(path)) {
    *error = path + ": holds other files, must be new, empty or a run's folder";
    return nullptr;
  }
  fs::create_directories(path, status);
  if (status) {
    *error = path + ": " + status.message();
    return nullptr;
  }

  std::unique_ptr<RunFolder> folder(new RunFolder);
  folder->path_ = path;
  const std::string lock = path + "/run.lock";
  folder->lock_ = open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (folder->lock_ < 0) {
    *error = WhyNot(lock);
    return nullptr;
  }
  if (flock(folder->lock_, LOCK_EX | LOCK_NB) != 0) {
    *error = errno == EWOULDBLOCK
                 ? path +
                       ": another process works in this folder; wait for it "
                       "or stop it"
                 : WhyNot(lock);
    return nullptr;
  }
  for (const char* part : {"", "/views", "/tables"}) {
    RemoveTemporaries(path + part);
  }
  const std::string rows = path + "/rows.csv";
  folder->file_ = open(rows.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (folder->file_ < 0) {
    *error = WhyNot(rows);
    return nullptr;
  }
  if (!folder->ReadRows(methods, error)) return nullptr;
  return folder;
}

RunFolder::~RunFolder() {
  if (file_ >= 0) close(file_);
  if (lock_ >= 0) close(lock_);  // Releases the lock.
}

bool RunFolder::ReadRows(const std::vector<std::string>& methods,
                         std::string* error) {
  const std::string path = path_ + "/rows.csv";
  const std::optional<std::string> text = ReadWholeFile(path, error);
  if (!text) return false;
  const std::string header = ResultCsvHeader() + "\n";
  if (text->size() < header.size() && header.starts_with(*text)) {
    if (!WriteAt(file_, header, 0) || fdatasync(file_) != 0) {
      *error = WhyNot(path);
      return false;
    }
    end_ = header.size();
    return true;
  }
  if (!text->starts_with(header)) {
    *error = path + ": line 1 is not the header line of this version";
    return false;
  }

  // After a kill, the last pair may be incomplete.
  end_ = header.size();
  std::uint64_t at = end_;
  int line_number = 2;
  std::size_t next_method = 0;
  std::string pair;
  while (at < text->size()) {
    const std::size_t line_end = text->find('\n', at);
    if (line_end == std::string::npos) break;
    const auto result = ParseResultCsv(text->substr(at, line_end - at), error);
    if (!result || result->method != methods[next_method] ||
        (next_method > 0 && result->pair != pair)) {
      if (result) *error = "does not match the methods or pairs of this run";
      *error = path + ": line " + std::to_string(line_number) + ": " + *error;
      return false;
    }
    pair = result->pair;
    at = line_end + 1;
    ++line_number;
    if (++next_method < methods.size()) continue;
    rows_[pair] = {end_, at - end_};
    end_ = at;
    next_method = 0;
  }
  if (end_ < text->size() && ftruncate(file_, static_cast<off_t>(end_)) != 0) {
    *error = WhyNot(path);
    return false;
  }
  return true;
}

bool RunFolder::Append(const std::vector<PairResult>& results,
                       const std::string& note,
                       const std::string& view,
                       std::string* error) {
  // The view is written before the lines, so that a completed pair always has
  // its view, even after a kill.
  if (!view.empty()) {
    std::error_code status;
    fs::create_directories(path_ + "/views", status);
    if (status) {
      *error = path_ + "/views: " + status.message();
      return false;
    }
    if (!WriteFileAtomically(
            ViewPath(path_, results.front().pair), view, error)) {
      return false;
    }
  }
  if (!note.empty()) {
    const std::string path = path_ + "/notes.txt";
    const int file =
        open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    const std::string line = results.front().pair + ": " + note + "\n";
    const bool is_written =
        file >= 0 && write(file, line.data(), line.size()) ==
                         static_cast<ssize_t>(line.size());
    if (!is_written) *error = WhyNot(path);
    if (file >= 0) close(file);
    if (!is_written) return false;
  }
  std::string text;
  for (const PairResult& result : results)
    text += FormatResultCsv(result) + "\n";
  if (!WriteAt(file_, text, end_) || fdatasync(file_) != 0) {
    *error = WhyNot(path_ + "/rows.csv");
    // Removes partly written lines. If this fails, the next start does it.
    [[maybe_unused]] const int ignored =
        ftruncate(file_, static_cast<off_t>(end_));
    return false;
  }
  rows_[results.front().pair] = {end_, text.size()};
  end_ += text.size();
  return true;
}

bool RunFolder::Finish(const std::vector<std::string>& pairs,
                       std::string* error) const {
  const auto text = ReadWholeFile(path_ + "/rows.csv", error);
  if (!text) return false;
  std::string ordered = ResultCsvHeader() + "\n";
  ordered.reserve(text->size());
  for (const std::string& pair : pairs) {
    const auto row = rows_.find(pair);
    if (row == rows_.end()) {
      *error = path_ + ": pair " + pair + " is not done";
      return false;
    }
    ordered.append(*text, row->second.begin, row->second.size);
  }
  return WriteFileAtomically(path_ + "/results.csv", ordered, error);
}

}  // namespace quatro
