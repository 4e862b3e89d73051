// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The report of a single pair: its 3D view in more detail, no tables.

#ifndef QUATRO_EXPERIMENTS_REPORT_PAIR_REPORT_H_
#define QUATRO_EXPERIMENTS_REPORT_PAIR_REPORT_H_

#include <string>

#include "experiments/report/pair_view.h"
#include "experiments/runner/manifest.h"

namespace quatro {

// The page, an HTML file's text. Of the pair, the clouds are thinned to their
// voxels of `voxel_size` [m] first.
std::string FormatPairReport(ViewedPair pair,
                             double voxel_size,
                             const MethodAnswer& answer,
                             const Manifest& manifest,
                             const std::string& report_template);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_REPORT_PAIR_REPORT_H_
