// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The arguments of a Python function, with one line about what is wrong.
// pybind11's own message for wrong arguments lists all values that were given.

#ifndef QUATRO_PYTHON_ARGUMENTS_H_
#define QUATRO_PYTHON_ARGUMENTS_H_

#include <pybind11/pybind11.h>

#include <cstddef>
#include <string>
#include <vector>

namespace quatro {

// A value as one short line for a message.
std::string Shown(const pybind11::handle& value);

struct Parameter {
  const char* name;
  pybind11::object fallback;  // Null if the argument is required.
};

// Returns the argument of each parameter. The first `num_positional` may be
// given without their names. Arguments with other names are returned in
// `further`; if it is null, there must be none. `doc` begins with the signature
// in one line. Throws TypeError if an argument is missing, not known or given
// twice, or if there are too many.
std::vector<pybind11::object> TakeArguments(
    const std::string& doc,
    const std::vector<Parameter>& parameters,
    std::size_t num_positional,
    const pybind11::args& positional,
    const pybind11::kwargs& named,
    pybind11::dict* further);

}  // namespace quatro

#endif  // QUATRO_PYTHON_ARGUMENTS_H_
