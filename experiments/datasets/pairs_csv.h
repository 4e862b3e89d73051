// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A list of pairs, written by quatro_simulate (pair_files.h) or by others. It
// is a CSV file whose first line names the columns, in any order:
//
//   source,target           files, relative to the list's folder
//   set                     optional; default: the list's name
//   tx,ty,tz,qx,qy,qz,qw    target_from_source, within +-1e9 m; all or none of
//                           the columns. Empty cells: the scans share no place.
//                           No columns: the true pose is unknown, so that no
//                           answer counts as correct or incorrect, unless
//                           `apart` is set
//   apart                   optional, for lists without poses; not empty: the
//                           scans share no place
//   source_rpy_deg,target_rpy_deg,ins_std_deg
//                           the INS: "roll,pitch,yaw" of each scan and the
//                           standard deviation of each angle [deg]; empty: no
//                           INS
//
// Other columns are ignored.

#ifndef QUATRO_EXPERIMENTS_DATASETS_PAIRS_CSV_H_
#define QUATRO_EXPERIMENTS_DATASETS_PAIRS_CSV_H_

#include <optional>
#include <string>

#include "experiments/datasets/pair_selection.h"

namespace quatro {

// Pairs in the order of the file, with bin "all". A task's name is
// "<set>/<row>", with rows counted from 1 in the file. Returns nullopt with one
// line in *error, which names file, line and column, if the list is invalid.
// Missing scans are counted and noted.
std::optional<PairSelection> ReadPairsCsv(const std::string& path,
                                          std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_PAIRS_CSV_H_
