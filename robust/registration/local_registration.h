// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Local registration from a guess, without matches, for comparison with global
// registration:
//
//   clouds -> voxels -> normals of the 20 nearest -> ICP, G-ICP or VG-ICP
//          -> verdict
//
// A guess is no evidence, and a local minimum looks like a correct pose. So
// chance cannot be ruled out, and the verdict is never better than ambiguous.

#ifndef QUATRO_ROBUST_REGISTRATION_LOCAL_REGISTRATION_H_
#define QUATRO_ROBUST_REGISTRATION_LOCAL_REGISTRATION_H_

#include <functional>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "features/io/point_cloud.h"
#include "robust/registration/options.h"
#include "robust/registration/refinement.h"
#include "robust/registration/summary.h"

namespace quatro {

// Aligns voxel means of options.front_end.voxel_size by options.refinement,
// whose method must not be kNone. The pose is in summary.refinement and in
// summary.solution; there are no matches. A pose outside of options.bounds is
// rejected.
RegistrationSummary RegisterLocally(const PointCloud& source,
                                    const PointCloud& target,
                                    const Rigid3& initial_target_from_source,
                                    const RegistrationOptions& options);

// Another aligner of the voxel means. It may ignore options that it does not
// know.
using CloudAligner =
    std::function<AlignmentSummary(const Points& source,
                                   const Points& target,
                                   const Rigid3& initial_target_from_source,
                                   const RefinementOptions& options)>;

// Like the function above, but with another aligner, for comparison.
RegistrationSummary RegisterLocally(const PointCloud& source,
                                    const PointCloud& target,
                                    const Rigid3& initial_target_from_source,
                                    const RegistrationOptions& options,
                                    const CloudAligner& align);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_LOCAL_REGISTRATION_H_
