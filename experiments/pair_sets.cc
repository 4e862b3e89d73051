// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/pair_sets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <system_error>

#include "experiments/lidar.h"
#include "experiments/sensors.h"
#include "features/cloud_io.h"
#include "features/file.h"
#include "features/parallel.h"
#include "features/random.h"

namespace quatro {
namespace {

namespace fs = std::filesystem;

constexpr double kDegree = M_PI / 180.0;

// Two cars this far apart have nothing in their ranges in common [m].
constexpr double kFarApart = 300.0;

constexpr char kSharedColumns[] =
    "world,variant,sensor,seed,apart,source_rpy_deg,target_rpy_deg,ins_std_deg,"
    "twin_tx,twin_ty,twin_tz,twin_qx,twin_qy,twin_qz,twin_qw\n";

double Normal(Random& random) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - random.Uniform()));
  return radius * std::cos(2.0 * M_PI * random.Uniform());
}

// Of the sensor against gravity and the world's x axis, with an error.
Attitude Measure(const Rigid3& world_from_sensor,
                 double sigma,
                 Random& random) {
  const Eigen::Matrix3d& R = world_from_sensor.rotation;
  Attitude attitude;
  attitude.roll = std::atan2(R(2, 1), R(2, 2)) + sigma * Normal(random);
  attitude.pitch = std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2))) +
                   sigma * Normal(random);
  attitude.yaw = Yaw(R) + sigma * Normal(random);
  return attitude;
}

// A second world for a pair without common ground; what it is apart by.
std::string OtherWorld(const PairSetOptions& set,
                       Random& random,
                       WorldOptions* world) {
  const bool may_be_far =
      set.world == WorldKind::kStreet || set.world == WorldKind::kHill;
  const bool has_floors =
      set.world == WorldKind::kHall || set.world == WorldKind::kCorridor;
  const bool is_same_world = random.Uniform() < 1.0 / 3.0;
  if (is_same_world && may_be_far) {
    world->distance = kFarApart;
    return "far_apart";
  }
  if (is_same_world && has_floors) {
    world->floor = 1;
    return "other_floor";
  }
  world->seed = random.Next();
  return "other_seed";
}

std::string Format(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

// tx,ty,tz,qx,qy,qz,qw
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
  std::string row = set.Name() + "," + FileName(set, index, "source") + "," +
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

// All that pairs depend on, so not how many there are.
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

// Makes the folder, or finds it to be of the same sets.
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
    *error = file.string() + ": pairs of other options are in this folder";
    return false;
  }
  if (fs::exists(folder, code) &&
      (!fs::is_directory(folder, code) || !fs::is_empty(folder, code))) {
    *error = folder.string() + ": is there and is no folder of pairs";
    return false;
  }
  fs::create_directories(folder / "rows", code);
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

// The row comes last: it vouches for the scans.
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

std::string PairSetOptions::Name() const {
  return std::string(WorldName(world)) + (no_overlap ? "_apart" : "");
}

bool PairSetOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  std::string lower;
  WorldOptions options;
  options.kind = world;
  options.tilt_sigma = tilt_sigma;
  options.num_features = num_features;
  options.distance = max_distance;
  options.tilt = max_tilt;
  if (num_pairs < 1 || num_pairs > 1000000) {
    problem << "num_pairs = " << num_pairs << ", must be in [1, 1000000]";
  } else if (!(min_distance >= 0.0 && min_distance <= max_distance)) {
    problem << "min_distance = " << min_distance
            << ", must be in [0, max_distance = " << max_distance << "]";
  } else if (!(max_distance <= 50.0)) {
    problem << "max_distance = " << max_distance << ", must be <= 50";
  } else if (!(max_yaw >= 0.0 && max_yaw <= 3.15)) {
    problem << "max_yaw = " << max_yaw << ", must be in [0, pi]";
  } else if (!(min_tilt >= 0.0 && min_tilt <= max_tilt)) {
    problem << "min_tilt = " << min_tilt
            << ", must be in [0, max_tilt = " << max_tilt << "]";
  } else if (!(ins_sigma >= 0.0 && ins_sigma <= 0.2)) {
    problem << "ins_sigma = " << ins_sigma << ", must be in [0, 0.2]";
  } else if (sensor != "auto" && !MakeSensor(sensor, &lower)) {
    problem << "sensor = " << lower << " auto";
  } else if (!options.IsValid(&lower)) {
    problem << lower;
  }
  *error = problem.str();
  return error->empty();
}

