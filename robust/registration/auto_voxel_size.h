// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A voxel size v for two clouds that nothing is known of. With N(v) the number
// of voxels that a cloud occupies and s(r) the share of its points that show a
// surface at radius r (features/surface_share.h), it is the least of
//
//   v >= max_k v_k,   N_k(v_k) = 15,000,
//   v >= max_k median_i min_j |p_ki - p_kj|,
//   s_k(3 v) >= 2/3 for both clouds k.
//
// The last makes most normals those of surfaces, which sensors with few beams
// need. It is dropped for a cloud where no size up to 16 times the others
// achieves it. Nothing has a unit, so the size follows the scale of the clouds.

#ifndef QUATRO_ROBUST_REGISTRATION_AUTO_VOXEL_SIZE_H_
#define QUATRO_ROBUST_REGISTRATION_AUTO_VOXEL_SIZE_H_

#include <optional>

#include "features/base/types.h"

namespace quatro {

// The size [m], rounded to two digits, so that it can be quoted. Of more than
// 500,000 points of a cloud, every k-th is used. Returns nullopt if a cloud has
// no point, points that are not finite, or no width that can be squared.
std::optional<double> AutoVoxelSize(const Points& source, const Points& target);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_AUTO_VOXEL_SIZE_H_
