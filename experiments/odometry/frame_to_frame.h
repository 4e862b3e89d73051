// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Odometry from any registration of two clouds. Each scan is registered to the
// last tracked scan,
//
//   world_from_scan = world_from_last last_from_scan.                      (1)

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_FRAME_TO_FRAME_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_FRAME_TO_FRAME_H_

#include <functional>
#include <optional>
#include <string>

#include "experiments/odometry/odometry.h"
#include "experiments/programs/methods.h"
#include "features/base/rigid3.h"
#include "features/io/point_cloud.h"
#include "robust/registration/registration.h"

namespace quatro {

struct FrameAlignment {
  std::optional<Rigid3> target_from_source;
  std::string message;
};

// A global method ignores the guess.
using FrameAligner =
    std::function<FrameAlignment(const PointCloud& source,
                                 const PointCloud& target,
                                 const Rigid3& target_from_source_guess)>;

// Aligns frames by a method on clouds. The pose is used whatever its status, as
// in the paper's table; the message contains the verdict. Local methods start
// from the guess.
FrameAligner MakeFrameAligner(PairSolver solver,
                              const RegistrationOptions& options);

class FrameToFrame : public Odometry {
 public:
  explicit FrameToFrame(FrameAligner aligner);

 private:
  TrackResult Start(const PointCloud& scan) override;
  TrackResult Track(const PointCloud& scan,
                    const Rigid3& world_from_scan_guess) override;

  FrameAligner aligner_;
  PointCloud last_;
  Rigid3 world_from_last_;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_FRAME_TO_FRAME_H_
