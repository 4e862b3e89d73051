// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/pair_files.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>

#include "experiments/base/outputs.h"
#include "features/base/degree.h"
#include "features/base/file.h"
#include "features/base/parallel.h"
#include "features/io/cloud_io.h"

namespace quatro {
namespace {

namespace fs = std::filesystem;

constexpr char kSharedColumns[] =
    "world,variant,sensor,seed,apart,source_rpy_deg,target_rpy_deg,ins_std_deg,"
    "twin_tx,twin_ty,twin_tz,twin_qx,twin_qy,twin_qz,twin_qw\n";

std::string Format(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

// Formats tx,ty,tz,qx,qy,qz,qw.
std::string FormatPose(const Rigid3& pose) {
  Eigen::Quaterniond q(pose.rotation);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  std::string cells;
  for (const double t :
       {pose.translation.x(), pose.translation.y(), pose.translation.z()}) {
    cells += Format("%.6f,", t);
  }
  cells += Format("%.9f,", q.x()) + Format("%.9f,", q.y());
  return cells + Format("%.9f,", q.z()) + Format("%.9f", q.w());
}

std::string FormatAttitude(const Attitude& attitude) {
  return Format("\"%.4f,", attitude.roll / kDegree) +
         Format("%.4f,", attitude.pitch / kDegree) +
         Format("%.4f\"", attitude.yaw / kDegree);
}

std::string FileName(const PairSetOptions& set, int index, const char* which) {
  char name[32];
  std::snprintf(name, sizeof(name), "/%06d_%s.bin", index, which);
  return set.Name() + name;
}

std::string FormatRow(const PairSetOptions& set,
                      int index,
                      const SetPair& pair) {
  std::string name = set.Name();
  if (pair.apart == "other_floor") {
    name = std::string(WorldName(set.world)) + "_floor";
  } else if (pair.twin_target_from_source &&
             pair.variant.find("_odd") == std::string::npos) {
    name += "_twin";
  }
  std::string row = name + "," + FileName(set, index, "source") + "," +
                    FileName(set, index, "target") + ",";
  if (pair.true_target_from_source) {
    const Rigid3& pose = *pair.true_target_from_source;
    const double yaw = Yaw(pose.rotation);
    const double tilt = AngleBetween(RotationZ(yaw), pose.rotation);
    row += FormatPose(pose) + Format(",%.3f", pose.translation.norm()) +
           Format(",%.3f", yaw / kDegree) + Format(",%.3f,", tilt / kDegree);
  }
  row += std::string(WorldName(set.world)) + "," + pair.variant + "," +
         pair.sensor + "," + std::to_string(pair.seed) + "," + pair.apart +
         "," + FormatAttitude(pair.source_ins) + "," +
         FormatAttitude(pair.target_ins) +
         Format(",%g,", set.ins_sigma / kDegree);
  row += pair.twin_target_from_source
             ? FormatPose(*pair.twin_target_from_source)
             : std::string(6, ',');
  return row + "\n";
}

// All inputs of the pairs. The number of pairs is left out, because more can be
// added later.
nlohmann::json Describe(const PairSetOptions& set) {
  return {{"world", WorldName(set.world)},
          {"seed", set.seed},
          {"distance_m", {set.min_distance, set.max_distance}},
          {"max_yaw_deg", set.max_yaw / kDegree},
          {"tilt_deg", {set.min_tilt / kDegree, set.max_tilt / kDegree}},
          {"no_overlap", set.no_overlap},
          {"num_features", set.num_features},
          {"sensor", set.sensor},
          {"tilt_sigma_deg", set.tilt_sigma / kDegree},
          {"ins_std_deg", set.ins_sigma / kDegree}};
}

// Creates the folder, or checks that it belongs to the same sets.
bool OpenFolder(const std::vector<PairSetOptions>& sets,
                const fs::path& folder,
                std::string* error) {
  nlohmann::json settings = nlohmann::json::object();
  for (const PairSetOptions& set : sets) settings[set.Name()] = Describe(set);
  const fs::path file = folder / "settings.json";
  std::error_code code;
  if (fs::exists(file, code)) {
    const auto text = ReadWholeFile(file.string(), error);
    if (!text) return false;
    if (nlohmann::json::parse(*text, nullptr, false) == settings) return true;
    *error = file.string() + ": the folder contains pairs with other options";
    return false;
  }
  if (fs::exists(folder, code) &&
      (!fs::is_directory(folder, code) || !fs::is_empty(folder, code))) {
    *error = folder.string() + ": exists and is not a folder of pairs";
    return false;
  }
  MakeFolders(folder / "rows", &code);
  if (code) {
    *error = folder.string() + ": " + code.message();
    return false;
  }
  for (const PairSetOptions& set : sets) {
    fs::create_directories(folder / set.Name(), code);
  }
  if (code) {
    *error = folder.string() + ": " + code.message();
    return false;
  }
  return WriteFileAtomically(file.string(), settings.dump(2) + "\n", error);
}

fs::path RowFile(const fs::path& folder, const PairSetOptions& set, int index) {
  char name[16];
  std::snprintf(name, sizeof(name), "_%06d.csv", index);
  return folder / "rows" / (set.Name() + name);
}

// The row is written last; its existence means that the scans are complete.
bool WritePair(const PairSetOptions& set,
               int index,
               const fs::path& folder,
               std::string* error) {
  const auto pair = SimulateSetPair(set, index, error);
  return pair &&
         WriteCloud(pair->source,
                    (folder / FileName(set, index, "source")).string(),
                    error) &&
         WriteCloud(pair->target,
                    (folder / FileName(set, index, "target")).string(),
                    error) &&
         WriteFileAtomically(RowFile(folder, set, index).string(),
                             FormatRow(set, index, *pair),
                             error);
}

bool WriteLists(const std::vector<PairSetOptions>& sets,
                const fs::path& folder,
                std::string* error) {
  std::string with_pose, without;
  for (const PairSetOptions& set : sets) {
    for (int i = 0; i < set.num_pairs; ++i) {
      const auto row = ReadWholeFile(RowFile(folder, set, i).string(), error);
      if (!row) return false;
      (set.no_overlap ? without : with_pose) += *row;
    }
  }
  const std::string names = "set,source,target,";
  const std::string of_pose =
      "tx,ty,tz,qx,qy,qz,qw,distance_m,yaw_deg,rollpitch_deg,";
  if (!with_pose.empty() &&
      !WriteFileAtomically((folder / "pairs.csv").string(),
                           names + of_pose + kSharedColumns + with_pose,
                           error)) {
    return false;
  }
  return without.empty() ||
         WriteFileAtomically((folder / "pairs_negative.csv").string(),
                             names + kSharedColumns + without,
                             error);
}

}  // namespace

bool WritePairSets(const std::vector<PairSetOptions>& sets,
                   const std::string& output_dir,
                   int num_threads,
                   const PairProgress& progress,
                   std::string* error) {
  std::set<std::string> names;
  for (const PairSetOptions& set : sets) {
    if (!set.IsValid(error)) return false;
    if (!names.insert(set.Name()).second) {
      *error = "two sets have the name " + set.Name();
      return false;
    }
  }
  if (num_threads < 0) {
    *error = "num_threads = " + std::to_string(num_threads) + ", must be >= 0";
    return false;
  }
  if (output_dir.empty()) {
    *error = "output_dir is empty, must name a folder";
    return false;
  }
  const fs::path folder = output_dir;
  if (!OpenFolder(sets, folder, error)) return false;

  std::vector<std::pair<const PairSetOptions*, int>> missing;
  for (const PairSetOptions& set : sets) {
    for (int i = 0; i < set.num_pairs; ++i) {
      if (!fs::exists(RowFile(folder, set, i))) missing.emplace_back(&set, i);
    }
  }
  std::mutex mutex;  // Protects the variables below.
  int num_done = 0;
  bool ok = true;
  ParallelFor(num_threads,
              static_cast<Eigen::Index>(missing.size()),
              1,
              [&](Eigen::Index begin, Eigen::Index) {
                {
                  const std::lock_guard lock(mutex);
                  if (!ok) return;
                }
                const auto& [set, index] = missing[static_cast<size_t>(begin)];
                std::string problem;
                const bool is_written =
                    WritePair(*set, index, folder, &problem);
                const std::lock_guard lock(mutex);
                if (!is_written && ok) *error = problem;
                ok = ok && is_written;
                if (ok && progress) {
                  progress(++num_done, static_cast<int>(missing.size()));
                }
              });
  return ok && WriteLists(sets, folder, error);
}

}  // namespace quatro
