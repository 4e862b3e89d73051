// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Fast Global Registration from two clouds: the front door
// (robust/registration/registration.h) with the tuple test as the program of
// its authors makes it, sides within [0.95, 1/0.95], up to a hundred triples a
// match, the first thousand that pass, and FGR (robust/estimators/fgr.h) on
// what is left.
//
// Not as in Open3D's of the same name: there a match counts as often as triples
// with it passed, here once; there the means and the extent are of all points
// of the clouds, here of the matched ones; the schedule of mu differs
// (robust/estimators/fgr.h).

#ifndef QUATRO_ROBUST_REGISTRATION_FGR_CLOUDS_H_
#define QUATRO_ROBUST_REGISTRATION_FGR_CLOUDS_H_

#include "features/io/point_cloud.h"
#include "robust/estimators/fgr.h"
#include "robust/registration/registration.h"

namespace quatro {

// `options` with that tuple test.
FrontEndOptions WithTupleTestOfFgr(FrontEndOptions options);

// The noise bound, of the verdict too, and the number of threads are those of
// `options`, whose solver and tuple test are replaced.
RegistrationSummary RegisterByFgr(const PointCloud& source,
                                  const PointCloud& target,
                                  const RegistrationOptions& options,
                                  const FgrOptions& fgr_options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_FGR_CLOUDS_H_
