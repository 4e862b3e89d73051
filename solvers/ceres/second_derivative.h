// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The first and second derivatives of a function f: R^N -> R at the origin,
// exact to rounding, from one call with Ceres' jets of jets:
//
//   gradient_i = df/dx_i,    hessian_ij = d^2 f / dx_i dx_j.                (1)

#ifndef QUATRO_SOLVERS_CERES_SECOND_DERIVATIVE_H_
#define QUATRO_SOLVERS_CERES_SECOND_DERIVATIVE_H_

#include <ceres/jet.h>

#include <Eigen/Core>
#include <type_traits>

namespace quatro {

// `x` as a constant of type T. T(x) works for a jet, but not for a jet of jets.
template <typename T>
T Constant(double x) {
  if constexpr (std::is_same_v<T, double>) {
    return x;
  } else {
    return T(Constant<typename T::Scalar>(x));
  }
}

// A function's value and its first two derivatives at zero.
template <int N>
struct SecondDerivative {
  double value = 0.0;
  Eigen::Vector<double, N> gradient;
  Eigen::Matrix<double, N, N> hessian;
};

// The number type T of a function f that takes a const T* to N numbers and
// returns a T.
template <int N>
using JetOfJets = ceres::Jet<ceres::Jet<double, N>, N>;

// The value and the derivatives of f at zero; see JetOfJets for its type.
template <int N, typename Function>
SecondDerivative<N> ComputeSecondDerivative(const Function& f) {
  using T = JetOfJets<N>;
  T x[N];
  for (int i = 0; i < N; ++i) {
    x[i] = T(ceres::Jet<double, N>(0.0, i), i);
  }
  const T y = f(x);

  SecondDerivative<N> derivative;
  derivative.value = y.a.a;
  derivative.gradient = y.a.v;
  for (int i = 0; i < N; ++i) derivative.hessian.col(i) = y.v[i].v;
  return derivative;
}

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CERES_SECOND_DERIVATIVE_H_
