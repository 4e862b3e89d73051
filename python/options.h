// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Options by name, as given in Python. Each has a line of text with its unit
// and meaning, and the field that it sets. The library checks whether a value
// is in range.

#ifndef QUATRO_PYTHON_OPTIONS_H_
#define QUATRO_PYTHON_OPTIONS_H_

#include <pybind11/pybind11.h>

#include <functional>
#include <string>
#include <vector>

#include "robust/estimators/arc_consensus.h"
#include "robust/estimators/fgr.h"
#include "robust/estimators/quatro.h"
#include "robust/estimators/ransac.h"
#include "robust/estimators/teaser.h"
#include "robust/registration/ins.h"
#include "robust/registration/registration.h"
#include "solvers/local/local_alignment.h"
#include "solvers/local/vgicp.h"

namespace quatro {

struct Option {
  std::string name;
  std::string text;  // Unit and meaning.
  std::function<void(const pybind11::handle& value)> set;
};

using OptionList = std::vector<Option>;

// Creates an option that sets a field. Throws TypeError, with the option's
// name, for a value of another type, and ValueError for an integer that does
// not fit into the field.
Option MakeOption(std::string name, std::string text, double* field);
Option MakeOption(std::string name, std::string text, bool* field);
Option MakeOption(std::string name, std::string text, int* field);
Option MakeOption(std::string name, std::string text, std::int64_t* field);
Option MakeOption(std::string name, std::string text, std::uint64_t* field);
Option MakeOption(std::string name, std::string text, Eigen::Vector3d* field);

// The options of each struct, which must outlive the list. OptionsOfExact()
// excludes the options of GNC.
OptionList OptionsOf(QuatroOptions* options);
OptionList OptionsOfExact(QuatroOptions* options);
OptionList OptionsOf(ArcConsensusOptions* options);
OptionList OptionsOf(TeaserOptions* options);
OptionList OptionsOf(FgrOptions* options);
OptionList OptionsOf(RansacOptions* options);
OptionList OptionsOf(InsOptions* options);
OptionList OptionsOf(FrontEndOptions* options);
OptionList OptionsOf(RefinementOptions* options);
OptionList OptionsOf(LocalAlignmentOptions* options);

// Sets all given options. Throws TypeError for a name that is not in the list;
// `function` is the name of the called function.
void Apply(const pybind11::dict& given,
           const OptionList& options,
           const std::string& function);

// One paragraph per option, for docstrings.
std::string Describe(const OptionList& options);

}  // namespace quatro

#endif  // QUATRO_PYTHON_OPTIONS_H_
