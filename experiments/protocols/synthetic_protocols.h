// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Tables of how estimators do on the families of
// experiments/simulator/synthetic.h.

#ifndef QUATRO_EXPERIMENTS_PROTOCOLS_SYNTHETIC_PROTOCOLS_H_
#define QUATRO_EXPERIMENTS_PROTOCOLS_SYNTHETIC_PROTOCOLS_H_

#include <functional>

#include "experiments/tables/table.h"

namespace quatro {

// Called with the problems solved so far and in all.
using Progress = std::function<void(int num_done, int num_problems)>;

// Times the kinds of problems of any protocol it is an int still.
inline constexpr int kMaxSeeds = 1'000'000;

// The surrogates of truncated least squares over the residual, for the figure.
Table TabulateSurrogates();

// Yaw from TIMs at 95, 98 and 99 % outliers: GNC beside the exact sweep.
Table RunTimProtocol(int num_seeds, const Progress& progress);

// 50 matches of which 1, 2, 3 or 5 are true: the paper's degeneracy.
Table RunDegeneracyProtocol(int num_seeds, const Progress& progress);

// 500 matches, 20 true and 20, 60 or 180 right in xy and wrong in z.
Table RunQuasiInlierProtocol(int num_seeds, const Progress& progress);

// Arc consensus from a thousand to `max_num_matches`, at 95 and 99 %.
Table RunSizeProtocol(int num_seeds,
                      long max_num_matches,
                      int num_threads,
                      const Progress& progress);

// Slopes of 2, 5, 10 and 15 deg with an INS that is off by 0.3 deg: Quatro
// without and with it, in its three ways, without and with the polish.
Table RunSlopeProtocol(int num_seeds, const Progress& progress);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_SYNTHETIC_PROTOCOLS_H_
