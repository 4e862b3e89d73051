// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Reports the progress and the estimated remaining time on standard error. On a
// terminal, this is one line that is overwritten. Elsewhere, for example in the
// log of a batch job, it is at most one line every ten seconds, and one at the
// end.

#ifndef QUATRO_EXPERIMENTS_BASE_PROGRESS_LINE_H_
#define QUATRO_EXPERIMENTS_BASE_PROGRESS_LINE_H_

#include <cstdio>
#include <functional>
#include <string>

namespace quatro {

// Ends an unfinished progress line, so that a message gets its own line.
void EndProgressLine();

class ProgressLine {
 public:
  // The stream to print to, and a clock in seconds with any start.
  struct Output {
    std::FILE* file;
    bool is_terminal;
    std::function<double()> clock;
  };

  // `things` names the counted things, for example "scans"; `label` is printed
  // in front.
  explicit ProgressLine(std::string things, std::string label = "");
  ProgressLine(std::string things, std::string label, Output output);

  void operator()(int num_done, int num_things);

 private:
  std::string things_;
  std::string label_;
  Output output_;
  double start_;         // [s]
  double last_printed_;  // [s], at first the start.
  bool has_ended_ = false;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BASE_PROGRESS_LINE_H_
