// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "python/arrays.h"

#include <Eigen/SVD>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "python/arguments.h"

namespace quatro {
namespace {

namespace py = pybind11;

constexpr py::ssize_t kNumber = sizeof(double);
constexpr double kRotationTolerance = 1e-3;  // As that of --guess.

std::string Shape(const py::array& array) {
  return py::str(array.attr("shape")).cast<std::string>();
}

// An array loses its mask when it is read.
void RefuseMasked(const py::object& given, const std::string& name) {
  if (!py::hasattr(given, "mask")) return;
  const py::object is_masked =
      py::module_::import("numpy").attr("ma").attr("is_masked");
  if (!is_masked(given).cast<bool>()) return;
  throw py::value_error(name + " has masked entries; pass " + name + "[~" +
                        name + ".mask.any(axis=1)]");
}

// The nearest rotation, or nullopt if the matrix is not nearly one. A matrix
// that is a rotation up to rounding is returned unchanged.
std::optional<Eigen::Matrix3d> NearestRotationTo(
    const Eigen::Matrix3d& matrix) {
  if (!matrix.isUnitary(kRotationTolerance) || matrix.determinant() < 0.0) {
    return std::nullopt;
  }
  if (matrix.isUnitary(1e-12)) return matrix;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
      matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

// `shape` is that of the array that is expected.
py::array RealNumbers(const py::object& given,
                      const char* name,
                      const std::string& shape) {
  RefuseMasked(given, name);
  auto array = py::array::ensure(given);
  if (!array) PyErr_Clear();
  if (!array || array.dtype().kind() == 'O') {
    throw py::value_error(std::string(name) + " = " + Shown(given) +
                          ", must be an array of real numbers, " + shape);
  }
  const char kind = array.dtype().kind();
  if (array.size() > 0 && kind != 'f' && kind != 'i' && kind != 'u') {
    throw py::value_error(std::string(name) + " has dtype " +
                          py::str(array.dtype()).cast<std::string>() +
                          ", must be real numbers");
  }
  return array;
}

// What to do about points of another shape; empty if unknown.
std::string ShapeHint(const py::array& array, const std::string& name) {
  if (array.ndim() != 2 || array.shape(1) < 4) return "";
  if (array.shape(0) == 3) return "; pass " + name + ".T";
  return "; it has " + std::to_string(array.shape(1)) + " columns, pass " +
         name + "[:, :3]";
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

bool IsPath(const py::object& given) {
  return py::isinstance<py::str>(given) || py::isinstance<py::bytes>(given) ||
         py::hasattr(given, "__fspath__");
}

PointsArgument::PointsArgument(const py::object& given, const char* name) {
  if (IsPath(given)) {
    throw py::type_error(std::string(name) + " = " + Shown(given) +
                         ", must be an (N, 3) array; quatro.read_cloud() reads "
                         "files");
  }
  py::object points = given;
  if (!py::isinstance<py::array>(given) && py::hasattr(given, "points")) {
    points = given.attr("points");
  }
  const py::array array = RealNumbers(points, name, "(N, 3)");
  if (array.ndim() != 2 || array.shape(1) != 3) {
    throw py::value_error(std::string(name) + " has shape " + Shape(array) +
                          ", must be (N, 3)" + ShapeHint(array, name));
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
  const py::array array = RealNumbers(given, name, "(4, 4) or (3, 4)");
  const bool is_pose = array.ndim() == 2 && array.shape(1) == 4 &&
                       (array.shape(0) == 3 || array.shape(0) == 4);
  if (!is_pose) {
    throw py::value_error(std::string(name) + " has shape " + Shape(array) +
                          ", must be (4, 4) or (3, 4)");
  }
  const auto numbers =
      py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(
          array);
  if (!numbers) throw py::error_already_set();
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  for (py::ssize_t row = 0; row < numbers.shape(0); ++row) {
    for (int column = 0; column < 4; ++column) {
      matrix(row, column) = numbers.at(row, column);
    }
  }
  std::optional<Eigen::Matrix3d> rotation;
  if (matrix.allFinite()) {
    rotation = NearestRotationTo(matrix.topLeftCorner<3, 3>());
  }
  if (!rotation || matrix.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)) {
    throw py::value_error(std::string(name) +
                          " is not a rigid motion: its first three columns "
                          "must be a rotation to 1e-3, and a fourth row 0 0 0 "
                          "1");
  }
  return {*rotation, matrix.topRightCorner<3, 1>()};
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
