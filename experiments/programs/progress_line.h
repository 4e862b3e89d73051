// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A progress line on standard error that is overwritten in place: how much is
// done, and how long the rest will take.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_PROGRESS_LINE_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_PROGRESS_LINE_H_

#include <cstdio>
#include <string>
#include <utility>

#include "features/base/stopwatch.h"

namespace quatro {

// Whether the cursor is after an unfinished progress line.
inline bool& IsProgressLineOpen() {
  static bool is_open = false;
  return is_open;
}

// Starts a new line for the next output, such as an error.
inline void EndProgressLine() {
  if (IsProgressLineOpen()) std::fputc('\n', stderr);
  IsProgressLineOpen() = false;
}

class ProgressLine {
 public:
  // `things` is what is counted, e.g. "scans".
  explicit ProgressLine(std::string things) : things_(std::move(things)) {}

  void operator()(int num_done, int num_things) {
    elapsed_ += stopwatch_.Lap();
    const double left = elapsed_ / num_done * (num_things - num_done);
    std::fprintf(stderr,
                 "\r%d of %d %s, %.0f s left   %s",
                 num_done,
                 num_things,
                 things_.c_str(),
                 left,
                 num_done == num_things ? "\n" : "");
    IsProgressLineOpen() = num_done != num_things;
  }

 private:
  std::string things_;
  Stopwatch stopwatch_;
  double elapsed_ = 0.0;  // [s]
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_PROGRESS_LINE_H_
