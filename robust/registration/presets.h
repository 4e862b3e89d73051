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
//   paper        the paper's options for 64 beams outdoors: 0.3, 0.5 and
//                0.65 m; c = 0.15 m for points and for differences; mu starts
//                from the residuals before any fit. No extensions. Also called
//                kitti_paper.
//   reference    the authors' later code: 0.3, 0.5 and 0.75 m; c = 0.3 m,
//                doubled for differences; mu starts from the residuals of the
//                plain fit. No extensions.
//   indoor       16 beams indoors: the paper's voxels for NAVER LABS, 0.1 m;
//                the other lengths are in proportion as in kitti.
std::vector<std::string> PresetNames();

// Returns nullopt for any other name.
std::optional<RegistrationOptions> MakePreset(const std::string& name);

// Options for these clouds. The voxel size comes from their density and extent
// (auto_voxel_size.h); clouds without one get 0.3 m.
RegistrationOptions MakeAutoOptions(const PointCloud& source,
                                    const PointCloud& target);

// Options for a given voxel size > 0 [m]. The other lengths are in proportion
// as in kitti. If no pose is registered, 2 and 3.5 times these lengths are
// tried, each also with verticals from the scans. The pose is refined by
// VG-ICP.
RegistrationOptions MakeAutoOptions(double voxel_size);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_PRESETS_H_
