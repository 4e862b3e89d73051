// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The root of an information matrix,
//
//   U^T U = information,                                                   (1)
//
// so that |U e|^2 = e^T information e. An edge that measures only some of the
// freedoms, for example a position without a rotation, has an information
// matrix that is positive semi-definite: U then has one row for each direction
// that is measured, and |U e|^2 is chi-square with that many degrees of
// freedom.

#ifndef QUATRO_EXPERIMENTS_POSE_GRAPHS_INFORMATION_H_
#define QUATRO_EXPERIMENTS_POSE_GRAPHS_INFORMATION_H_

#include <Eigen/Core>
#include <optional>

namespace quatro {

// Returns U with 1 to n rows for a symmetric n x n matrix: the upper Cholesky
// factor if the matrix is positive definite. Returns nullopt if the matrix is
// zero or not positive semi-definite to the six digits that files often have.
std::optional<Eigen::MatrixXd> RootOfInformation(
    const Eigen::MatrixXd& information);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_POSE_GRAPHS_INFORMATION_H_
