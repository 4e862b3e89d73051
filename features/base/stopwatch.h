// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The run time of each stage of a computation.

#ifndef QUATRO_FEATURES_BASE_STOPWATCH_H_
#define QUATRO_FEATURES_BASE_STOPWATCH_H_

#include <chrono>
#include <string>

namespace quatro {

// A stage and its run time.
struct StageTime {
  std::string stage;
  double seconds = 0.0;
};

// A stopwatch on the steady clock.
class Stopwatch {
 public:
  // The time since the last lap or, for the first lap, since construction [s].
  double Lap() {
    const auto now = Clock::now();
    const std::chrono::duration<double> elapsed = now - last_;
    last_ = now;
    return elapsed.count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_STOPWATCH_H_
