// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Points and numbers that RapidCheck draws and makes smaller where a property
// fails: whole numbers, mostly small, so that ties, copies, points on a line
// and zeros are common, where real numbers drawn at random have none.

#ifndef QUATRO_TESTS_PROPERTIES_LATTICE_H_
#define QUATRO_TESTS_PROPERTIES_LATTICE_H_

#include <rapidcheck.h>

#include <vector>

#include "features/base/types.h"

namespace quatro {

// All of [min, max] from the first draw on.
inline rc::Gen<int> Whole(int min, int max) {
  return rc::gen::resize(rc::kNominalSize, rc::gen::inRange(min, max + 1));
}

// -4 .. 4, made smaller towards 0.
inline rc::Gen<int> Coordinate() {
  return rc::gen::map(Whole(0, 8),
                      [](int k) { return k % 2 == 0 ? k / 2 : -(k + 1) / 2; });
}

inline rc::Gen<std::size_t> NumUpTo(int min, int max) {
  return rc::gen::cast<std::size_t>(Whole(min, max));
}

// num_points columns.
inline Points LatticePoints(std::size_t num_points) {
  const auto numbers =
      *rc::gen::container<std::vector<int>>(3 * num_points, Coordinate());
  Points points(3, static_cast<Eigen::Index>(num_points));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    points.data()[i] = numbers[i];
  }
  return points;
}

inline Weights LatticeNumbers(std::size_t count, int min, int max) {
  const auto numbers =
      *rc::gen::container<std::vector<int>>(count, Whole(min, max));
  Weights weights(static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    weights[static_cast<Eigen::Index>(i)] = numbers[i];
  }
  return weights;
}

// Turned by a quarter of a circle, `turns` times, about z: without rounding.
inline Points TurnedByQuarters(const Points& points, int turns) {
  Points turned = points;
  for (int i = 0; i < turns; ++i) {
    const Eigen::RowVectorXd x = turned.row(0);
    turned.row(0) = -turned.row(1);
    turned.row(1) = x;
  }
  return turned;
}

}  // namespace quatro

#endif  // QUATRO_TESTS_PROPERTIES_LATTICE_H_
