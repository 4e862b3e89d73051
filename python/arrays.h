// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Points in NumPy's layout: N rows of x, y, z in C order have the same memory
// layout as the 3xN columns of features/base/types.h, so no copy is needed in
// either direction.

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

// Whether this is the name of a file: a str, bytes or os.PathLike.
bool IsPath(const pybind11::object& given);

// A given (N, 3) array or an Open3D cloud. It is used without a copy if it is
// float64 and the three numbers of a point are contiguous, with any distance
// between rows; otherwise it is copied. Throws ValueError, which names the
// argument, for any other shape, for values that are not real numbers and for
// masked entries, and TypeError for the name of a file.
class PointsArgument {
 public:
  PointsArgument(const pybind11::object& given, const char* name);

  // Valid during the lifetime of this object; does not need the GIL.
  Eigen::Map<const Points, 0, Eigen::OuterStride<>> View() const;

 private:
  pybind11::array_t<double> array_;
};

// Makes a cloud as the file readers do: points that are not finite or at the
// origin are dropped and counted.
PointCloud MakeCloud(const PointsArgument& points);

// A pose given as a (4, 4) array, or as its first three rows. Its rotation may
// be rounded, to 1e-3; the nearest rotation is returned. Throws ValueError.
Rigid3 PoseArgument(const pybind11::object& given, const char* name);

// Read-only views of data that `owner` keeps alive.
pybind11::array ViewPoints(const Points& points, pybind11::handle owner);
pybind11::array ViewColumns(const std::vector<Eigen::Index>& columns,
                            pybind11::handle owner);

// An array that owns the points.
pybind11::array TakePoints(Points points);

// Copies of small matrices; None for nullopt.
pybind11::array Copy(const Eigen::Ref<const Eigen::MatrixXd>& matrix);
pybind11::object Copy(const std::optional<Rigid3>& pose);

}  // namespace quatro

#endif  // QUATRO_PYTHON_ARRAYS_H_
