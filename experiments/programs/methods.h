// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The registry of estimators: name, description and solver of each, for matched
// points or for clouds. Adding a line to methods.cc makes a method available in
// all programs.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_METHODS_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_METHODS_H_

#include <functional>
#include <string>
#include <vector>

#include "experiments/programs/own_method.h"
#include "features/base/rigid3.h"
#include "features/io/point_cloud.h"
#include "robust/estimators/quatro.h"
#include "robust/registration/ins.h"
#include "robust/registration/refinement.h"
#include "robust/registration/registration.h"

namespace quatro {

std::vector<std::string> MethodNames();       // From matched points.
std::vector<std::string> CloudMethodNames();  // From clouds.

std::vector<std::string> OdometryMethodNames();  // From successive scans.

// One line per method with its name and description; own methods are last.
std::string DescribeMethods(const std::vector<OwnMethod>& own = {});

// The method, with the noise bound, seed, threads and all other options that
// apply to it. Empty, with *error set, for an unknown name, for a method that
// works on clouds or successive scans, and for quatro_ins, which needs an INS.
PoseSolver MakeSolver(const std::string& name,
                      const QuatroOptions& options,
                      std::string* error);

// The method in the level frames of `ins`. Also empty for a method that
// estimates roll and pitch itself and cannot use an INS.
PoseSolver MakeSolver(const std::string& name,
                      const QuatroOptions& options,
                      const InsOptions& ins,
                      std::string* error);

// The method for RegistrationOptions::solver together with this `ins`. It
// leaves the rotation of the matches to Register().
PoseSolver MakeLevelSolver(const std::string& name,
                           const QuatroOptions& options,
                           const InsOptions& ins,
                           std::string* error);

// A global method ignores the guess.
using CloudSolver =
    std::function<RegistrationSummary(const PointCloud& source,
                                      const PointCloud& target,
                                      const Rigid3& target_from_source_guess,
                                      const RegistrationOptions& options)>;

// The method that works on clouds; empty if there is no such name.
CloudSolver FindCloudSolver(const std::string& name);

// Any method except an odometry, on two clouds and, if it works on matches, the
// matches of the front end, so that several methods can share them. Replaces
// the solver in the options.
using PairSolver =
    std::function<RegistrationSummary(const PointCloud& source,
                                      const PointCloud& target,
                                      const MatchedClouds& matched,
                                      const RegistrationOptions& options)>;

// Returns an empty function, with *error set, for an unknown name or an
// odometry.
PairSolver FindPairSolver(const std::string& name, std::string* error);

// Also accepts the names in `own`. Returns an empty function, with *error set,
// if a name in `own` is also in the registry.
PairSolver FindPairSolver(const std::string& name,
                          const std::vector<OwnMethod>& own,
                          std::string* error);

// Returns whether the method requires an INS.
bool NeedsIns(const std::string& name);

// Sets *method from a flag's text: "none", "icp", "gicp" or "vgicp". For any
// other text, returns false and sets *error.
bool ParseRefinement(const std::string& text,
                     RefinementMethod* method,
                     std::string* error);

// Sets *option from a flag's text: "on", "off", or empty to keep it. For any
// other text, returns false and sets *error, which names the flag.
bool ApplySwitch(const std::string& flag,
                 const std::string& text,
                 bool* option,
                 std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_METHODS_H_
