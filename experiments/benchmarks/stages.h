// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What quatro_benchmark measures. A benchmark's name is
//
//   stage/who[/case]      graph/quatro/N:1000
//
// `who` is quatro, `limit` (a machine's), or another library. Those of one
// stage and case get the same input and are there to be compared.

#ifndef QUATRO_EXPERIMENTS_BENCHMARKS_STAGES_H_
#define QUATRO_EXPERIMENTS_BENCHMARKS_STAGES_H_

#include <vector>

#include "experiments/benchmarks/pair_input.h"

namespace quatro {

// From two clouds to a pose and a verdict; Register() also by two threads.
void AddPairStages(const PairSource& pair);

// Estimators over the number of matches: those with a graph up to
// kMaxGraphSize. Memory's bandwidth, too.
constexpr int kMaxGraphSize = 50'000;
void AddSizeStages(const std::vector<int>& sizes, int num_threads);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BENCHMARKS_STAGES_H_
