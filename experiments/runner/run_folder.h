// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The folder of a long run, which may be killed at any moment and gone on with:
//
//   manifest.json   what makes the results (experiments/runner/manifest.h)
//   rows.csv        the pairs that are done, as they were finished, each with
//                   a line a method; what is done is never written again
//   results.csv     the same in the order of the tasks, once all are done
//   shard_1_of_2/   folders of parts, if it was shared out
//   views/          3D views of pairs for the report, a file each
//   notes.txt       what was wrong with scans that can't be used
//   run.lock        held by the process that works here
//
// A pair is there with all of its lines or, after a kill, taken off again. Work
// and memory for it do not grow with the pairs that are done.

#ifndef QUATRO_EXPERIMENTS_RUNNER_RUN_FOLDER_H_
#define QUATRO_EXPERIMENTS_RUNNER_RUN_FOLDER_H_

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "experiments/metrics/pair_result.h"

namespace quatro {

// Where the folder has the view of a pair, if it has one.
std::string ViewPath(const std::string& folder, const std::string& pair);

class RunFolder {
 public:
  // Creates the folder or goes on with it. Returns a nullptr and sets *error if
  // another process works in it, if it holds something else, if it can't be
  // written, or if rows.csv is not what this class writes. `methods`: of each
  // pair, in this order.
  static std::unique_ptr<RunFolder> Open(
      const std::string& path,
      const std::vector<std::string>& methods,
      std::string* error);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  const std::string& path() const { return path_; }
  bool IsNew() const { return rows_.empty(); }
  bool Has(const std::string& pair) const { return rows_.contains(pair); }
  std::size_t size() const { return rows_.size(); }

  // The lines of one pair, and its note and view unless they are empty. They
  // are on the disk when this returns. Returns false and sets *error if they
  // can't be written; what was there before stays whole.
  bool Append(const std::vector<PairResult>& results,
              const std::string& note,
              const std::string& view,
              std::string* error);

  // Writes results.csv; `pairs` names all of them in order. Returns false and
  // sets *error if one is not done or the file can't be written.
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
  std::uint64_t end_ = 0;  // Of what is whole in rows.csv [bytes].
  std::unordered_map<std::string, Span> rows_;  // Of each pair.
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_RUN_FOLDER_H_
