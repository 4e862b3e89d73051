// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Open3D's descriptors of the same points and normals, to compare with and as
// an oracle of features/fpfh.h. Built with -DQUATRO_WITH_OPEN3D=ON alone.
//
// Theirs differ by definition in two things. Neighbours are weighted by one
// over the squared distance, not the distance, and their sum is scaled to 100
// in each of the three parts before the point's own histogram, of 100 too, is
// added.

#ifndef QUATRO_EXPERIMENTS_PEERS_OPEN3D_FPFH_H_
#define QUATRO_EXPERIMENTS_PEERS_OPEN3D_FPFH_H_

#include "features/base/types.h"
#include "features/fpfh.h"

namespace quatro {

// A column a point. Zero for a point without a normal. `normals` are unit or
// zero, `radius` [m].
Fpfh ComputeFpfhByOpen3d(const Points& points,
                         const Points& normals,
                         double radius);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PEERS_OPEN3D_FPFH_H_
