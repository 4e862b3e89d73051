// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Evaluates the pose of another library by our criteria. Other libraries report
// little about their answer and return the identity if they fail. Here a pose
// with fewer than three inliers is no answer.

#ifndef QUATRO_EXPERIMENTS_PEERS_PEER_SUMMARY_H_
#define QUATRO_EXPERIMENTS_PEERS_PEER_SUMMARY_H_

#include <functional>
#include <string>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "robust/estimators/pose_summary.h"

namespace quatro {

// Calls `solve` for target_from_source if there are at least three matches and
// all points are finite, and counts the matches within the noise bound [m].
// `library` is used in messages, and `stage` names the time. If the library
// throws an exception, there is no answer.
PoseSummary SolveByPeer(const PointsRef& source,
                        const PointsRef& target,
                        double noise_bound,
                        const std::string& library,
                        const std::string& stage,
                        const std::function<Rigid3()>& solve);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PEERS_PEER_SUMMARY_H_
