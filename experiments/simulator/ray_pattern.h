// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Where the rays of a sensor go (x ahead, y left, z up). Beam b with elevation
// e and column c of n are cast at the fraction f of a frame:
//
//   spinning  one revolution, clockwise seen from above, with the frame's phase
//             in [0, 1), f = (c + phase) / n and a = offset[b] - 2 pi f:
//
//               d = (cos e cos a, cos e sin a, sin e)                      (1)
//
//   rosette   two counter-rotating prisms, at 12.16 and 7.77 revolutions per
//             frame, deflect the beams within an ellipse; (1) with
//
//               a = width / 2 (cos p + cos q) / 2 + offset[b],
//               e = height / 2 (sin p + sin q) / 2 + elevation[b],         (2)
//               p = 2 pi 12.16 (f + s), q = -2 pi 7.77 (f + s).
//
//             where f = (c + 1/2) / n, and the start s is one of 100 frames,
//             after which the pattern repeats.
//   pinhole   a camera that sees all pixels at once, f = 1/2. On the plane
//             x = 1, columns are evenly spaced within the width and beams are
//             rows,
//
//               d ~ (1, tan(width / 2) (1 - 2 (c + 1/2) / n), tan e).      (3)
//
// Source of the speeds: the prisms of the Livox Mid-40, at 7294 and -4664
// revolutions per minute, with frames at 10 Hz.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_RAY_PATTERN_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_RAY_PATTERN_H_

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace quatro {

// Selects one of the equations above.
enum class ScanPattern { kSpinning, kRosette, kPinhole };

struct RayPattern {
  ScanPattern pattern = ScanPattern::kSpinning;
  std::vector<double> elevations;       // e, per beam [rad].
  std::vector<double> azimuth_offsets;  // Per beam [rad]; empty: all 0.
  int num_columns = 1;                  // n

  // The field of view [rad]; the height is that of a rosette.
  double width = 2.0 * M_PI;
  double height = 0.0;

  bool IsValid(std::string* error) const;
};

// A ray and when it is cast, as a fraction of the frame.
struct Ray {
  Eigen::Vector3d direction;  // A unit vector.
  double fraction;
};

// `random` in [0, 1) is a random number of the frame. It determines the phase
// of a spinning sensor and the start of a rosette. The pattern must be valid.
Ray RayOf(const RayPattern& pattern,
          std::size_t beam,
          std::size_t column,
          double random);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_RAY_PATTERN_H_
