// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/odometry_methods.h"

#include "experiments/odometry/aloam/aloam.h"
#include "experiments/odometry/frame_to_frame.h"
#include "experiments/odometry/suma/suma.h"
#include "experiments/programs/methods.h"

namespace quatro {
namespace {

std::unique_ptr<Odometry> MakeAloam(int num_threads) {
  AloamOptions options;
  options.num_threads = num_threads;
  return std::make_unique<Aloam>(options);
}

std::unique_ptr<Odometry> MakeSuma(int num_threads) {
  SumaOptions options;
  options.num_threads = num_threads;
  return std::make_unique<Suma>(options);
}

// Described in experiments/programs/methods.cc.
struct OdometryEntry {
  const char* name;
  std::unique_ptr<Odometry> (*make)(int num_threads);
};

constexpr OdometryEntry kMethods[] = {
    {"aloam", MakeAloam},
    {"suma", MakeSuma},
};

}  // namespace

std::vector<std::string> OdometryNames() {
  std::vector<std::string> names = OdometryMethodNames();
  for (const MethodInput input : {MethodInput::kMatches,
                                  MethodInput::kMatchedClouds,
                                  MethodInput::kClouds}) {
    for (const std::string& name : ExperimentMethodNames(input)) {
      if (!NeedsIns(name)) names.push_back(name);
    }
  }
  return names;
}

std::string DescribeOdometries() {
  return DescribeMethods() +
         "All others register each scan to the previous one; icp and similar\n"
         "methods start from constant velocity instead of no motion.\n";
}

std::unique_ptr<Odometry> MakeOdometry(const std::string& name,
                                       const RegistrationOptions& registration,
                                       std::string* error) {
  if (!registration.IsValid(error)) return nullptr;
  for (const OdometryEntry& method : kMethods) {
    if (name == method.name) return method.make(registration.num_threads);
  }
  PairSolver solver;
  if (!NeedsIns(name)) solver = FindPairSolver(name, {}, error);
  if (!solver) {
    *error = "--method=" + name + ", must be one of";
    for (const std::string& known : OdometryNames()) *error += " " + known;
    return nullptr;
  }
  return std::make_unique<FrameToFrame>(
      MakeFrameAligner(std::move(solver), registration));
}

}  // namespace quatro
