// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The drives of a folder (any_sequence.h), or the pairs of a list: one that
// ends in .csv is of pairs_csv.h, any other of kitti_pair_list.h.

#ifndef QUATRO_EXPERIMENTS_DATASETS_OPEN_DATASET_H_
#define QUATRO_EXPERIMENTS_DATASETS_OPEN_DATASET_H_

#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/pair_selection.h"
#include "experiments/datasets/sequence_data.h"

namespace quatro {

struct DatasetOptions {
  std::string folder;                  // Of one drive, or of several.
  std::vector<std::string> sequences;  // Their names; empty: all there are.

  // File of true poses of the one drive, of KITTI odometry; empty: the data
  // set's own.
  std::string poses;
};

// Nullopt with one line in *error if there are none, or one can't be read.
std::optional<std::vector<SequenceData>> OpenDataset(
    const DatasetOptions& options, std::string* error);

// `folder`: that of the sequences which a list of KITTI pairs names; empty for
// one that names its scans itself. Nullopt with one line in *error.
std::optional<PairSelection> OpenPairList(const std::string& list,
                                          const std::string& folder,
                                          std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_OPEN_DATASET_H_
