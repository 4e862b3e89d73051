// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What figures are drawn from: recall over the error that is allowed, and how
// the relative roll-pitch and yaw of pairs are spread.

#ifndef QUATRO_EXPERIMENTS_TABLES_CURVE_TABLES_H_
#define QUATRO_EXPERIMENTS_TABLES_CURVE_TABLES_H_

#include <vector>

#include "experiments/metrics/pair_result.h"
#include "experiments/tables/table.h"

namespace quatro {

// Columns error ("translation m" or "rotation deg"), at most, and the share of
// pairs of each method [%]; 0 to 3 m by 0.05 m, then 0 to 15 deg by 0.25 deg.
Table MakeRecallTable(const std::vector<PairResult>& results);

// Columns angle ("tilt" or "yaw"), from and to [deg], pairs. Every pair with
// truth counts once, whatever the methods; tilt by 0.25 deg up to the largest,
// |yaw| by 10 deg up to 180.
Table MakeTiltTable(const std::vector<PairResult>& results);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_CURVE_TABLES_H_
