// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Writes the registered clouds in the frame of the target.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_ALIGNED_CLOUDS_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_ALIGNED_CLOUDS_H_

#include <optional>
#include <string>

#include "features/base/rigid3.h"
#include "features/io/point_cloud.h"

namespace quatro {

// The file of --output and the clouds of --output_clouds.
struct AlignedOutput {
  std::string path;  // Empty: no output.

  // "source": the source in the target's frame, with its intensities. "both":
  // also the target, with intensity 0 for the source and 1 for the target.
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
