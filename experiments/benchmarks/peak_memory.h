// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Memory that a piece of work needs at most, as the kernel sees it: the peak of
// the resident pages during the work, less those before. What the process holds
// from earlier on and can use again is given back first; some hundred kilobytes
// are noise all the same.

#ifndef QUATRO_EXPERIMENTS_BENCHMARKS_PEAK_MEMORY_H_
#define QUATRO_EXPERIMENTS_BENCHMARKS_PEAK_MEMORY_H_

#include <functional>
#include <optional>

namespace quatro {

// [bytes]. Nullopt where the kernel does not tell (Linux does).
std::optional<double> MeasurePeakMemory(const std::function<void()>& work);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BENCHMARKS_PEAK_MEMORY_H_
