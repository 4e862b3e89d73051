// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Bins of pairs by distance, |t| in [min, max).

#ifndef QUATRO_EXPERIMENTS_PROTOCOLS_DISTANCE_BIN_H_
#define QUATRO_EXPERIMENTS_PROTOCOLS_DISTANCE_BIN_H_

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace quatro {

struct DistanceBin {
  double min = 0.0;  // [m]
  double max = 0.0;  // [m]

  bool Contains(double distance) const {
    return distance >= min && distance < max;
  }

  // "8-10 m"
  std::string Name() const {
    char name[64];
    std::snprintf(name, sizeof(name), "%g-%g m", min, max);
    return name;
  }

  bool IsValid(std::string* error) const {
    if (min >= 0.0 && min < max && std::isfinite(max)) return true;
    *error = "bin " + Name() + ", must have 0 <= min < max";
    return false;
  }
};

// The bins of the paper's Table III.
inline std::vector<DistanceBin> TableThreeBins() {
  return {{0.0, 2.0}, {4.0, 6.0}, {8.0, 10.0}};
}

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_DISTANCE_BIN_H_
