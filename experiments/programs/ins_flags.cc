// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/ins_flags.h"

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "features/base/degree.h"

namespace quatro {
namespace {

struct NamedMode {
  const char* name;
  InsMode mode;
};

constexpr NamedMode kModes[] = {{"none", InsMode::kNone},
                                {"relative", InsMode::kRelative},
                                {"leveled", InsMode::kLeveled},
                                {"fused", InsMode::kFused}};

// Parses "1,2,3" with nothing after it.
std::optional<Eigen::Vector3d> ParseThree(const std::string& text) {
  Eigen::Vector3d three;
  const char* rest = text.c_str();
  for (int i = 0; i < 3; ++i) {
    char* end = nullptr;
    three[i] = std::strtod(rest, &end);
    if (end == rest || *end != (i < 2 ? ',' : '\0')) return std::nullopt;
    rest = end + 1;
  }
  if (!three.allFinite()) return std::nullopt;
  return three;
}

bool ParseAttitude(const std::string& flag,
                   const std::string& text,
                   const std::string& mode,
                   Attitude* attitude,
                   std::string* error) {
  if (mode == "none") {
    if (text.empty()) return true;
    *error = "--" + flag + " is given, but --ins_mode is none";
    return false;
  }
  if (text.empty()) {
    *error = "--" + flag + " is empty, but --ins_mode=" + mode + " needs it";
    return false;
  }
  const auto rpy_deg = ParseThree(text);
  if (!rpy_deg) {
    *error = "--" + flag + "=" + text + ", must be three numbers: r,p,y";
    return false;
  }
  const Eigen::Vector3d rpy = *rpy_deg * kDegree;
  *attitude = {rpy.x(), rpy.y(), rpy.z()};
  return true;
}

}  // namespace

const char* InsModeName(InsMode mode) {
  for (const NamedMode& named : kModes) {
    if (named.mode == mode) return named.name;
  }
  return "none";
}

std::optional<InsOptions> ParseInsFlags(const InsFlags& flags,
                                        std::string* error) {
  InsOptions ins;
  bool is_known = false;
  for (const NamedMode& named : kModes) {
    if (flags.mode != named.name) continue;
    ins.mode = named.mode;
    is_known = true;
  }
  if (!is_known) {
    *error = "--ins_mode=" + flags.mode +
             ", must be none, relative, leveled or fused";
    return std::nullopt;
  }
  if (!ParseAttitude("source_rpy_deg",
                     flags.source_rpy_deg,
                     flags.mode,
                     &ins.source_attitude,
                     error) ||
      !ParseAttitude("target_rpy_deg",
                     flags.target_rpy_deg,
                     flags.mode,
                     &ins.target_attitude,
                     error)) {
    return std::nullopt;
  }
  if (!(flags.std_deg > 0.0 && flags.std_deg <= 180.0)) {
    std::ostringstream problem;
    problem << "--ins_std_deg=" << flags.std_deg << ", must be in (0, 180]";
    *error = problem.str();
    return std::nullopt;
  }
  ins.attitude_std = flags.std_deg * kDegree;
  if (flags.gravity == "scans" || flags.gravity == "none") {
    ins.gravity = flags.gravity == "none" ? Gravity::kNone : Gravity::kScans;
    return ins;
  }
  const auto up = ParseThree(flags.gravity);
  const double length = up ? up->norm() : 0.0;
  if (!(length > 0.0 && std::isfinite(length))) {
    *error = "--gravity=" + flags.gravity +
             ", must be scans, none or three numbers, not all zero: x,y,z";
    return std::nullopt;
  }
  ins.up = *up / length;
  return ins;
}

}  // namespace quatro
