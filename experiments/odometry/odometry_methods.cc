// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/odometry_methods.h"

#include "experiments/methods.h"
#include "experiments/odometry/aloam.h"
#include "experiments/odometry/frame_to_frame.h"
#include "experiments/odometry/suma.h"

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

struct Method {
  const char* name;
  const char* description;
  std::unique_ptr<Odometry> (*make)(int num_threads);
};

constexpr Method kMethods[] = {
    {"aloam",
     "like A-LOAM: edges and planes, to the scan, to the map",
     MakeAloam},
    {"suma", "like SuMa: surfels, projective, frame to model", MakeSuma},
};

}  // namespace

std::vector<std::string> OdometryNames() {
  std::vector<std::string> names;
  for (const Method& method : kMethods) names.emplace_back(method.name);
  for (const std::string& name : MethodNames()) names.push_back(name);
  return names;
}

std::string DescribeOdometries() {
  std::string text;
  for (const Method& method : kMethods) {
    std::string name = method.name;
    name.resize(16, ' ');
    text += name + method.description + "\n";
  }
  return text + "and from each scan to the one before it:\n" +
         DescribeMethods();
}

std::unique_ptr<Odometry> MakeOdometry(const std::string& name,
                                       const RegistrationOptions& registration,
                                       std::string* error) {
  if (!registration.IsValid(error)) return nullptr;
  for (const Method& method : kMethods) {
    if (name == method.name) return method.make(registration.num_threads);
  }
  RegistrationOptions options = registration;
  options.quatro.num_threads = registration.num_threads;
  options.quatro.seed = registration.seed;
  options.solver = MakeSolver(name, options.quatro, error);
  if (!options.solver) {
    *error = "--method=" + name + ", must be one of";
    for (const std::string& known : OdometryNames()) *error += " " + known;
    return nullptr;
  }
  return std::make_unique<FrameToFrame>(MakeRegistrationAligner(options));
}

}  // namespace quatro
