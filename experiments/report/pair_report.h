// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The report of a single pair: its 3D view in more detail, without tables.

#ifndef QUATRO_EXPERIMENTS_REPORT_PAIR_REPORT_H_
#define QUATRO_EXPERIMENTS_REPORT_PAIR_REPORT_H_

#include <string>

#include "experiments/report/pair_view.h"
#include "experiments/runner/manifest.h"

namespace quatro {

// Returns the text of an HTML file. The clouds are first downsampled to voxels
// of `voxel_size` [m].
std::string FormatPairReport(ViewedPair pair,
                             double voxel_size,
                             const MethodAnswer& answer,
                             const Manifest& manifest,
                             const std::string& report_template);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_REPORT_PAIR_REPORT_H_
