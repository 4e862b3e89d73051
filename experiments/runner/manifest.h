// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What made a run, as manifest.json in its folder, so that its figures can be
// traced, and so that a run that was stopped goes on only as what it was.

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

  // Name without dashes -> value: those that decide results, and the others
  // (threads, where output goes).
  std::map<std::string, std::string> flags;
  std::map<std::string, std::string> other_flags;

  DataSummary data;
};

// Of this program, this machine and now.
Manifest BeginManifest();

// JSON, with a line's end.
std::string FormatManifest(const Manifest& manifest);

// Nullopt with *error set, which names the field, if one is missing or of
// another type. Fields it does not know are passed over.
std::optional<Manifest> ParseManifest(const std::string& text,
                                      std::string* error);

// *error names the file too.
std::optional<Manifest> ReadManifest(const std::string& path,
                                     std::string* error);

// Whether both give the same results: version, seed, flags and the data's
// checksum are the same. If not, *difference is the first that is not: "flag
// --preset was 'kitti', is 'paper'". Commit, compiler and machine are left out:
// who changes the code under a run that was stopped must know that they do.
bool DecidesTheSame(const Manifest& was,
                    const Manifest& is,
                    std::string* difference);

// Leaves manifest.json in a folder that has none. Returns false and sets *error
// if that can't be, or if the one that is there decides other results.
bool TakeManifest(const std::string& folder,
                  const Manifest& manifest,
                  std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_MANIFEST_H_
