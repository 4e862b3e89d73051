// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The methods that experiments can run: those of the registry
// (robust/registration/methods.h), the peers that are built in, and methods of
// the caller's own.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_METHODS_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_METHODS_H_

#include <functional>
#include <string>
#include <vector>

#include "experiments/runner/own_method.h"
#include "features/io/point_cloud.h"
#include "robust/registration/methods.h"
#include "robust/registration/registration.h"

namespace quatro {

// Names of all methods that estimate a pose from matched points, or from two
// clouds alone; own methods are not among them.
std::vector<std::string> ExperimentMethodNames(MethodInput input);

// Names of the odometries, which work on scans in a row.
std::vector<std::string> OdometryMethodNames();

// One line per method, its name and what it does; own methods last.
std::string DescribeMethods(const std::vector<OwnMethod>& own = {});

// Whether the method needs an INS.
bool NeedsIns(const std::string& name);

// A method on two clouds. `matched` is the result of the front end, which
// several methods share; null: computed if the method needs it. Method and
// solver of the options are replaced. A local method starts from
// options.bounds.guess.
using PairSolver =
    std::function<RegistrationSummary(const PointCloud& source,
                                      const PointCloud& target,
                                      const MatchedClouds* matched,
                                      const RegistrationOptions& options)>;

// Returns an empty function and sets *error for an unknown name, an odometry,
// and a name that is both in `own` and known.
PairSolver FindPairSolver(const std::string& name,
                          const std::vector<OwnMethod>& own,
                          std::string* error);

// A method on matched points.
using MatchSolver = std::function<RegistrationSummary(
    const Matches& matches, const RegistrationOptions& options)>;

// Like FindPairSolver(); a method that needs clouds is an error, too.
MatchSolver FindMatchSolver(const std::string& name,
                            const std::vector<OwnMethod>& own,
                            std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_METHODS_H_
