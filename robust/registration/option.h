// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// An option: a name, a type, a unit or range, a sentence that describes it, and
// the field that it sets.

#ifndef QUATRO_ROBUST_REGISTRATION_OPTION_H_
#define QUATRO_ROBUST_REGISTRATION_OPTION_H_

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "features/base/rigid3.h"
#include "solvers/closed_form/gravity.h"

namespace quatro {

// One of several names.
struct Choice {
  std::vector<std::string> names;
  std::function<std::size_t()> get;  // Index of the name that is chosen.
  std::function<void(std::size_t)> set;
};

// Roll, pitch and yaw [rad].
struct AttitudeField {
  Attitude* attitude;
};

// Degrees for users, radians in the field.
struct DegreesField {
  double* radians;
};

// An option, and the field behind it, which must outlive it.
struct Option {
  std::string name;
  std::string range;  // Unit, or the values that are allowed.
  std::string text;   // A phrase, without a period at its end.
  std::variant<bool*,
               int*,
               std::int64_t*,
               std::uint64_t*,
               double*,
               Eigen::Vector3d*,
               Rigid3*,
               AttitudeField,
               DegreesField,
               Choice>
      field;

  // The range and the text, for example "[m], > 0: edge of a voxel", followed
  // by the names of a choice.
  std::string Describe() const;

  // Sets the field from a flag's text: a number, "on" or "off", a name, three
  // numbers, or a pose as the 12 or 16 numbers of its rows, with commas between
  // them. Returns false and sets *error, which names the option, for any other
  // text. Does not check ranges; IsValid() of the options does.
  bool Parse(const std::string& text, std::string* error) const;
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_OPTION_H_
