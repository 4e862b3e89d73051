// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/options_json.h"

#include <cmath>
#include <variant>

#include "robust/registration/methods.h"

namespace quatro {
namespace {

Json NumberOrNull(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

struct ValueOfField {
  template <typename Number>
  Json operator()(const Number* value) const {
    return *value;
  }
  Json operator()(const double* value) const { return NumberOrNull(*value); }
  Json operator()(const Eigen::Vector3d* value) const {
    return {value->x(), value->y(), value->z()};
  }
  Json operator()(const Rigid3* value) const { return Rows(*value); }
  Json operator()(const AttitudeField& field) const {
    const Attitude& attitude = *field.attitude;
    return {attitude.roll, attitude.pitch, attitude.yaw};
  }
  Json operator()(const DegreesField& field) const {
    return NumberOrNull(*field.radians / (M_PI / 180.0));
  }
  Json operator()(const Choice& choice) const {
    return choice.names[choice.get()];
  }
};

}  // namespace

Json DescribeOptions(const OptionList& options) {
  Json values = Json::object();
  for (const Option& option : options) {
    if (option.name == "num_threads") continue;
    values[option.name] = std::visit(ValueOfField(), option.field);
  }
  return values;
}

Json DescribeOptions(const std::string& method,
                     bool has_clouds,
                     RegistrationOptions options) {
  std::string ignored;
  const Method* found = FindMethod(method, &ignored);
  if (found != nullptr) {
    if (found->adjust != nullptr) found->adjust(&options);
    return DescribeOptions(OptionsOf(*found, has_clouds, &options));
  }
  Json values = DescribeOptions(CommonOptions(&options));
  if (has_clouds) values.update(DescribeOptions(FrontEndOptionList(&options)));
  values.update(DescribeOptions(InsOptionList(&options)));
  values.update(DescribeOptions(BoundsOptionList(&options)));
  return values;
}

}  // namespace quatro
