// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Open3D's descriptors of the same points and normals, for comparison and as a
// test oracle for features/fpfh.h. Built only with -DQUATRO_WITH_OPEN3D=ON.
//
// They differ from ours by definition in two ways. Neighbors are weighted by
// one over the squared distance instead of the distance. Their sum is scaled to
// 100 in each of the three parts before the point's own histogram, which also
// sums to 100, is added.

#ifndef QUATRO_EXPERIMENTS_PEERS_OPEN3D_FPFH_H_
#define QUATRO_EXPERIMENTS_PEERS_OPEN3D_FPFH_H_

#include "features/base/types.h"
#include "features/fpfh.h"

namespace quatro {

// One column per point; zero for a point without a normal. `normals` are unit
// or zero, `radius` is in [m].
Fpfh ComputeFpfhByOpen3d(const Points& points,
                         const Points& normals,
                         double radius);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PEERS_OPEN3D_FPFH_H_
