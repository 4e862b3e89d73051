// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The flags of quatro_experiment and their values. Functions return nullopt if
// a flag is invalid, with the flag and the reason in *error.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_EXPERIMENT_FLAGS_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_EXPERIMENT_FLAGS_H_

#include <gflags/gflags.h>

#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/sequence_data.h"
#include "experiments/protocols/protocols.h"
#include "experiments/runner/manifest.h"
#include "experiments/runner/own_method.h"
#include "experiments/runner/run_task.h"
#include "robust/registration/registration.h"

DECLARE_string(protocol);
DECLARE_string(output);
DECLARE_string(methods);
DECLARE_bool(list_methods);
DECLARE_string(bins);
DECLARE_int32(min_frame_gap);
DECLARE_double(min_path);
DECLARE_double(min_pair_spacing);
DECLARE_int32(max_frames);
DECLARE_int32(point_floats);
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

// Splits "a,b,c" into names.
std::vector<std::string> SplitNames(const std::string& text);

// The options of --preset for all methods, with one thread each.
std::optional<RegistrationOptions> OptionsOfFlags(std::string* error);

std::optional<std::vector<int>> IntervalsOfFlags(std::string* error);

// The methods of --methods and their options; names in `own` are accepted too.
std::optional<RunMethods> MethodsOfFlags(const std::vector<OwnMethod>& own,
                                         std::string* error);

std::optional<std::vector<SequenceData>> DrivesOfFlags(std::string* error);

// The pairs that --protocol registers.
std::optional<PairSelection> TasksOfFlags(std::string* error);

// Contains everything on which a run depends.
Manifest ManifestOfFlags();

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_EXPERIMENT_FLAGS_H_
