// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The registry of estimators: a name, a description and a solver each, from
// matched points or from clouds. A new one is a line in methods.cc and then
// known to all programs.

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

std::vector<std::string> OdometryMethodNames();  // From scans in a row.

// One line a method, its name and what it does; own ones last.
std::string DescribeMethods(const std::vector<OwnMethod>& own = {});

// The method with noise bound, seed, threads and all else that applies to it
// from `options`. Empty, with *error set, for a name that is not known, for a
// method that works on clouds or on scans in a row, and for quatro_ins, which
// needs an INS.
PoseSolver MakeSolver(const std::string& name,
                      const QuatroOptions& options,
                      std::string* error);

// The same in the level frames of `ins`. Empty, too, for a method that finds
// roll and pitch by itself and has no use for an INS.
PoseSolver MakeSolver(const std::string& name,
                      const QuatroOptions& options,
                      const InsOptions& ins,
                      std::string* error);

// The same for RegistrationOptions::solver beside this `ins`: it leaves the
// turning of the matches to Register().
PoseSolver MakeLevelSolver(const std::string& name,
                           const QuatroOptions& options,
                           const InsOptions& ins,
                           std::string* error);

// A global method does not look at the guess.
using CloudSolver =
    std::function<RegistrationSummary(const PointCloud& source,
                                      const PointCloud& target,
                                      const Rigid3& target_from_source_guess,
                                      const RegistrationOptions& options)>;

// The method that works on clouds; empty if there is none of this name.
CloudSolver FindCloudSolver(const std::string& name);

// Any method but an odometry, on two clouds and, where it works on matches, the
// matches of the front end: so that several methods share them. The solver of
// the options is replaced.
using PairSolver =
    std::function<RegistrationSummary(const PointCloud& source,
                                      const PointCloud& target,
                                      const MatchedClouds& matched,
                                      const RegistrationOptions& options)>;

// Empty, with *error set, for a name that is not known and for an odometry.
PairSolver FindPairSolver(const std::string& name, std::string* error);

// The same, for the names in `own` as well. Empty, with *error set, for one
// that is in the registry, too.
PairSolver FindPairSolver(const std::string& name,
                          const std::vector<OwnMethod>& own,
                          std::string* error);

// Whether the method can't do without an INS.
bool NeedsIns(const std::string& name);

// Sets *method by a flag's text: "none", "icp", "gicp" or "vgicp". For any
// other text returns false and sets *error.
bool ParseRefinement(const std::string& text,
                     RefinementMethod* method,
                     std::string* error);

// Sets *option by a flag's text: "on", "off", or empty for no change. For any
// other text returns false and sets *error, which names the flag.
bool ApplySwitch(const std::string& flag,
                 const std::string& text,
                 bool* option,
                 std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_METHODS_H_
