// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Tables of the performance of estimators on the families of
// experiments/simulator/synthetic.h.

#ifndef QUATRO_EXPERIMENTS_PROTOCOLS_SYNTHETIC_PROTOCOLS_H_
#define QUATRO_EXPERIMENTS_PROTOCOLS_SYNTHETIC_PROTOCOLS_H_

#include <functional>

#include "experiments/tables/table.h"

namespace quatro {

// Called with the number of problems solved so far and the total.
using Progress = std::function<void(int num_done, int num_problems)>;

// Small enough that the number of problems of any protocol fits into an int.
inline constexpr int kMaxSeeds = 1'000'000;

// The surrogates of truncated least squares over the residual, for the figure.
Table TabulateSurrogates();

// Yaw from TIMs at 95, 98 and 99 % outliers: GNC and the exact sweep.
Table RunTimProtocol(int num_seeds, const Progress& progress);

// 50 matches with 1, 2, 3 or 5 inliers: the paper's degeneracy.
Table RunDegeneracyProtocol(int num_seeds, const Progress& progress);

// 500 matches with 20 inliers and 20, 60 or 180 quasi-inliers.
Table RunQuasiInlierProtocol(int num_seeds, const Progress& progress);

// Arc consensus on 1000 to `max_num_matches` matches, at 95 and 99 % outliers.
Table RunSizeProtocol(int num_seeds,
                      long max_num_matches,
                      int num_threads,
                      const Progress& progress);

// Slopes of 2, 5, 10 and 15 deg with an INS whose error is 0.3 deg: Quatro
// without INS and with each of the three INS modes, without and with the
// polish.
Table RunSlopeProtocol(int num_seeds, const Progress& progress);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_SYNTHETIC_PROTOCOLS_H_
