// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What the pose of a peer is worth by our measure. Other libraries say little
// of their answer, and give the identity for a failure: here a pose that fewer
// than three matches agree with is no answer.

#ifndef QUATRO_EXPERIMENTS_PEERS_PEER_SUMMARY_H_
#define QUATRO_EXPERIMENTS_PEERS_PEER_SUMMARY_H_

#include <functional>
#include <string>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "robust/estimators/pose_summary.h"

namespace quatro {

// Calls `solve` for target_from_source, if there are three finite matches, and
// counts those within the noise bound [m]. `library` is for messages, `stage`
// for the time. An exception of the library is no answer.
PoseSummary SolveByPeer(const PointsRef& source,
                        const PointsRef& target,
                        double noise_bound,
                        const std::string& library,
                        const std::string& stage,
                        const std::function<Rigid3()>& solve);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PEERS_PEER_SUMMARY_H_
