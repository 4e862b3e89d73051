// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The registry of options: each has a name, a type, a unit or range, a sentence
// that describes it, and the field that it sets. Flags of programs, arguments
// in Python, JSON and help texts are all made from these lists.

#ifndef QUATRO_ROBUST_REGISTRATION_OPTION_LIST_H_
#define QUATRO_ROBUST_REGISTRATION_OPTION_LIST_H_

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "robust/registration/options.h"
#include "solvers/local/local_alignment.h"

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

  // "[m], > 0: edge of a voxel", with the names of a choice.
  std::string Describe() const;

  // Sets the field from a flag's text: a number, "on" or "off", a name, three
  // numbers, or a pose as the 12 or 16 numbers of its rows, with commas between
  // them. Returns false and sets *error, which
  // names the option, for any other text. Ranges are the library's to check.
  bool Parse(const std::string& text, std::string* error) const;
};

// Options in the order of help texts.
using OptionList = std::vector<Option>;

// Options that all methods share: noise bound, seed, threads, probability.
OptionList CommonOptions(RegistrationOptions* options);

// Options of what comes before and after the estimator.
OptionList FrontEndOptionList(RegistrationOptions* options);
OptionList RefinementOptionList(RegistrationOptions* options);
OptionList SearchOptionList(RegistrationOptions* options);
OptionList InsOptionList(RegistrationOptions* options);
OptionList BoundsOptionList(RegistrationOptions* options);

// Options of the estimators. Those of GNC are not among those of the exact yaw.
OptionList QuatroOptionList(RegistrationOptions* options);
OptionList QuatroExactOptionList(RegistrationOptions* options);
OptionList ArcConsensusOptionList(RegistrationOptions* options);
OptionList ConsensusOptionList(RegistrationOptions* options);
OptionList TeaserOptionList(RegistrationOptions* options);
OptionList FgrOptionList(RegistrationOptions* options);
OptionList RansacOptionList(RegistrationOptions* options);

// Options of local alignment by itself.
OptionList LocalAlignmentOptionList(LocalAlignmentOptions* options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_OPTION_LIST_H_