std::optional<SetPair> SimulateSetPair(const PairSetOptions& options,
                                       int index,
                                       std::string* error) {
  if (!options.IsValid(error)) return std::nullopt;
  const auto set_key =
      2 * static_cast<uint64_t>(options.world) + (options.no_overlap ? 1 : 0);
  Random random(
      Mix(Mix(Mix(options.seed) ^ set_key) ^ static_cast<uint64_t>(index)));
  WorldOptions world_options;
  world_options.kind = options.world;
  world_options.seed = random.Next() >> 11;  // So that a double can hold it.
  world_options.distance =
      Uniform(random, options.min_distance, options.max_distance);
  world_options.yaw = Uniform(random, -options.max_yaw, options.max_yaw);
  world_options.tilt = Uniform(random, options.min_tilt, options.max_tilt);
  world_options.tilt_sigma = options.tilt_sigma;
  world_options.num_features = options.num_features;

  SetPair pair;
  pair.seed = pair.target_seed = world_options.seed;
  const World world = MakeWorld(world_options);
  std::optional<World> other;  // Of the source, if that is elsewhere.
  if (options.no_overlap) {
    WorldOptions other_options = world_options;
    pair.apart = OtherWorld(options, random, &other_options);
    pair.seed = other_options.seed;
    other = MakeWorld(other_options);
  }
  // One long street is both worlds.
  const World& of_source = other ? *other : world;
  const World& of_target = pair.apart == "far_apart" ? *other : world;
  pair.sensor = options.sensor == "auto" ? of_target.sensor : options.sensor;
  pair.variant = of_source.variant;
  const auto lidar = MakeSensor(pair.sensor, error);
  if (!lidar) return std::nullopt;

  const Rigid3& world_from_source = of_source.world_from_source;
  const Rigid3& world_from_target = of_target.world_from_target;
  pair.world_from_source = world_from_source;
  pair.world_from_target = world_from_target;
  const uint64_t noise_seed = random.Next();
  auto scene = LidarScene::Create(of_source.scene, error);
  if (scene == nullptr) return std::nullopt;
  pair.source = scene->Scan(world_from_source, *lidar, {noise_seed, 1}, 1);
  if (&of_source != &of_target) {
    scene = LidarScene::Create(of_target.scene, error);
    if (scene == nullptr) return std::nullopt;
  }
  pair.target = scene->Scan(world_from_target, *lidar, {noise_seed, 0}, 1);
  pair.source_ins = Measure(world_from_source, options.ins_sigma, random);
  pair.target_ins = Measure(world_from_target, options.ins_sigma, random);
  if (!options.no_overlap) {
    pair.true_target_from_source =
        Inverse(world_from_target) * world_from_source;
    if (world.symmetry) {
      pair.twin_target_from_source =
          Inverse(world_from_target) * *world.symmetry * world_from_source;
    }
  }
  return pair;
}

std::vector<PairSetOptions> CalibrationSets(uint64_t seed, double scale) {
  std::vector<PairSetOptions> sets;
  for (const bool no_overlap : {false, true}) {
    for (const auto& [world, num_pairs] :
         {std::pair(WorldKind::kStreet, 250),
          std::pair(WorldKind::kCrossing, 100),
          std::pair(WorldKind::kHill, 100),
          std::pair(WorldKind::kCorridor, 100),
          std::pair(WorldKind::kHall, 100),
          std::pair(WorldKind::kSymmetric, 100)}) {
      PairSetOptions set;
      set.world = world;
      set.num_pairs = std::max(1, static_cast<int>(num_pairs * scale + 0.5));
      set.seed = seed;
      set.no_overlap = no_overlap;
      if (world == WorldKind::kHill) set.min_distance = 8.0;
      if (world == WorldKind::kHall) set.max_distance = 15.0;
      if (world == WorldKind::kSymmetric) set.max_distance = 15.0;
      sets.push_back(set);
    }
  }
  return sets;
}

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
  std::mutex mutex;  // Of what is below.
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
