// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Data for figures: recall over the allowed error, and distributions of the
// relative tilt and yaw of pairs.

#ifndef QUATRO_EXPERIMENTS_TABLES_CURVE_TABLES_H_
#define QUATRO_EXPERIMENTS_TABLES_CURVE_TABLES_H_

#include <vector>

#include "experiments/metrics/pair_result.h"
#include "experiments/tables/table.h"

namespace quatro {

// Columns: error ("translation m" or "rotation deg"), at most, and the share of
// pairs per method [%]; 0 to 3 m in steps of 0.05 m, then 0 to 15 deg in steps
// of 0.25 deg.
Table MakeRecallTable(const std::vector<PairResult>& results);

// Columns: angle ("tilt" or "yaw"), from and to [deg], pairs. Every pair with a
// true pose counts once, for any number of methods. Tilt has bins of 0.25 deg
// up to the largest value, |yaw| bins of 10 deg up to 180.
Table MakeTiltTable(const std::vector<PairResult>& results);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_CURVE_TABLES_H_
