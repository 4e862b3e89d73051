// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/frame_to_frame.h"

#include <utility>

#include "robust/verdict/verdict.h"

namespace quatro {

FrameAligner MakeFrameAligner(PairSolver solver,
                              const RegistrationOptions& options) {
  return [solver = std::move(solver), options](
             const PointCloud& source,
             const PointCloud& target,
             const Rigid3& guess) -> FrameAlignment {
    RegistrationOptions from_guess = options;
    from_guess.bounds.guess = guess;
    const RegistrationSummary summary =
        solver(source, target, /*matched=*/nullptr, from_guess);
    if (!summary.error.empty()) return {std::nullopt, summary.error};
    return {summary.target_from_source(),
            std::string(StatusName(summary.verdict.status)) + ": " +
                summary.verdict.reason};
  };
}

FrameToFrame::FrameToFrame(FrameAligner aligner)
    : aligner_(std::move(aligner)) {}

TrackResult FrameToFrame::Start(const PointCloud& scan) {
  last_ = scan;
  return {Rigid3{}, "the first scan"};
}

TrackResult FrameToFrame::Track(const PointCloud& scan,
                                const Rigid3& world_from_scan_guess) {
  const FrameAlignment alignment =
      aligner_(scan, last_, Inverse(world_from_last_) * world_from_scan_guess);
  if (!alignment.target_from_source) return {std::nullopt, alignment.message};
  if (!alignment.target_from_source->ToMatrix().allFinite()) {
    return {std::nullopt, "the pose is not finite"};
  }
  world_from_last_ =
      Normalized(world_from_last_ * *alignment.target_from_source);
  last_ = scan;
  return {world_from_last_, alignment.message};
}

}  // namespace quatro
