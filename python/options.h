// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The options of the registry (robust/registration/option_list.h) as Python
// gives them: by name, with a value of the field's type.

#ifndef QUATRO_PYTHON_OPTIONS_H_
#define QUATRO_PYTHON_OPTIONS_H_

#include <pybind11/pybind11.h>

#include <string>

#include "robust/registration/option_list.h"

namespace quatro {

// Sets all options that are given. Throws TypeError for a name that is not in
// the list and, with the option's name, for a value of another type, and
// ValueError for an integer that the field cannot hold; `function` is what was
// called.
void Apply(const pybind11::dict& given,
           const OptionList& options,
           const std::string& function);

// One line per option, for docstrings.
std::string Describe(const OptionList& options);

}  // namespace quatro

#endif  // QUATRO_PYTHON_OPTIONS_H_
