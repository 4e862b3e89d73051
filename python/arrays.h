// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Points as NumPy has them: N rows of x, y, z in C order lie in memory as the
// 3xN columns of features/base/types.h, so that neither way needs a copy.

#ifndef QUATRO_PYTHON_ARRAYS_H_
#define QUATRO_PYTHON_ARRAYS_H_

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "features/io/point_cloud.h"

namespace quatro {

// An (N, 3) array that is given, or a cloud of Open3D's. Held as it is if it is
// float64 and the three numbers of a point follow each other, in rows any
// distance apart; else as a copy. Throws ValueError, which names the argument,
// for any other shape and for what is not real numbers.
class PointsArgument {
 public:
  PointsArgument(const pybind11::object& given, const char* name);

  // Valid as long as this is; needs no lock.
  Eigen::Map<const Points, 0, Eigen::OuterStride<>> View() const;

 private:
  pybind11::array_t<double> array_;
};

// What the readers of files make of such points: those that are not finite are
// dropped and counted.
PointCloud MakeCloud(const PointsArgument& points);

// A pose given as (4, 4), its rotation within 1e-6 of one. Throws ValueError.
Rigid3 PoseArgument(const pybind11::object& given, const char* name);

// Views, read-only, of what `owner` holds.
pybind11::array ViewPoints(const Points& points, pybind11::handle owner);
pybind11::array ViewColumns(const std::vector<Eigen::Index>& columns,
                            pybind11::handle owner);

// An array that holds the points themselves.
pybind11::array TakePoints(Points points);

// Small matrices are copied. None without one.
pybind11::array Copy(const Eigen::Ref<const Eigen::MatrixXd>& matrix);
pybind11::object Copy(const std::optional<Rigid3>& pose);

}  // namespace quatro

#endif  // QUATRO_PYTHON_ARRAYS_H_
