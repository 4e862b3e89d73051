// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The registry of odometries: aloam, suma, and every other method of
// experiments/programs/methods.h applied to successive scans. Methods that need
// an initial guess get the constant-velocity guess.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ODOMETRY_METHODS_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ODOMETRY_METHODS_H_

#include <memory>
#include <string>
#include <vector>

#include "experiments/odometry/odometry.h"
#include "robust/registration/registration.h"

namespace quatro {

std::vector<std::string> OdometryNames();

// One line per method with its name and description.
std::string DescribeOdometries();

// `registration` applies to the scan-to-scan methods, and its num_threads to
// all. Returns nullptr, with *error set, if the name is unknown or options are
// out of range.
std::unique_ptr<Odometry> MakeOdometry(const std::string& name,
                                       const RegistrationOptions& registration,
                                       std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_ODOMETRY_METHODS_H_
