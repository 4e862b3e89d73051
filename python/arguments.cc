// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "python/arguments.h"

#include <algorithm>

namespace quatro {
namespace {

namespace py = pybind11;

constexpr std::size_t kMaxShown = 80;  // Characters of a value.

}  // namespace

std::string Shown(const py::handle& value) {
  const py::object words = py::repr(value).attr("split")();
  const py::object line = py::str(" ").attr("join")(words);
  if (py::len(line) <= kMaxShown) return line.cast<std::string>();
  return line[py::slice(0, kMaxShown, 1)].cast<std::string>() + "...";
}

std::vector<py::object> TakeArguments(const std::string& doc,
                                      const std::vector<Parameter>& parameters,
                                      std::size_t num_positional,
                                      const py::args& positional,
                                      const py::kwargs& named,
                                      py::dict* further) {
  const std::string function = doc.substr(0, doc.find('('));
  const auto refuse = [&](const std::string& problem) {
    throw py::type_error(function + "() " + problem + "; call it as " +
                         doc.substr(0, doc.find('\n')));
  };
  if (positional.size() > num_positional) {
    refuse("takes at most " + std::to_string(num_positional) +
           (num_positional == 1 ? " argument" : " arguments") +
           " without a name, not " + std::to_string(positional.size()));
  }
  std::vector<py::object> values;
  for (const Parameter& parameter : parameters) {
    const std::size_t i = values.size();
    const bool is_named = named.contains(parameter.name);
    if (i < positional.size()) {
      if (is_named)
        refuse("was given " + std::string(parameter.name) + " twice");
      values.push_back(positional[i]);
    } else if (is_named) {
      values.push_back(named[parameter.name]);
    } else if (parameter.fallback) {
      values.push_back(parameter.fallback);
    } else {
      refuse("needs " + std::string(parameter.name));
    }
  }
  for (const auto& [key, value] : named) {
    const auto name = key.cast<std::string>();
    const bool is_parameter = std::any_of(
        parameters.begin(), parameters.end(), [&](const Parameter& parameter) {
          return name == parameter.name;
        });
    if (is_parameter) continue;
    if (further == nullptr) refuse("has no argument " + name);
    (*further)[key] = value;
  }
  return values;
}

}  // namespace quatro
