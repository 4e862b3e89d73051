// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Whether a run goes on with the data it began with. Scans are many gigabytes,
// so they are told by name and size; lists of pairs and poses, which decide
// what is right, by what they hold. FNV-1a of 64 bits over
//
//   name 0 size 0   of each scan in the order of names, "missing" for its size
//                   if there is none,
//   name 0 hash 0   of each list, in the order of names:
//
// it finds accidents, not forgery. It depends on neither the folder's place nor
// the order in which files are given.

#ifndef QUATRO_EXPERIMENTS_RUNNER_DATA_CHECKSUM_H_
#define QUATRO_EXPERIMENTS_RUNNER_DATA_CHECKSUM_H_

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quatro {

struct DataSummary {
  long num_files = 0;    // Different ones, the lists among them.
  long num_missing = 0;  // Of the scans.
  std::uint64_t num_bytes = 0;
  std::string checksum;  // 16 hexadecimal digits.
};

std::uint64_t Fnv1a(std::string_view bytes,
                    std::uint64_t hash = 0xcbf29ce484222325u);

// Names are relative to `folder`, or absolute. Nullopt with *error set if a
// list can't be read.
std::optional<DataSummary> SummarizeData(const std::string& folder,
                                         std::vector<std::string> scans,
                                         std::vector<std::string> lists,
                                         std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_DATA_CHECKSUM_H_
