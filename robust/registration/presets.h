// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Sets of options that belong together.

#ifndef QUATRO_ROBUST_REGISTRATION_PRESETS_H_
#define QUATRO_ROBUST_REGISTRATION_PRESETS_H_

#include <optional>
#include <string>
#include <vector>

#include "features/io/point_cloud.h"
#include "robust/registration/options.h"

namespace quatro {

//   kitti        64 beams outdoors: voxels 0.3 m, normals 0.9 m, FPFH 1.5 m.
//   paper        the paper's for the same: 0.3, 0.5 and 0.65 m, c = 0.15 m for
//                points and their differences alike, mu started from the
//                residuals before any fit; nothing that the paper does not
//                have. Also as kitti_paper.
//   reference    the authors' later code: 0.3, 0.5 and 0.75 m, 0.3 m doubled
//                for differences, mu started from those of the plain fit.
//   indoor       16 beams indoors: the paper's voxels for NAVER LABS, 0.1 m,
//                the rest in proportion as in kitti.
std::vector<std::string> PresetNames();

// Nullopt for any other name.
std::optional<RegistrationOptions> MakePreset(const std::string& name);

// Options for these clouds, by their own density and extent: the voxel size at
// which the larger of them keeps about 15,000 points, but not below the typical
// distance between neighbours in the sparser, and enlarged, by 16 at most,
// until two thirds of the points have a surface around them within the radius
// of the normals (features/surface_share.h), which takes more where beams are
// few; the rest in proportion as in kitti. Clouds without points give preset
// kitti.
RegistrationOptions MakeAutoOptions(const PointCloud& source,
                                    const PointCloud& target);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_PRESETS_H_
