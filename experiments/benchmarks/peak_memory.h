// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The peak memory of a piece of work, as the kernel reports it: the peak of the
// resident pages during the work minus the resident pages before it. Free
// memory of the process is given back to the kernel first. The noise is still
// some hundred kilobytes.

#ifndef QUATRO_EXPERIMENTS_BENCHMARKS_PEAK_MEMORY_H_
#define QUATRO_EXPERIMENTS_BENCHMARKS_PEAK_MEMORY_H_

#include <functional>
#include <optional>

namespace quatro {

// Returns [bytes], or nullopt if the kernel does not report it (Linux does).
std::optional<double> MeasurePeakMemory(const std::function<void()>& work);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BENCHMARKS_PEAK_MEMORY_H_
