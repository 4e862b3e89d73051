// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A drive on disk, its scans named by frame number, and an odometry run over
// every interval-th of them. A frame that has no file, or one that can't be
// read, is a lost scan: reported and counted, and the run goes on.

#ifndef QUATRO_EXPERIMENTS_DATASETS_SEQUENCE_H_
#define QUATRO_EXPERIMENTS_DATASETS_SEQUENCE_H_

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/odometry/odometry.h"

namespace quatro {

// Frame number -> path, of the .bin, .ply and .pcd in `folder`/velodyne or,
// without such a folder, in `folder`. Nullopt with *error set if there are
// none, a name is no number, or two have the same.
std::optional<std::map<int, std::string>> ListScans(const std::string& folder,
                                                    std::string* error);

struct SequenceOptions {
  int interval = 1;
  int first_frame = 0;
  int last_frame = -1;  // -1, or after it: of the last file.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The numbers of the frames to run over, whether or not they have a file.
// Nullopt with *error set if there are none, or if more than 10000 in a row
// have no file, as where one has a stray name. Options must be valid.
std::optional<std::vector<int>> FramesOf(
    const std::map<int, std::string>& scans,
    const SequenceOptions& options,
    std::string* error);

struct OdometryRun {
  std::vector<int> frames;  // Their numbers.
  std::vector<OdometryStep> steps;
  int num_tracked = 0;     // The first scan among them.
  int num_unreadable = 0;  // Lost as there was no file or it was bad.
  int num_lost = 0;        // These and all other lost ones.

  double MedianSeconds() const;  // Of a step; reading not counted.
  std::vector<Rigid3> Poses() const;
};

// Called after each scan.
using OdometryProgress = std::function<void(int num_done, int num_scans)>;

// Nullopt with *error set if the options are invalid or leave no frame.
std::optional<OdometryRun> RunOdometry(const std::map<int, std::string>& scans,
                                       const SequenceOptions& options,
                                       Odometry* odometry,
                                       const OdometryProgress& progress,
                                       std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_SEQUENCE_H_
