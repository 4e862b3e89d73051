// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Parts that the Python classes of results share.

#ifndef QUATRO_PYTHON_CLASS_PARTS_H_
#define QUATRO_PYTHON_CLASS_PARTS_H_

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/stopwatch.h"

namespace quatro {

// A float, or None.
pybind11::object OrNone(const std::optional<double>& value);

// The time of each stage [s]. Stages of one name are added.
pybind11::dict Seconds(const std::vector<StageTime>& times);

// Formats up to four numbers.
std::string Print(
    const char* format, double a, double b = 0, double c = 0, double d = 0);

// "yaw=1.00 deg, translation=(1.000, 2.000, 3.000) m"
std::string Describe(const Rigid3& pose);

// All properties by name. Views are copied.
pybind11::dict AsDict(const pybind11::object& self);

inline constexpr char kAsDictDoc[] =
    "dict: all properties by name, for a table or another process; "
    "arrays are copies. Can be pickled.";

// The points, given as the only argument, moved by the pose. Raises ValueError
// with `message` if there is no pose.
pybind11::array Transform(const std::optional<Rigid3>& target_from_source,
                          const std::string& message,
                          const pybind11::args& args,
                          const pybind11::kwargs& named);

inline constexpr char kTransformDoc[] =
    "transform(points)\n--\n\n"
    "(N, 3) points of the source in the target's frame [m], as float64. Raises "
    "ValueError\nif there is no pose.";

}  // namespace quatro

#endif  // QUATRO_PYTHON_CLASS_PARTS_H_
