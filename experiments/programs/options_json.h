// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Options as JSON, by their names in the registry
// (robust/registration/option_list.h).

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_OPTIONS_JSON_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_OPTIONS_JSON_H_

#include <string>

#include "experiments/programs/json_report.h"
#include "robust/registration/option_list.h"
#include "robust/registration/options.h"

namespace quatro {

// The value of each option. An infinite number is null. The number of threads
// is left out because no result depends on it.
Json DescribeOptions(const OptionList& options);

// The options that a method reads, with the values that it uses. A method that
// is not in the registry reads the options that all methods share.
Json DescribeOptions(const std::string& method,
                     bool has_clouds,
                     RegistrationOptions options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_OPTIONS_JSON_H_
