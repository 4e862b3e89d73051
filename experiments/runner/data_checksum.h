// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Checksum that detects whether a run resumes with the data it started with.
// Scans are many gigabytes, so only their names and sizes are used. Lists of
// pairs and poses, which define the ground truth, are hashed. The checksum is
// the 64-bit FNV-1a hash of
//
//   name 0 size 0   of each scan, in the order of names, with "missing" for
//                   the size if there is no file,
//   name 0 hash 0   of each list, in the order of names.
//
// It detects accidental changes, not forgery. It depends neither on the
// location of the folder nor on the order of the given files.

#ifndef QUATRO_EXPERIMENTS_RUNNER_DATA_CHECKSUM_H_
#define QUATRO_EXPERIMENTS_RUNNER_DATA_CHECKSUM_H_

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quatro {

struct DataSummary {
  long num_files = 0;    // Distinct files, including lists.
  long num_missing = 0;  // Missing scans.
  std::uint64_t num_bytes = 0;
  std::string checksum;  // 16 hexadecimal digits.
};

std::uint64_t Fnv1a(std::string_view bytes,
                    std::uint64_t hash = 0xcbf29ce484222325u);

// Names are relative to `folder`, or absolute. Returns nullopt with *error set
// if a list cannot be read.
std::optional<DataSummary> SummarizeData(const std::string& folder,
                                         std::vector<std::string> scans,
                                         std::vector<std::string> lists,
                                         std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_DATA_CHECKSUM_H_
