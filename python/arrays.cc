// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "python/arrays.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace quatro {
namespace {

namespace py = pybind11;

constexpr py::ssize_t kNumber = sizeof(double);
constexpr double kRotationTolerance = 1e-6;

std::string Shape(const py::array& array) {
  return py::str(array.attr("shape")).cast<std::string>();
}

py::array RealNumbers(const py::object& given, const char* name) {
  auto array = py::array::ensure(given);
  if (!array) {
    PyErr_Clear();
    throw py::value_error(std::string(name) + " is not an array of numbers");
  }
  const char kind = array.dtype().kind();
  if (array.size() > 0 && kind != 'f' && kind != 'i' && kind != 'u') {
    throw py::value_error(std::string(name) + " has dtype " +
                          py::str(array.dtype()).cast<std::string>() +
                          ", must be real numbers");
  }
  return array;
}

bool CanBeMapped(const py::array& array) {
  if (!py::isinstance<py::array_t<double>>(array)) return false;
  const bool is_aligned = array.attr("flags").attr("aligned").cast<bool>();
  return is_aligned && array.shape(0) > 1 && array.strides(1) == kNumber &&
         array.strides(0) >= 3 * kNumber && array.strides(0) % kNumber == 0;
}

py::array ReadOnly(py::array array) {
  array.attr("flags").attr("writeable") = false;
  return array;
}

}  // namespace

PointsArgument::PointsArgument(const py::object& given, const char* name) {
  py::object points = given;
  if (!py::isinstance<py::array>(given) && py::hasattr(given, "points")) {
    points = given.attr("points");
  }
  const py::array array = RealNumbers(points, name);
  if (array.ndim() != 2 || array.shape(1) != 3) {
    throw py::value_error(std::string(name) + " has shape " + Shape(array) +
                          ", must be (N, 3)");
  }
  if (CanBeMapped(array)) {
    array_ = py::reinterpret_borrow<py::array_t<double>>(array);
    return;
  }
  using Contiguous =
      py::array_t<double, py::array::c_style | py::array::forcecast>;
  array_ = Contiguous::ensure(array);
  if (!array_) throw py::error_already_set();
}

Eigen::Map<const Points, 0, Eigen::OuterStride<>> PointsArgument::View() const {
  const py::ssize_t rows = array_.shape(0);
  const py::ssize_t stride = rows > 1 ? array_.strides(0) / kNumber : 3;
  return {array_.data(), 3, rows, Eigen::OuterStride<>(stride)};
}

PointCloud MakeCloud(const PointsArgument& points) {
  const auto view = points.View();
  PointCloud cloud;
  cloud.points.resize(3, view.cols());
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < view.cols(); ++i) {
    const bool is_measured = view.col(i).allFinite() && !view.col(i).isZero(0);
    if (is_measured) cloud.points.col(kept++) = view.col(i);
  }
  cloud.num_dropped = view.cols() - kept;
  if (cloud.num_dropped > 0) cloud.points.conservativeResize(3, kept);
  return cloud;
}

Rigid3 PoseArgument(const py::object& given, const char* name) {
  const py::array array = RealNumbers(given, name);
  if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4) {
    throw py::value_error(std::string(name) + " has shape " + Shape(array) +
                          ", must be (4, 4)");
  }
  const auto numbers =
      py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(
          array);
  if (!numbers) throw py::error_already_set();
  Eigen::Matrix4d matrix;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      matrix(row, column) = numbers.at(row, column);
    }
  }
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const bool is_rotation =
      (rotation.transpose() * rotation).isIdentity(kRotationTolerance) &&
      rotation.determinant() > 0.0;
  if (!matrix.allFinite() || !is_rotation ||
      matrix.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)) {
    throw py::value_error(std::string(name) + " is not a rigid motion");
  }
  return {rotation, matrix.topRightCorner<3, 1>()};
}

py::array ViewPoints(const Points& points, py::handle owner) {
  return ReadOnly(py::array_t<double>({points.cols(), py::ssize_t{3}},
                                      {3 * kNumber, kNumber},
                                      points.data(),
                                      owner));
}

py::array ViewColumns(const std::vector<Eigen::Index>& columns,
                      py::handle owner) {
  static_assert(sizeof(Eigen::Index) == sizeof(std::int64_t));
  return ReadOnly(py::array_t<Eigen::Index>(
      static_cast<py::ssize_t>(columns.size()), columns.data(), owner));
}

py::array TakePoints(Points points) {
  auto held = std::make_unique<Points>(std::move(points));
  const Points& view = *held;
  const py::capsule owner(held.release(), [](void* pointer) {
    delete static_cast<Points*>(pointer);
  });
  return py::array_t<double>({view.cols(), py::ssize_t{3}},
                             {3 * kNumber, kNumber},
                             view.data(),
                             owner);
}

py::array Copy(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  py::array_t<double> array({matrix.rows(), matrix.cols()});
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
      array.mutable_at(row, column) = matrix(row, column);
    }
  }
  return array;
}

py::object Copy(const std::optional<Rigid3>& pose) {
  if (!pose) return py::none();
  return Copy(pose->ToMatrix());
}

}  // namespace quatro
