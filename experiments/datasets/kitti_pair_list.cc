// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/datasets/kitti_pair_list.h"

#include <Eigen/Core>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/base/number_text.h"
#include "experiments/datasets/kitti_odometry.h"
#include "experiments/datasets/kitti_poses.h"
#include "features/base/file.h"

namespace quatro {
namespace {

namespace fs = std::filesystem;

using Matrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

struct Entry {
  std::string sequence;
  int source = 0, target = 0;
  Rigid3 target_from_source;
};

// The number of a frame or a sequence.
std::optional<int> AsIndex(double value) {
  if (!(value >= 0.0 && value <= 1e8) || value != std::floor(value)) {
    return std::nullopt;
  }
  return static_cast<int>(value);
}

std::optional<Entry> ParseEntry(std::string_view line, std::string* reason) {
  const auto fields = SplitFields(line, kBlanks);
  if (fields.size() != 20) {
    *reason = "has " + std::to_string(fields.size()) + " numbers, must have 20";
    return std::nullopt;
  }
  double values[20];
  for (std::size_t i = 0; i < 20; ++i) {
    const auto value = ParseFiniteNumber(fields[i]);
    if (!value) {
      *reason = "number " + std::to_string(i + 1) + " is not a finite number";
      return std::nullopt;
    }
    values[i] = *value;
  }
  int indices[4];
  for (std::size_t i = 0; i < 4; ++i) {
    const auto index = AsIndex(values[i]);
    if (!index) {
      *reason = "number " + std::to_string(i + 1) + " is not an index";
      return std::nullopt;
    }
    indices[i] = *index;
  }
  if (indices[0] != indices[2]) {
    *reason = "is of two sequences";
    return std::nullopt;
  }
  const Matrix matrix = Eigen::Map<const Matrix>(values + 4);
  const auto pose = NearestRigid3(matrix.topRows<3>());
  if (!pose || matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    *reason = "is not a rotation and a translation";
    return std::nullopt;
  }
  char sequence[16];
  std::snprintf(sequence, sizeof(sequence), "%02d", indices[0]);
  return Entry{sequence, indices[1], indices[3], *pose};
}

// "10-20 m" for kitti_lc_10_20.txt, and the name without extension for others.
std::string BinOf(const std::string& list) {
  std::string stem = fs::path(list).stem().string();
  int min = 0, max = 0, end = 0;
  if (std::sscanf(stem.c_str(), "kitti_lc_%d_%d%n", &min, &max, &end) == 2 &&
      static_cast<std::size_t>(end) == stem.size()) {
    return std::to_string(min) + "-" + std::to_string(max) + " m";
  }
  return stem;
}

bool IsKnownWrong(const Entry& entry) {
  const Eigen::Vector3d wrong(25.961651, 11.908589, -0.007392);  // [m]
  return entry.sequence == "08" && entry.source == 15 && entry.target == 58 &&
         (entry.target_from_source.translation - wrong).norm() < 0.01;
}

// Reads each sequence once, for its scan files and its INS. A sequence that
// cannot be read is noted.
class Sequences {
 public:
  Sequences(const KittiPairListOptions& options, PairSelection* selection)
      : options_(options), selection_(*selection) {}

  // Sets source, target and INS of a task.
  void Complete(const Entry& entry, PairTask* task) {
    if (options_.folder.empty()) return;
    const SequenceData* data = Read(entry.sequence);
    const auto path_of = [&](int frame) {
      if (data != nullptr) {
        const auto scan = data->scans.find(frame);
        if (scan != data->scans.end()) return scan->second;
      }
      char name[48];
      std::snprintf(name, sizeof(name), "velodyne/%06d.bin", frame);
      return (fs::path(options_.folder) / "sequences" / entry.sequence / name)
          .string();
    };
    task->source = path_of(entry.source);
    task->target = path_of(entry.target);
    if (data == nullptr || !options_.has_ins) return;
    if (const auto pair = MakePairTask(*data, entry.source, entry.target)) {
      task->ins = pair->ins;
    }
  }

 private:
  const SequenceData* Read(const std::string& name) {
    const auto known = sequences_.find(name);
    if (known != sequences_.end()) {
      return known->second ? &*known->second : nullptr;
    }
    KittiOdometryOptions options;
    options.folder = options_.folder;
    options.sequence = name;
    options.ins_std = options_.ins_std;
    std::string error;
    auto data = ReadKittiOdometry(options, &error);
    if (!data) {
      selection_.notes.push_back(error);
    } else {
      for (const std::string& note : data->notes) {
        if (note.find(": INS from ") != std::string::npos) {
          selection_.notes.push_back(note);
        }
      }
    }
    const auto& kept = sequences_[name] = std::move(data);
    return kept ? &*kept : nullptr;
  }

  const KittiPairListOptions& options_;
  PairSelection& selection_;
  std::map<std::string, std::optional<SequenceData>> sequences_;
};

}  // namespace

bool KittiPairListOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (list.empty()) {
    problem << "list is empty, must name a file";
  } else if (!(ins_std > 0.0 && ins_std <= 0.2)) {
    problem << "ins_std = " << ins_std << ", must be in (0, 0.2]";
  }
  *error = problem.str();
  return error->empty();
}

std::optional<PairSelection> ReadKittiPairList(
    const KittiPairListOptions& options, std::string* error) {
  if (!options.IsValid(error)) return std::nullopt;
  const auto text = ReadTextFile(options.list, error);
  if (!text) return std::nullopt;
  PairSelection selection;
  Sequences sequences(options, &selection);
  const std::string bin = BinOf(options.list);
  int line_number = 0;
  for (const std::string_view line : SplitLines(*text)) {
    if (++line_number == 1 && line.starts_with("seq")) continue;
    if (SplitFields(line, kBlanks).empty()) continue;
    std::string reason;
    const auto entry = ParseEntry(line, &reason);
    if (!entry) {
      *error =
          options.list + ": line " + std::to_string(line_number) + " " + reason;
      return std::nullopt;
    }
    PairTask task;
    char name[64];
    std::snprintf(
        name, sizeof(name), "/%06d-%06d", entry->source, entry->target);
    task.name = entry->sequence + name;
    task.set = entry->sequence;
    task.bin = bin;
    task.true_target_from_source = entry->target_from_source;
    if (IsKnownWrong(*entry) && !options.keeps_known_wrong) {
      selection.notes.push_back(task.name + ": is known to be wrong, left out");
      continue;
    }
    sequences.Complete(*entry, &task);
    selection.tasks.push_back(std::move(task));
  }
  if (selection.tasks.empty()) {
    *error = options.list + ": holds no pair";
    return std::nullopt;
  }
  if (!options.folder.empty()) CountMissingScans(&selection);
  return selection;
}

}  // namespace quatro
