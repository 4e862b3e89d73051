// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The registry of odometries: aloam, suma, and every other method of
// experiments/programs/methods.h from one scan to the next. Those that start
// from a guess are given that of constant velocity.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ODOMETRY_METHODS_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ODOMETRY_METHODS_H_

#include <memory>
#include <string>
#include <vector>

#include "experiments/odometry/odometry.h"
#include "robust/registration/registration.h"

namespace quatro {

std::vector<std::string> OdometryNames();

// One line a method, its name and what it does.
std::string DescribeOdometries();

// `registration` is for the methods from scan to scan, its num_threads for all.
// A nullptr, with *error set, for a name that is not known or options out of
// range.
std::unique_ptr<Odometry> MakeOdometry(const std::string& name,
                                       const RegistrationOptions& registration,
                                       std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_ODOMETRY_METHODS_H_
