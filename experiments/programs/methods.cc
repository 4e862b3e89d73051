// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/methods.h"

#include <algorithm>
#include <array>
#include <utility>

#include "experiments/peers/peer_methods.h"

namespace quatro {
namespace {

struct Described {
  const char* name;
  const char* description;
};

// The odometries of experiments/odometry/odometry_methods.h.
constexpr std::array kOdometries = {
    Described{
        "aloam",
        "scans in a row (quatro_odometry): edges and planes, like A-LOAM"},
    Described{
        "suma",
        "scans in a row (quatro_odometry): surfels, projective, like SuMa"},
};

template <typename List>
bool HasName(const List& list, const std::string& name) {
  return std::any_of(list.begin(), list.end(), [&](const auto& method) {
    return name == method.name;
  });
}

// "icp             clouds: point to point, ..."
template <typename Entry>
std::string LineOf(const Entry& method) {
  std::string name = method.name;
  name.resize(std::max<std::size_t>(name.size() + 1, 16), ' ');
  return name + method.description + "\n";
}

bool IsKnown(const std::string& name) {
  return HasName(Methods(), name) || HasName(PeerMethods(), name) ||
         HasName(kOdometries, name);
}

// Makes the solver of an own method or of a peer for matched points.
using MakeSolver = std::function<PoseSolver(const QuatroOptions& options)>;

MakeSolver FindMaker(const std::string& name,
                     const std::vector<OwnMethod>& own) {
  for (const OwnMethod& method : own) {
    if (method.name == name) return method.make;
  }
  for (const PeerMethod& method : PeerMethods()) {
    if (method.name == name) return method.make;
  }
  return nullptr;
}

// The options with the method or the solver set.
RegistrationOptions With(const std::string& name,
                         const MakeSolver& make,
                         RegistrationOptions options) {
  options.solver = make ? make(WithSharedValues(options).quatro) : nullptr;
  if (!make) options.method = name;
  return options;
}

bool IsOneMethod(const std::string& name,
                 const std::vector<OwnMethod>& own,
                 std::string* error) {
  if (HasName(kOdometries, name)) {
    *error = "method " + name +
             " is an odometry, which needs scans in a row: run quatro_odometry";
    return false;
  }
  const bool is_own = HasName(own, name);
  if (is_own && IsKnown(name)) {
    *error = "method " + name + " is both an own one and one of quatro";
    return false;
  }
  if (is_own || IsKnown(name)) return true;
  *error = "method = " + name + ", must be one of";
  for (const MethodInput input : {MethodInput::kMatches,
                                  MethodInput::kMatchedClouds,
                                  MethodInput::kClouds}) {
    for (const auto& known : ExperimentMethodNames(input))
      *error += " " + known;
  }
  for (const OwnMethod& method : own) *error += " " + method.name;
  return false;
}

}  // namespace

std::vector<std::string> ExperimentMethodNames(MethodInput input) {
  std::vector<std::string> names = MethodNames(input);
  for (const PeerMethod& method : PeerMethods()) {
    const MethodInput its_input =
        method.make ? MethodInput::kMatches : MethodInput::kClouds;
    if (input == its_input) names.push_back(method.name);
  }
  return names;
}

std::vector<std::string> OdometryMethodNames() {
  std::vector<std::string> names;
  for (const Described& odometry : kOdometries) {
    names.emplace_back(odometry.name);
  }
  return names;
}

std::string DescribePairMethods(const std::vector<OwnMethod>& own) {
  std::string text;
  for (const auto& method : Methods()) text += LineOf(method);
  for (const auto& method : PeerMethods()) text += LineOf(method);
  for (const auto& method : own) text += LineOf(method);
  return text;
}

std::string DescribeMatchMethods() {
  std::string text;
  for (const auto& method : Methods()) {
    if (method.input == MethodInput::kMatches) text += LineOf(method);
  }
  for (const auto& method : PeerMethods()) {
    if (method.make) text += LineOf(method);
  }
  return text;
}

std::string DescribeMethods() {
  std::string text;
  for (const auto& method : Methods()) {
    if (!NeedsIns(method.name)) text += LineOf(method);
  }
  for (const auto& method : PeerMethods()) text += LineOf(method);
  for (const auto& method : kOdometries) text += LineOf(method);
  return text;
}

bool NeedsIns(const std::string& name) {
  return std::any_of(
      Methods().begin(), Methods().end(), [&](const Method& method) {
        return name == method.name && method.ins == InsUse::kNeeded;
      });
}

PairSolver FindPairSolver(const std::string& name,
                          const std::vector<OwnMethod>& own,
                          std::string* error) {
  if (!IsOneMethod(name, own, error)) return nullptr;
  for (const PeerMethod& method : PeerMethods()) {
    if (method.name != name || !method.register_clouds) continue;
    return [run = method.register_clouds](const PointCloud& source,
                                          const PointCloud& target,
                                          const MatchedClouds*,
                                          const RegistrationOptions& options) {
      return run(source, target, options);
    };
  }
  const MakeSolver make = FindMaker(name, own);
  std::string ignored;  // Peers and own methods are not in the registry.
  const Method* method = FindMethod(name, &ignored);
  const bool needs_clouds = method && method->input == MethodInput::kClouds;
  return [=](const PointCloud& source,
             const PointCloud& target,
             const MatchedClouds* matched,
             const RegistrationOptions& options) {
    const RegistrationOptions used = With(name, make, options);
    return matched && !needs_clouds ? RegisterMatched(*matched, used)
                                    : Register(source, target, used);
  };
}

MatchSolver FindMatchSolver(const std::string& name,
                            const std::vector<OwnMethod>& own,
                            std::string* error) {
  if (!IsOneMethod(name, own, error)) return nullptr;
  const auto known = ExperimentMethodNames(MethodInput::kMatches);
  if (!HasName(own, name) &&
      std::find(known.begin(), known.end(), name) == known.end()) {
    *error = "method " + name + " works on clouds, not on matches";
    return nullptr;
  }
  return [name, make = FindMaker(name, own)](
             const Matches& matches, const RegistrationOptions& options) {
    return RegisterMatches(matches, With(name, make, options));
  };
}

}  // namespace quatro
