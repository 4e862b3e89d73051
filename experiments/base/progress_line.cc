// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/base/progress_line.h"

#include <unistd.h>

#include <chrono>
#include <utility>

namespace quatro {
namespace {

constexpr double kSecondsBetweenLines = 10.0;

// Whether the terminal shows an unfinished progress line.
bool& IsProgressLineOpen() {
  static bool is_open = false;
  return is_open;
}

double SteadySeconds() {
  const std::chrono::duration<double> now =
      std::chrono::steady_clock::now().time_since_epoch();
  return now.count();
}

}  // namespace

void EndProgressLine() {
  if (IsProgressLineOpen()) std::fputc('\n', stderr);
  IsProgressLineOpen() = false;
}

ProgressLine::ProgressLine(std::string things, std::string label)
    : ProgressLine(std::move(things),
                   std::move(label),
                   {stderr, isatty(STDERR_FILENO) == 1, SteadySeconds}) {}

ProgressLine::ProgressLine(std::string things, std::string label, Output output)
    : things_(std::move(things)),
      label_(std::move(label)),
      output_(std::move(output)),
      start_(output_.clock()),
      last_printed_(start_) {}

void ProgressLine::operator()(int num_done, int num_things) {
  if (has_ended_) return;
  has_ended_ = num_done == num_things;
  const double now = output_.clock();
  if (!output_.is_terminal && !has_ended_ &&
      now - last_printed_ < kSecondsBetweenLines) {
    return;
  }
  last_printed_ = now;
  const double left = (now - start_) / num_done * (num_things - num_done);
  std::fprintf(output_.file,
               "%s%s%d of %d %s, %.0f s left%s%s",
               output_.is_terminal ? "\r" : "",
               label_.c_str(),
               num_done,
               num_things,
               things_.c_str(),
               left,
               output_.is_terminal ? "   " : "",
               has_ended_ || !output_.is_terminal ? "\n" : "");
  std::fflush(output_.file);
  IsProgressLineOpen() = output_.is_terminal && !has_ended_;
}

}  // namespace quatro
