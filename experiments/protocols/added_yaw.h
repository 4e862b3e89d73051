// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Rotates the sources of pairs about their z axis, as the paper does to measure
// the effect of a large heading change (0, 30, ... 180 deg). With Z = R_z(yaw),
// x' = Z x are the points of the rotated source, so that
//
//   target_from_source' = target_from_source Z^-1,                        (1)
//   world_from_source'  = world_from_source Z^-1.                         (2)
//
// (1) is the true pose and (2) the INS attitude of the source. The target does
// not change.

#ifndef QUATRO_EXPERIMENTS_PROTOCOLS_ADDED_YAW_H_
#define QUATRO_EXPERIMENTS_PROTOCOLS_ADDED_YAW_H_

#include <vector>

#include "experiments/datasets/pair_task.h"

namespace quatro {

// Rotates the source of a pair by `yaw` [rad], in addition to any previously
// added yaw. Name and bin stay.
PairTask AddYaw(const PairTask& task, double yaw);

// The yaws 0, step, ... 180 deg, in radians.
std::vector<double> YawSteps(double step_deg = 30.0);

// All tasks with the first yaw, then all with the next. Bins are "yaw 90 deg",
// and names end in the same text.
std::vector<PairTask> AddYaws(const std::vector<PairTask>& tasks,
                              const std::vector<double>& yaws);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_ADDED_YAW_H_
