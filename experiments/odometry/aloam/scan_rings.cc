// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/aloam/scan_rings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "features/base/degree.h"

namespace quatro {
namespace {

using Ring = std::vector<Eigen::Index>;

constexpr int kMinNumRings = 4;
constexpr int kMaxNumRings = 256;

// Order: a new ring starts if the azimuth decreases by more than kMaxBack. This
// must be large, because the lasers are at different places, and the azimuth of
// a point 1 m away is 8 deg off. At least kMinForwardShare of the steps must go
// forward by at most kMaxStep.
constexpr double kMaxBack = 15.0 * kDegree;
constexpr double kMaxStep = 5.0 * kDegree;
constexpr double kMinForwardShare = 0.85;

// Elevation: the bin width of the histogram, the smallest maximum that counts
// as a fraction of the largest, and the share of points that must be near a
// beam, within kMaxOffset of the distance to the next beam.
constexpr double kBin = 0.02 * kDegree;
constexpr double kMinPeak = 0.02;
constexpr double kMaxOffset = 0.25;
constexpr double kMinNearShare = 0.9;

struct Directions {
  Ring index;  // Points that have a direction.
  std::vector<double> azimuth, elevation;
};

Directions ComputeDirections(const PointsRef& points) {
  Directions directions;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double planar = std::hypot(points(0, i), points(1, i));
    if (!(planar > 0.0) || !std::isfinite(planar + points(2, i))) continue;
    directions.index.push_back(i);
    directions.azimuth.push_back(std::atan2(points(1, i), points(0, i)));
    directions.elevation.push_back(std::atan2(points(2, i), planar));
  }
  return directions;
}

// The angle swept since azimuth 0, in [0, 2 pi), for rotation direction
// `sense`.
double Phase(double azimuth, double sense) {
  const double phase = sense * azimuth;
  return phase < 0.0 ? phase + 2.0 * M_PI : phase;
}

// Positions in `directions`, ring by ring; empty if the order is not
// informative.
std::vector<Ring> RingsByOrder(const Directions& directions) {
  const std::size_t n = directions.index.size();
  std::size_t num_left = 0;
  for (std::size_t i = 1; i < n; ++i) {
    if (std::remainder(directions.azimuth[i] - directions.azimuth[i - 1],
                       2.0 * M_PI) > 0.0) {
      ++num_left;
    }
  }
  const double sense = 2 * num_left >= n ? 1.0 : -1.0;
  std::vector<Ring> rings;
  std::size_t num_forward = 0;
  double before = 7.0;  // Larger than any phase.
  for (std::size_t i = 0; i < n; ++i) {
    const double phase = Phase(directions.azimuth[i], sense);
    const double step = phase - before;
    if (step > 0.0 && step <= kMaxStep) ++num_forward;
    if (rings.empty() || step < -kMaxBack) rings.emplace_back();
    rings.back().push_back(static_cast<Eigen::Index>(i));
    before = phase;
  }
  if (static_cast<double>(num_forward) <
      kMinForwardShare * static_cast<double>(n)) {
    return {};
  }
  return rings;
}

// Elevations of the beams, ascending.
std::vector<double> FindBeams(const std::vector<double>& elevation) {
  const double lowest = *std::min_element(elevation.begin(), elevation.end());
  // Two extra bins at either end for the window.
  std::vector<double> raw(static_cast<std::size_t>(M_PI / kBin) + 5, 0.0);
  for (const double e : elevation) {
    raw[static_cast<std::size_t>((e - lowest) / kBin) + 2] += 1.0;
  }
  std::vector<double> smooth(raw.size(), 0.0);
  for (std::size_t i = 2; i + 2 < raw.size(); ++i) {
    smooth[i] = raw[i - 2] + 2.0 * raw[i - 1] + 3.0 * raw[i] +
                2.0 * raw[i + 1] + raw[i + 2];
  }
  const double least =
      kMinPeak * *std::max_element(smooth.begin(), smooth.end());
  std::vector<double> beams;
  for (std::size_t i = 2; i + 2 < smooth.size(); ++i) {
    if (smooth[i] < least || smooth[i] < smooth[i - 1] ||
        smooth[i] < smooth[i - 2] || smooth[i] <= smooth[i + 1] ||
        smooth[i] <= smooth[i + 2]) {
      continue;
    }
    beams.push_back(lowest + (static_cast<double>(i) - 1.5) * kBin);
  }
  return beams;
}

std::vector<Ring> RingsByElevation(const Directions& directions) {
  const std::vector<double> beams = FindBeams(directions.elevation);
  if (beams.size() < static_cast<std::size_t>(kMinNumRings)) return {};
  std::vector<Ring> rings(beams.size());
  std::size_t num_near = 0;
  for (std::size_t i = 0; i < directions.index.size(); ++i) {
    const double e = directions.elevation[i];
    const auto above = std::lower_bound(beams.begin(), beams.end(), e);
    auto beam = static_cast<std::size_t>(above - beams.begin());
    if (beam == beams.size() ||
        (beam > 0 && e - beams[beam - 1] < beams[beam] - e)) {
      --beam;
    }
    const double spacing = std::min(
        beam > 0 ? beams[beam] - beams[beam - 1] : M_PI,
        beam + 1 < beams.size() ? beams[beam + 1] - beams[beam] : M_PI);
    if (std::abs(e - beams[beam]) <= kMaxOffset * spacing) ++num_near;
    rings[beam].push_back(static_cast<Eigen::Index>(i));
  }
  if (static_cast<double>(num_near) <
      kMinNearShare * static_cast<double>(directions.index.size())) {
    return {};
  }
  for (Ring& ring : rings) {
    std::stable_sort(
        ring.begin(), ring.end(), [&](Eigen::Index a, Eigen::Index b) {
          return directions.azimuth[static_cast<std::size_t>(a)] <
                 directions.azimuth[static_cast<std::size_t>(b)];
        });
  }
  return rings;
}

double MedianOver(const Ring& ring, const std::vector<double>& values) {
  std::vector<double> of_ring;
  for (const Eigen::Index i : ring) {
    of_ring.push_back(values[static_cast<std::size_t>(i)]);
  }
  const auto middle =
      of_ring.begin() + static_cast<std::ptrdiff_t>(of_ring.size() / 2);
  std::nth_element(of_ring.begin(), middle, of_ring.end());
  return *middle;
}

bool IsPlausible(std::vector<Ring>* rings) {
  std::erase_if(*rings, [](const Ring& ring) {
    return ring.size() < static_cast<std::size_t>(kMinRingSize);
  });
  return rings->size() >= static_cast<std::size_t>(kMinNumRings) &&
         rings->size() <= static_cast<std::size_t>(kMaxNumRings);
}

}  // namespace

ScanRings EstimateScanRings(const PointsRef& points) {
  ScanRings scan;
  const Directions directions = ComputeDirections(points);
  if (directions.index.size() < static_cast<std::size_t>(kMinNumRings) *
                                    static_cast<std::size_t>(kMinRingSize)) {
    return scan;
  }
  std::vector<Ring> rings = RingsByOrder(directions);
  if (IsPlausible(&rings)) {
    scan.source = RingSource::kOrder;
  } else {
    rings = RingsByElevation(directions);
    if (!IsPlausible(&rings)) return scan;
    scan.source = RingSource::kElevation;
  }

  std::vector<std::pair<double, std::size_t>> from_top;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    from_top.emplace_back(-MedianOver(rings[r], directions.elevation), r);
  }
  std::sort(from_top.begin(), from_top.end());
  for (const auto& [minus_elevation, r] : from_top) {
    scan.elevations.push_back(-minus_elevation);
    scan.rings.push_back(std::move(rings[r]));
    for (Eigen::Index& i : scan.rings.back()) {
      i = directions.index[static_cast<std::size_t>(i)];
    }
  }
  return scan;
}

}  // namespace quatro
