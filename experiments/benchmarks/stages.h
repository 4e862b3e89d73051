// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The stages that quatro_benchmark measures. A benchmark's name is
//
//   stage/who[/case]      graph/quatro/N:1000
//
// `who` is quatro, `limit` (the best that the machine can do, limits.h), or
// another library.
// Benchmarks of the same stage and case get the same input and can be compared.

#ifndef QUATRO_EXPERIMENTS_BENCHMARKS_STAGES_H_
#define QUATRO_EXPERIMENTS_BENCHMARKS_STAGES_H_

#include <vector>

#include "experiments/benchmarks/pair_input.h"

namespace quatro {

// All stages from two clouds to a pose and a verdict. Register() also runs with
// two threads.
void AddPairStages(const PairSource& pair);

// Estimators over the number of matches; those that build a graph run up to
// kMaxGraphSize. Also measures memory bandwidth.
constexpr int kMaxGraphSize = 50'000;
void AddSizeStages(const std::vector<int>& sizes, int num_threads);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BENCHMARKS_STAGES_H_
