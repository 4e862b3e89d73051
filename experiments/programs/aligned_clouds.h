// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The clouds in one frame, the target's, once the pose between them is known.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_ALIGNED_CLOUDS_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_ALIGNED_CLOUDS_H_

#include <optional>
#include <string>

#include "features/base/rigid3.h"
#include "features/io/point_cloud.h"

namespace quatro {

// The file of --output and the clouds of --output_clouds.
struct AlignedOutput {
  std::string path;  // Empty: none is asked for.

  // "source": moved, with its intensities. "both": the source moved and then
  // the target, with intensity 0 for the source and 1 for the target.
  std::string clouds = "source";

  // Returns false and says which flag is wrong and why in *error.
  bool IsValid(std::string* error) const;

  // The file's bytes; nullopt with *error set if the format cannot hold them.
  std::optional<std::string> Format(const PointCloud& source,
                                    const PointCloud& target,
                                    const Rigid3& target_from_source,
                                    std::string* error) const;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_ALIGNED_CLOUDS_H_
