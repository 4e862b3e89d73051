// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "python/class_parts.h"

#include <cmath>
#include <cstdio>

#include "python/arguments.h"
#include "python/arrays.h"

namespace quatro {

namespace py = pybind11;

py::object OrNone(const std::optional<double>& value) {
  if (!value) return py::none();
  return py::float_(*value);
}

py::dict Seconds(const std::vector<StageTime>& times) {
  py::dict seconds;
  for (const StageTime& time : times) {
    const py::str stage(time.stage);
    const double before =
        seconds.contains(stage) ? seconds[stage].cast<double>() : 0.0;
    seconds[stage] = before + time.seconds;
  }
  return seconds;
}

std::string Print(const char* format, double a, double b, double c, double d) {
  char text[200];
  std::snprintf(text, sizeof(text), format, a, b, c, d);
  return text;
}

std::string Describe(const Rigid3& pose) {
  const Eigen::Vector3d& t = pose.translation;
  return Print("yaw=%.2f deg, translation=(%.3f, %.3f, %.3f) m",
               Yaw(pose.rotation) / (M_PI / 180.0),
               t.x(),
               t.y(),
               t.z());
}

py::dict AsDict(const py::object& self) {
  const py::object is_property =
      py::module_::import("builtins").attr("property");
  py::dict values;
  for (const py::handle name : py::type::of(self).attr("__dict__")) {
    const py::object member = py::type::of(self).attr(name);
    if (!py::isinstance(member, is_property)) continue;
    const py::object value = self.attr(name);
    values[name] =
        py::isinstance<py::array>(value) ? value.attr("copy")() : value;
  }
  return values;
}

py::array Transform(const std::optional<Rigid3>& target_from_source,
                    const std::string& message,
                    const py::args& args,
                    const py::kwargs& named) {
  const auto given =
      TakeArguments(kTransformDoc, {{"points", {}}}, 1, args, named, nullptr);
  if (!target_from_source) {
    throw py::value_error("there is no pose to transform by: " + message);
  }
  return TakePoints(
      target_from_source->Apply(PointsArgument(given[0], "points").View()));
}

}  // namespace quatro
