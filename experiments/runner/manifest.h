// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The inputs of a run, stored as manifest.json in its folder, so that its
// results are traceable and a run can be resumed only with the same inputs.

#ifndef QUATRO_EXPERIMENTS_RUNNER_MANIFEST_H_
#define QUATRO_EXPERIMENTS_RUNNER_MANIFEST_H_

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "experiments/runner/build_info.h"
#include "experiments/runner/data_checksum.h"

namespace quatro {

struct Manifest {
  BuildInfo build;
  MachineInfo machine;
  std::string start_time;  // UtcNow()
  std::uint64_t seed = 0;

  // Name without dashes -> value. `flags` affect the results; `other_flags`,
  // such as threads and output, do not.
  std::map<std::string, std::string> flags;
  std::map<std::string, std::string> other_flags;

  DataSummary data;
};

// The manifest for this program, this machine and the current time.
Manifest BeginManifest();

// JSON with a final line break.
std::string FormatManifest(const Manifest& manifest);

// Returns nullopt with *error set, which names the field, if a field is missing
// or has another type. Unknown fields are ignored.
std::optional<Manifest> ParseManifest(const std::string& text,
                                      std::string* error);

// *error also names the file.
std::optional<Manifest> ReadManifest(const std::string& path,
                                     std::string* error);

// Returns whether both manifests give the same results: version, seed, flags
// and the checksum of the data are equal. If not, *difference is the first
// difference: "flag --preset was 'kitti', is 'paper'". Commit, compiler and
// machine are not compared; users who change the code of an interrupted run are
// responsible for the results.
bool DecidesTheSame(const Manifest& was,
                    const Manifest& is,
                    std::string* difference);

// Writes manifest.json into a folder that has none. Returns false and sets
// *error if it cannot be written, or if the existing one would give other
// results.
bool TakeManifest(const std::string& folder,
                  const Manifest& manifest,
                  std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_MANIFEST_H_
