// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The same pairs with sources turned about their z axis, as the paper does to
// see what a large change of heading costs (0, 30, ... 180 deg). With
// Z = R_z(yaw), x' = Z x are the points of the turned source, so that
//
//   target_from_source' = target_from_source Z^-1,                        (1)
//   world_from_source'  = world_from_source Z^-1.                         (2)
//
// (1) is the truth, (2) what the INS says of the source; the target's stays.

#ifndef QUATRO_EXPERIMENTS_PROTOCOLS_ADDED_YAW_H_
#define QUATRO_EXPERIMENTS_PROTOCOLS_ADDED_YAW_H_

#include <vector>

#include "experiments/datasets/pair_task.h"

namespace quatro {

// One pair: name and bin stay, a yaw that was added before is added to. [rad]
PairTask AddYaw(const PairTask& task, double yaw);

// 0, step, ... 180 deg, in radians.
std::vector<double> YawSteps(double step_deg = 30.0);

// All tasks for the first yaw, then for the next: bins "yaw 90 deg", names with
// the same at their end.
std::vector<PairTask> AddYaws(const std::vector<PairTask>& tasks,
                              const std::vector<double>& yaws);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_ADDED_YAW_H_
