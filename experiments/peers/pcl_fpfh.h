// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// PCL's descriptors of the same points and normals, for comparison and as a
// test oracle for features/fpfh.h. Built only with -DQUATRO_WITH_PCL=ON.
//
// They differ from ours by definition in three ways. Neighbors are weighted by
// one over the squared distance instead of the distance. The point's own
// histogram is not added. Each of the three parts is scaled to a sum of 100.
// PCL computes in single precision.

#ifndef QUATRO_EXPERIMENTS_PEERS_PCL_FPFH_H_
#define QUATRO_EXPERIMENTS_PEERS_PCL_FPFH_H_

#include "features/base/types.h"
#include "features/fpfh.h"

namespace quatro {

// One column per point; zero for a point without a normal and where PCL returns
// none. `normals` are unit or zero, `radius` is in [m].
Fpfh ComputeFpfhByPcl(const Points& points,
                      const Points& normals,
                      double radius);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PEERS_PCL_FPFH_H_
