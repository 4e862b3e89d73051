// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "python/options.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "python/arguments.h"
#include "python/arrays.h"

namespace quatro {
namespace {

namespace py = pybind11;

// Sets the field of an option from a Python value.
class Setter {
 public:
  Setter(const std::string& name, const py::handle& value)
      : name_(name), value_(value) {}

  void operator()(double* field) const {
    if (py::isinstance<py::bool_>(value_) || !PyNumber_Check(value_.ptr())) {
      Refuse("a number");
    }
    *field = PyFloat_AsDouble(value_.ptr());
    if (!PyErr_Occurred()) return;
    PyErr_Clear();  // A complex number, or an array of several.
    Refuse("a number");
  }

  void operator()(bool* field) const {
    const bool is_numpys =
        std::string(Py_TYPE(value_.ptr())->tp_name) == "numpy.bool_" ||
        std::string(Py_TYPE(value_.ptr())->tp_name) == "numpy.bool";
    if (!py::isinstance<py::bool_>(value_) && !is_numpys) {
      Refuse("True or False");
    }
    *field = PyObject_IsTrue(value_.ptr()) == 1;
  }

  template <typename Integer>
  void operator()(Integer* field) const {
    if (py::isinstance<py::bool_>(value_) || !PyIndex_Check(value_.ptr())) {
      Refuse("an integer");
    }
    try {
      *field =
          py::int_(py::reinterpret_borrow<py::object>(value_)).cast<Integer>();
    } catch (const py::cast_error&) {
      throw py::value_error(
          name_ + " = " + Shown(value_) + ", must be from " +
          std::to_string(std::numeric_limits<Integer>::min()) + " to " +
          std::to_string(std::numeric_limits<Integer>::max()));
    }
  }

  void operator()(Eigen::Vector3d* field) const {
    const auto array =
        py::array_t<double, py::array::forcecast>::ensure(value_);
    if (!array) PyErr_Clear();
    if (!array || array.ndim() != 1 || array.shape(0) != 3) {
      Refuse("three numbers");
    }
    *field << array.at(0), array.at(1), array.at(2);
  }

  void operator()(const AttitudeField& field) const {
    Eigen::Vector3d angles;
    (*this)(&angles);
    *field.attitude = {angles.x(), angles.y(), angles.z()};
  }

  void operator()(const DegreesField& field) const {
    double degrees = 0.0;
    (*this)(&degrees);
    *field.radians = degrees * M_PI / 180.0;
  }

  void operator()(Rigid3* field) const {
    const auto array = py::array::ensure(value_);
    if (!array) PyErr_Clear();
    if (!array || array.dtype().kind() == 'O') Refuse("a (4, 4) array");
    *field =
        PoseArgument(py::reinterpret_borrow<py::object>(value_), name_.c_str());
  }

  void operator()(const Choice& choice) const {
    std::string names;
    for (const std::string& name : choice.names) {
      names += (names.empty() ? "" : ", ") + name;
    }
    if (!py::isinstance<py::str>(value_)) {
      Refuse("one of " + names +
             (name_ == "gravity" ? "; a direction is up=(x, y, z)" : ""));
    }
    const auto given = value_.cast<std::string>();
    const auto found =
        std::find(choice.names.begin(), choice.names.end(), given);
    if (found == choice.names.end()) {
      throw py::value_error(name_ + " = \"" + given + "\", must be one of " +
                            names);
    }
    choice.set(static_cast<std::size_t>(found - choice.names.begin()));
  }

 private:
  [[noreturn]] void Refuse(const std::string& wanted) const {
    throw py::type_error(name_ + " = " + Shown(value_) + ", must be " + wanted);
  }

  const std::string& name_;
  const py::handle& value_;
};

// The option that was probably meant, or else the names of all.
std::string HintAtOptions(const std::string& name,
                          const OptionList& options,
                          const std::string& function) {
  constexpr double kSimilar = 0.75;
  py::list names;
  for (const Option& option : options) names.append(option.name);
  const py::list nearest = py::module_::import("difflib").attr(
      "get_close_matches")(name, names, 1, kSimilar);
  if (!nearest.empty()) {
    return ", did you mean " + nearest[0].cast<std::string>() +
           "? help(quatro." + function.substr(0, function.find('(')) +
           ") lists all";
  }
  return ", must be one of " +
         py::str(", ").attr("join")(names).cast<std::string>();
}

}  // namespace

void Apply(const py::dict& given,
           const OptionList& options,
           const std::string& function) {
  for (const auto& [key, value] : given) {
    const auto name = key.cast<std::string>();
    const auto option =
        std::find_if(options.begin(), options.end(), [&](const Option& known) {
          return known.name == name;
        });
    if (option != options.end()) {
      std::visit(Setter(name, value), option->field);
      continue;
    }
    throw py::type_error(function + " has no option " + name +
                         HintAtOptions(name, options, function));
  }
}

std::string Describe(const OptionList& options) {
  std::string text;
  for (const Option& option : options) {
    text += "  " + option.name + "  " + option.Describe() + ".\n";
  }
  return text;
}

}  // namespace quatro
