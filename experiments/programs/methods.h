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

// Names of the methods with this kind of input, in the registry and among the
// peers. Own methods and odometries are not included.
std::vector<std::string> ExperimentMethodNames(MethodInput input);

// Names of the odometries, which need consecutive scans.
std::vector<std::string> OdometryMethodNames();

// One line per method with its name and description: the methods that
// FindPairSolver() or FindMatchSolver() finds; own methods are last.
std::string DescribePairMethods(const std::vector<OwnMethod>& own = {});
std::string DescribeMatchMethods();

// The methods of quatro_odometry: the odometries, and the methods on two clouds
// that need no INS.
std::string DescribeMethods();

// Whether the method needs an INS.
bool NeedsIns(const std::string& name);

// A method on two clouds. `matched` is the result of the front end, which
// several methods can share; if it is null, it is computed if necessary. The
// method and solver of the options are ignored. A local method starts from
// options.bounds.guess.
using PairSolver =
    std::function<RegistrationSummary(const PointCloud& source,
                                      const PointCloud& target,
                                      const MatchedClouds* matched,
                                      const RegistrationOptions& options)>;

// Returns an empty function and sets *error if the name is unknown, belongs to
// an odometry, or is in `own` although a method of quatro has this name.
PairSolver FindPairSolver(const std::string& name,
                          const std::vector<OwnMethod>& own,
                          std::string* error);

// A method on matched points.
using MatchSolver = std::function<RegistrationSummary(
    const Matches& matches, const RegistrationOptions& options)>;

// Like FindPairSolver(); a method that needs clouds is also an error.
MatchSolver FindMatchSolver(const std::string& name,
                            const std::vector<OwnMethod>& own,
                            std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_METHODS_H_
