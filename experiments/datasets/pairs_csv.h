// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A list of pairs, as quatro_simulate writes it (pair_files.h) and as others
// have it: a CSV whose first line names the columns, in any order,
//
//   source,target           files, relative to the list's folder
//   set                     may be missing: the list's own name
//   tx,ty,tz,qx,qy,qz,qw    target_from_source [m]; all or none of them. Empty
//                           or missing: the scans share no place
//   source_rpy_deg,target_rpy_deg,ins_std_deg
//                           the INS: "roll,pitch,yaw" of each scan and the
//                           standard deviation of each angle; empty: none
//
// Other columns are passed over.

#ifndef QUATRO_EXPERIMENTS_DATASETS_PAIRS_CSV_H_
#define QUATRO_EXPERIMENTS_DATASETS_PAIRS_CSV_H_

#include <optional>
#include <string>

#include "experiments/datasets/pair_selection.h"

namespace quatro {

// In the order of the file, of bin "all"; a task's name is "<set>/<row>", rows
// counted from 1 in the file. Nullopt with one line in *error, which names the
// file, the line and the column, for anything else than the above. Scans that
// are missing are counted and noted.
std::optional<PairSelection> ReadPairsCsv(const std::string& path,
                                          std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_PAIRS_CSV_H_
