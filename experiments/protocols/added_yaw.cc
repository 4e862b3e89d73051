// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/protocols/added_yaw.h"

#include <cmath>
#include <cstdio>
#include <string>

namespace quatro {

PairTask AddYaw(const PairTask& task, double yaw) {
  PairTask turned = task;
  turned.added_yaw += yaw;
  const Eigen::Matrix3d source_from_turned = RotationZ(-yaw);
  if (turned.true_target_from_source) {  // (1)
    turned.true_target_from_source->rotation =
        task.true_target_from_source->rotation * source_from_turned;
  }
  if (turned.ins) {  // (2)
    turned.ins->source =
        AttitudeOf(WorldFromBody(task.ins->source) * source_from_turned);
  }
  return turned;
}

std::vector<double> YawSteps(double step_deg) {
  std::vector<double> yaws;
  for (int i = 0; i * step_deg <= 180.0 + 1e-9; ++i) {
    yaws.push_back(i * step_deg * M_PI / 180.0);
    if (!(step_deg > 0.0)) break;
  }
  return yaws;
}

std::vector<PairTask> AddYaws(const std::vector<PairTask>& tasks,
                              const std::vector<double>& yaws) {
  std::vector<PairTask> turned;
  for (const double yaw : yaws) {
    char bin[40];
    std::snprintf(bin, sizeof(bin), "yaw %g deg", yaw * 180.0 / M_PI);
    for (const PairTask& task : tasks) {
      turned.push_back(AddYaw(task, yaw));
      turned.back().bin = bin;
      turned.back().name += std::string(" ") + bin;
    }
  }
  return turned;
}

}  // namespace quatro
