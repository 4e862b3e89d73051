// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/sequence_folder.h"

#include <unistd.h>

#include <regex>
#include <system_error>

#include "experiments/base/outputs.h"

namespace quatro {
namespace {

namespace fs = std::filesystem;

// Accepts a missing folder, an empty folder or, with `overwrite`, a sequence.
bool MayReplace(const fs::path& output, bool overwrite, std::string* error) {
  const std::regex known(
      R"((poses|calib|times)\.txt|velodyne(/\d{6,}\.bin)?|)"
      R"(oxts(/data(/\d{10,}\.txt)?)?|)"
      R"(sensors(/(sensors|records_lidar|trajectories|records_ins)\.txt)?|)"
      R"(sensors/records_data(/lidar0(/\d{6,}\.pcd)?)?)");
  std::error_code code;
  if (!fs::exists(output, code)) return true;
  if (!fs::is_directory(output, code)) {
    *error = output.string() + ": exists and is not a folder";
    return false;
  }
  for (fs::recursive_directory_iterator entry(output, code), end;
       !code && entry != end;
       entry.increment(code)) {
    const std::string name = entry->path().lexically_relative(output).string();
    if (!overwrite) {
      *error =
          output.string() +
          ": folder is not empty; name another, or replace it by --overwrite";
      return false;
    }
    if (!std::regex_match(name, known)) {
      *error = output.string() + ": holds '" + name +
               "', which is not part of a sequence; not overwritten";
      return false;
    }
  }
  if (code) *error = output.string() + ": " + code.message();
  return !code;
}

// Moves the complete folder to its place, replacing existing files.
bool MoveInto(const fs::path& folder,
              const fs::path& output,
              std::string* error) {
  const fs::path old = folder.string() + ".old";
  std::error_code code;
  const bool replaces = fs::exists(output, code);
  if (replaces) fs::rename(output, old, code);
  if (!code) {
    fs::rename(folder, output, code);
    std::error_code ignored;
    if (code && replaces) fs::rename(old, output, ignored);
  }
  if (code) {
    *error = output.string() + ": " + code.message();
    return false;
  }
  fs::remove_all(old, code);
  return true;
}

}  // namespace

std::unique_ptr<SequenceFolder> SequenceFolder::Create(
    const std::string& output_dir,
    const fs::path& scans,
    bool overwrite,
    std::string* error) {
  if (output_dir.empty()) {
    *error = "output_dir is empty, must name a folder";
    return nullptr;
  }
  std::error_code code;
  fs::path output = fs::weakly_canonical(fs::absolute(output_dir), code);
  if (!code && !output.has_filename()) output = output.parent_path();
  if (code) {
    *error = output_dir + ": " + code.message();
    return nullptr;
  }
  if (!MayReplace(output, overwrite, error)) return nullptr;
  std::unique_ptr<SequenceFolder> folder(new SequenceFolder);
  folder->output_ = output;
  folder->folder_ = output.string() + ".partial." + std::to_string(getpid());
  folder->made_ = MakeFolders(folder->folder_, &code);
  if (!code) fs::create_directories(folder->folder_ / scans, code);
  if (code) {
    *error = folder->folder_.string() + ": " + code.message();
    return nullptr;
  }
  return folder;
}

SequenceFolder::~SequenceFolder() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  // Parents are removed only if they are empty.
  for (const fs::path& made : made_) fs::remove(made, ignored);
}

bool SequenceFolder::Finish(std::string* error) {
  return MoveInto(folder_, output_, error);
}

}  // namespace quatro
