// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Two clouds and a guess, without any matches: what global registration is
// compared with.
//
//   clouds -> voxels -> normals of the 20 nearest -> ICP, G-ICP or VG-ICP
//          -> verdict
//
// A guess is no evidence, and a local minimum looks like a right pose: nothing
// rules out chance. The verdict is never better than ambiguous.

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

// By options.refinement, whose method must not be kNone, on voxel means of
// options.front_end.voxel_size. The pose found is summary.refinement's and
// summary.solution's; there are no matches. A pose outside of options.bounds is
// no answer.
RegistrationSummary RegisterLocally(const PointCloud& source,
                                    const PointCloud& target,
                                    const Rigid3& initial_target_from_source,
                                    const RegistrationOptions& options);

// Another aligner of the voxel means. Options that it does not know of are up
// to it.
using CloudAligner =
    std::function<AlignmentSummary(const Points& source,
                                   const Points& target,
                                   const Rigid3& initial_target_from_source,
                                   const RefinementOptions& options)>;

// The same by `align` in place of ours, to compare with others.
RegistrationSummary RegisterLocally(const PointCloud& source,
                                    const PointCloud& target,
                                    const Rigid3& initial_target_from_source,
                                    const RegistrationOptions& options,
                                    const CloudAligner& align);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_LOCAL_REGISTRATION_H_
