// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/simulator.h"

#include <cmath>
#include <memory>
#include <sstream>

#include "experiments/runner/stop_signal.h"
#include "experiments/simulator/kitti_layout.h"
#include "experiments/simulator/lidar.h"
#include "experiments/simulator/road.h"
#include "experiments/simulator/street.h"

namespace quatro {
namespace {

// Checks the options that pairs and sequences share.
template <typename Options>
void CheckCommon(const Options& options, std::ostringstream* problem) {
  RoadOptions road;
  road.slope = options.slope;
  road.tilt_sigma = options.tilt_sigma;
  std::string error;
  if (options.num_threads < 0) {
    *problem << "num_threads = " << options.num_threads << ", must be >= 0";
  } else if (!road.IsValid(&error) || !options.lidar.IsValid(&error)) {
    *problem << error;
  }
}

template <typename Options>
RoadOptions RoadFor(const Options& options, double travel) {
  RoadOptions road;
  road.seed = options.seed;
  road.slope = options.slope;
  road.tilt_sigma = options.tilt_sigma;
  road.length = travel + 2.0 * kMargin;
  return road;
}

bool WriteFrames(const SimulateSequenceOptions& options,
                 const SimulateProgress& progress,
                 SequenceWriter& writer,
                 std::string* error) {
  const Road road(
      RoadFor(options, (options.num_frames - 1) * options.frame_spacing));
  const auto scene = LidarScene::Create(MakeStreet(road), error);
  if (scene == nullptr) return false;
  for (int i = 0; i < options.num_frames; ++i) {
    if (WasAskedToStop()) {
      *error = "stopped";
      return false;
    }
    const Rigid3 world_from_sensor =
        road.WorldFromSensor(kMargin + i * options.frame_spacing, 0.0, 0.0);
    const PointCloud cloud =
        scene->Scan(world_from_sensor,
                    options.lidar,
                    {options.seed, static_cast<uint64_t>(i)},
                    options.num_threads);
    if (!writer.Add(
            cloud, world_from_sensor, i * kFramePeriod, nullptr, error)) {
      return false;
    }
    if (progress) progress(i + 1, options.num_frames);
  }
  return true;
}

}  // namespace

bool SimulatePairOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(distance >= 0.0 && distance <= 1000.0)) {
    problem << "distance = " << distance << ", must be in [0, 1000]";
  } else if (!std::isfinite(yaw)) {
    problem << "yaw = " << yaw << ", must be finite";
  } else if (!(std::abs(lateral) <= 2.0)) {
    problem << "lateral = " << lateral << ", must be within +-2";
  } else {
    CheckCommon(*this, &problem);
  }
  *error = problem.str();
  return error->empty();
}

std::optional<SimulatedPair> SimulatePair(const SimulatePairOptions& options,
                                          std::string* error) {
  if (!options.IsValid(error)) return std::nullopt;
  const Road road(RoadFor(options, options.distance));
  const auto scene = LidarScene::Create(MakeStreet(road), error);
  if (scene == nullptr) return std::nullopt;

  const Rigid3 world_from_target = road.WorldFromSensor(kMargin, 0.0, 0.0);
  const Rigid3 world_from_source = road.WorldFromSensor(
      kMargin + options.distance, options.lateral, options.yaw);
  const auto scan = [&](const Rigid3& world_from_sensor, uint64_t frame) {
    return scene->Scan(world_from_sensor,
                       options.lidar,
                       {options.seed, frame},
                       options.num_threads);
  };
  return SimulatedPair{scan(world_from_source, 1),
                       scan(world_from_target, 0),
                       Inverse(world_from_target) * world_from_source};
}

bool SimulateSequenceOptions::IsValid(std::string* error) const {
  constexpr double kMaxTravel = 5000.0;  // [m]; some 10 million triangles.
  std::ostringstream problem;
  if (num_frames < 1 || num_frames > 1000000) {
    problem << "num_frames = " << num_frames << ", must be in [1, 1000000]";
  } else if (!(frame_spacing > 0.0)) {
    problem << "frame_spacing = " << frame_spacing << ", must be > 0";
  } else if (!(num_frames * frame_spacing <= kMaxTravel)) {
    problem << "num_frames = " << num_frames
            << " with frame_spacing = " << frame_spacing << " is a drive of "
            << num_frames * frame_spacing << " m, must be <= " << kMaxTravel
            << " m";
  } else {
    CheckCommon(*this, &problem);
  }
  *error = problem.str();
  return error->empty();
}

bool SimulateSequence(const SimulateSequenceOptions& options,
                      const std::string& output_dir,
                      const SimulateProgress& progress,
                      std::string* error) {
  if (!options.IsValid(error)) return false;
  const auto writer = MakeKittiWriter(output_dir, options.overwrite, error);
  return writer != nullptr && WriteFrames(options, progress, *writer, error) &&
         writer->Finish(error);
}

}  // namespace quatro
