// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// PCL's descriptors of the same points and normals, to compare with and as
// an oracle of features/fpfh.h. Built with -DQUATRO_WITH_PCL=ON alone.
//
// Theirs differ by definition in three things. Neighbours are weighted by one
// over the squared distance, not the distance; the point's own histogram is not
// added; and each of the three parts is scaled to a sum of 100. PCL computes in
// single precision.

#ifndef QUATRO_EXPERIMENTS_PEERS_PCL_FPFH_H_
#define QUATRO_EXPERIMENTS_PEERS_PCL_FPFH_H_

#include "features/base/types.h"
#include "features/fpfh.h"

namespace quatro {

// A column a point. Zero for a point without a normal and where PCL gives none.
// `normals` are unit or zero, `radius` [m].
Fpfh ComputeFpfhByPcl(const Points& points,
                      const Points& normals,
                      double radius);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PEERS_PCL_FPFH_H_
