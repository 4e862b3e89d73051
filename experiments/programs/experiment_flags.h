// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The flags of quatro_experiment, and what they stand for. Nullopt, with *error
// set to what is wrong with which flag.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_EXPERIMENT_FLAGS_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_EXPERIMENT_FLAGS_H_

#include <gflags/gflags.h>

#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/sequence_data.h"
#include "experiments/programs/own_method.h"
#include "experiments/protocols/protocols.h"
#include "experiments/runner/manifest.h"
#include "experiments/runner/run_task.h"
#include "robust/registration/registration.h"

DECLARE_string(protocol);
DECLARE_string(output);
DECLARE_string(methods);
DECLARE_bool(list_methods);
DECLARE_string(bins);
DECLARE_int32(min_frame_gap);
DECLARE_double(min_path);
DECLARE_int32(max_frames);
DECLARE_string(limits);
DECLARE_uint64(seed);
DECLARE_string(shard);
DECLARE_bool(merge);
DECLARE_double(outliers);
DECLARE_int32(seeds);
DECLARE_int64(max_matches);
DECLARE_int32(report_views);
DECLARE_int32(threads);

namespace quatro {

// The names in "a,b,c".
std::vector<std::string> SplitNames(const std::string& text);

// Of --preset, for all methods: one thread each.
std::optional<RegistrationOptions> OptionsOfFlags(std::string* error);

std::optional<std::vector<int>> IntervalsOfFlags(std::string* error);

// Of --methods and what is an option of theirs; `own` may be among the names.
std::optional<RunMethods> MethodsOfFlags(const std::vector<OwnMethod>& own,
                                         std::string* error);

std::optional<std::vector<SequenceData>> DrivesOfFlags(std::string* error);

// The pairs that --protocol registers.
std::optional<PairSelection> TasksOfFlags(std::string* error);

// With all that a run depends on.
Manifest ManifestOfFlags();

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_EXPERIMENT_FLAGS_H_
