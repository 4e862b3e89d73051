// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A drive on disk, whose scans are named by frame number, and an odometry run
// over every interval-th scan. A frame without a readable file is a lost scan:
// it is reported and counted, and the run continues.

#ifndef QUATRO_EXPERIMENTS_DATASETS_SEQUENCE_H_
#define QUATRO_EXPERIMENTS_DATASETS_SEQUENCE_H_

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/odometry/odometry.h"
#include "features/io/cloud_io.h"

namespace quatro {

// Whether the name starts with a dot, as macOS's "._000001.bin" does.
bool IsHiddenFile(const std::filesystem::path& path);

// Frame number -> path of the .bin, .ply, .pcd and .npy files in
// `folder`/velodyne or, without such a folder, in `folder`. Files may be
// compressed (.gz); hidden files are ignored. Returns nullopt with *error set
// if there are no scans, a name is not a number, or two files have the same
// number.
std::optional<std::map<int, std::string>> ListScans(const std::string& folder,
                                                    std::string* error);

struct SequenceOptions {
  int interval = 1;
  int first_frame = -1;  // -1: the frame of the first file.
  int last_frame = -1;   // -1, or beyond the last file: its frame.

  ReadCloudOptions reading;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The numbers of the frames to process, whether or not they have a file.
// Returns nullopt with *error set if there are none, or if more than 10000
// frames in a row have no file, for example because of a stray file name.
// Options must be valid.
std::optional<std::vector<int>> FramesOf(
    const std::map<int, std::string>& scans,
    const SequenceOptions& options,
    std::string* error);

struct OdometryRun {
  std::vector<int> frames;  // Frame numbers.
  std::vector<OdometryStep> steps;
  int num_tracked = 0;     // Includes the first scan.
  int num_unreadable = 0;  // No readable file.
  int num_lost = 0;        // All lost scans, unreadable or not.

  double MedianSeconds() const;  // Per step, without reading.
  std::vector<Rigid3> Poses() const;
};

// Called after each scan.
using OdometryProgress = std::function<void(int num_done, int num_scans)>;

// Returns nullopt with *error set if the options are invalid or select no
// frame.
std::optional<OdometryRun> RunOdometry(const std::map<int, std::string>& scans,
                                       const SequenceOptions& options,
                                       Odometry* odometry,
                                       const OdometryProgress& progress,
                                       std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_SEQUENCE_H_
