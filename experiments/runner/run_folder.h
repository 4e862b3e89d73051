// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The folder of a long run, which may be killed at any moment and resumed:
//
//   manifest.json   the inputs of the run (experiments/runner/manifest.h)
//   rows.csv        the completed pairs in order of completion, with a line
//                   per method; completed pairs are never written again
//   results.csv     the same lines in the order of the tasks, once all are done
//   shard_1_of_2/   folders of parts, if the run was split
//   views/          3D views of pairs for the report, one file each
//   notes.txt       reasons why scans could not be used
//   run.lock        locked by the process that uses the folder
//
// A pair has either all of its lines or, after a kill, none. The time and
// memory to add a pair do not grow with the number of completed pairs.

#ifndef QUATRO_EXPERIMENTS_RUNNER_RUN_FOLDER_H_
#define QUATRO_EXPERIMENTS_RUNNER_RUN_FOLDER_H_

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "experiments/metrics/pair_result.h"

namespace quatro {

// The path of the view of a pair, whether or not it exists.
std::string ViewPath(const std::string& folder, const std::string& pair);

class RunFolder {
 public:
  // Creates or resumes the folder. Returns nullptr and sets *error if another
  // process uses it, if it contains other files, if it cannot be written, or if
  // rows.csv was not written by this class. `methods` are those of each pair,
  // in this order.
  static std::unique_ptr<RunFolder> Open(
      const std::string& path,
      const std::vector<std::string>& methods,
      std::string* error);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  const std::string& path() const { return path_; }
  bool Has(const std::string& pair) const { return rows_.contains(pair); }
  std::size_t size() const { return rows_.size(); }

  // Writes the lines of one pair, and its note and view unless they are empty.
  // They are on disk when this returns. Returns false and sets *error if they
  // cannot be written; previous data stays intact.
  bool Append(const std::vector<PairResult>& results,
              const std::string& note,
              const std::string& view,
              std::string* error);

  // Writes results.csv; `pairs` names all pairs in order. Returns false and
  // sets *error if one is not done or the file cannot be written.
  bool Finish(const std::vector<std::string>& pairs, std::string* error) const;

 private:
  struct Span {
    std::uint64_t begin = 0;
    std::uint64_t size = 0;
  };

  RunFolder() = default;
  bool ReadRows(const std::vector<std::string>& methods, std::string* error);

  std::string path_;
  int lock_ = -1;
  int file_ = -1;
  std::uint64_t end_ = 0;  // End of the complete lines in rows.csv.
  std::unordered_map<std::string, Span> rows_;  // Per pair.
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_RUN_FOLDER_H_
