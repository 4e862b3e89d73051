// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Opens the drives of a folder (any_sequence.h) or the pairs of a list:
// pairs_csv.h for names that end in .csv, kitti_pair_list.h for all others.

#ifndef QUATRO_EXPERIMENTS_DATASETS_OPEN_DATASET_H_
#define QUATRO_EXPERIMENTS_DATASETS_OPEN_DATASET_H_

#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/pair_selection.h"
#include "experiments/datasets/sequence_data.h"

namespace quatro {

struct DatasetOptions {
  std::string folder;                  // Contains one or several drives.
  std::vector<std::string> sequences;  // Names; empty: all.

  // The file of true poses if there is only one drive, for KITTI odometry;
  // empty: the data set's own.
  std::string poses;
};

// Returns nullopt with one line in *error if there are no drives, or if one
// cannot be read.
std::optional<std::vector<SequenceData>> OpenDataset(
    const DatasetOptions& options, std::string* error);

// `folder` contains the sequences that a list of KITTI pairs refers to. It is
// ignored for a .csv list, which names its scan files. Returns nullopt with one
// line in *error if the list is invalid.
std::optional<PairSelection> OpenPairList(const std::string& list,
                                          const std::string& folder,
                                          std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_OPEN_DATASET_H_
