// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Methods of other libraries, for comparison. None is built in by default.

#ifndef QUATRO_EXPERIMENTS_PEERS_PEER_METHODS_H_
#define QUATRO_EXPERIMENTS_PEERS_PEER_METHODS_H_

#include <string>
#include <vector>

#include "features/io/point_cloud.h"
#include "robust/estimators/pose_summary.h"
#include "robust/estimators/quatro.h"
#include "robust/registration/options.h"
#include "robust/registration/summary.h"

namespace quatro {

// Works on matched points (`make`) or on clouds (`register_clouds`).
struct PeerMethod {
  std::string name;
  std::string description;
  PoseSolver (*make)(const QuatroOptions& options) = nullptr;
  RegistrationSummary (*register_clouds)(const PointCloud& source,
                                         const PointCloud& target,
                                         const RegistrationOptions& options) =
      nullptr;
};

const std::vector<PeerMethod>& PeerMethods();

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PEERS_PEER_METHODS_H_
