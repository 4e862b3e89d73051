// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/pair_feature.h"

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

#include "features/base/simd.h"

namespace quatro {
namespace {

// Cosines of the angle to the line that differ by less than this are equal up
// to rounding.
constexpr float kEqualCosines = 1e-5f;

// The sine of the angle between line and normal below which v in (1) is
// rounding error.
constexpr float kMinSine = 1e-4f;

QUATRO_SIMD_INLINE std::int32_t Bin(float f) {
  const auto bin =
      static_cast<std::int32_t>((f + 1.0f) * 0.5f * kFpfhBinsPerPart);
  const std::int32_t not_below = bin < 0 ? 0 : bin;
  return not_below < kFpfhBinsPerPart ? not_below : kFpfhBinsPerPart - 1;
}

// The bin of atan2(y, x) / pi, without computing the angle. Counts the edges at
// t = pi/11, 3 pi/11, .. 9 pi/11 that (x, |y|) is past: |y| cos t >= x sin t.
QUATRO_SIMD_INLINE std::int32_t AngleBin(float y, float x) {
  constexpr float kCosines[] = {
      0.95949297f, 0.65486073f, 0.14231484f, -0.41541501f, -0.84125353f};
  constexpr float kSines[] = {
      0.28173256f, 0.75574957f, 0.98982144f, 0.90963200f, 0.54064082f};
  const float height = std::abs(y);
  std::int32_t num_past = height * kCosines[0] >= x * kSines[0] ? 1 : 0;
  num_past += height * kCosines[1] >= x * kSines[1] ? 1 : 0;
  num_past += height * kCosines[2] >= x * kSines[2] ? 1 : 0;
  num_past += height * kCosines[3] >= x * kSines[3] ? 1 : 0;
  num_past += height * kCosines[4] >= x * kSines[4] ? 1 : 0;
  const std::int32_t middle = kFpfhBinsPerPart / 2;
  return std::bit_cast<std::int32_t>(y) < 0 ? middle - num_past
                                            : middle + num_past;
}

// The bins of ComputePairFeature() for all pairs, with the bin of the angle by
// AngleBin().
QUATRO_SIMD_CLONES void FindAll(const OrientedPoint& own,
                                const float* __restrict x,
                                const float* __restrict y,
                                const float* __restrict z,
                                const float* __restrict nx,
                                const float* __restrict ny,
                                const float* __restrict nz,
                                std::size_t size,
                                PairBins* __restrict bins) {
  const OrientedPoint p = own;
  for (std::size_t k = 0; k < size; ++k) {
    float dx = x[k] - p.x;
    float dy = y[k] - p.y;
    float dz = z[k] - p.z;
    const float distance = std::sqrt(dx * dx + (dy * dy + dz * dz));
    const bool is_apart = distance > 0.0f;
    const float per_distance = 1.0f / (is_apart ? distance : 1.0f);
    dx *= per_distance;
    dy *= per_distance;
    dz *= per_distance;
    const float cos1 = p.nx * dx + (p.ny * dy + p.nz * dz);
    const float cos2 = nx[k] * dx + (ny[k] * dy + nz[k] * dz);
    const float difference = std::abs(cos2) - std::abs(cos1);
    // Positive if the second point is the source.
    const float second =
        std::abs(difference) > kEqualCosines ? difference : -(cos1 + cos2);
    const bool is_second = second > 0.0f;
    const float sx = is_second ? nx[k] : p.nx;
    const float sy = is_second ? ny[k] : p.ny;
    const float sz = is_second ? nz[k] : p.nz;
    const float tx = is_second ? p.nx : nx[k];
    const float ty = is_second ? p.ny : ny[k];
    const float tz = is_second ? p.nz : nz[k];
    dx = is_second ? -dx : dx;
    dy = is_second ? -dy : dy;
    dz = is_second ? -dz : dz;
    float vx = dy * sz - dz * sy;
    float vy = dz * sx - dx * sz;
    float vz = dx * sy - dy * sx;
    const float length = std::sqrt(vx * vx + (vy * vy + vz * vz));
    const bool has_feature = is_apart & (length > kMinSine);
    const float per_sine = 1.0f / (has_feature ? length : 1.0f);
    vx *= per_sine;
    vy *= per_sine;
    vz *= per_sine;
    const float wx = sy * vz - sz * vy;
    const float wy = sz * vx - sx * vz;
    const float wz = sx * vy - sy * vx;
    const std::int32_t angle =
        AngleBin(wx * tx + (wy * ty + wz * tz), sx * tx + (sy * ty + sz * tz));
    const std::int32_t across = Bin(vx * tx + (vy * ty + vz * tz));
    const std::int32_t along = Bin(sx * dx + (sy * dy + sz * dz));
    constexpr std::int32_t kEachPart = 0x111;
    const std::int32_t none =
        (is_apart ? PairBins::kAlongNormal : PairBins::kNoPair) * kEachPart;
    bins[k].bits = has_feature ? angle | across << 4 | along << 8 : none;
  }
}

}  // namespace

std::optional<Eigen::Vector3f> ComputePairFeature(const Eigen::Vector3f& p1,
                                                  const Eigen::Vector3f& n1,
                                                  const Eigen::Vector3f& p2,
                                                  const Eigen::Vector3f& n2) {
  Eigen::Vector3f d = p2 - p1;
  const float distance = d.norm();
  if (!(distance > 0.0f)) return std::nullopt;
  d *= 1.0f / distance;
  Eigen::Vector3f n_s = n1;
  Eigen::Vector3f n_t = n2;
  const float cos1 = n1.dot(d);
  const float cos2 = n2.dot(d);
  const float difference = std::abs(cos2) - std::abs(cos1);
  const bool is_second = std::abs(difference) > kEqualCosines
                             ? difference > 0.0f
                             : cos1 + cos2 < 0.0f;
  if (is_second) {
    std::swap(n_s, n_t);
    d = -d;
  }
  Eigen::Vector3f v = d.cross(n_s);
  const float v_norm = v.norm();
  if (!(v_norm > kMinSine)) return std::nullopt;
  v *= 1.0f / v_norm;
  const Eigen::Vector3f w = n_s.cross(v);
  constexpr float kPi = 3.14159265358979f;
  return Eigen::Vector3f(
      std::atan2(w.dot(n_t), n_s.dot(n_t)) / kPi, v.dot(n_t), n_s.dot(d));
}

std::span<const PairBins> PairBinner::FindBins(
    const OrientedPoint& own,
    const std::vector<OrientedPoint>& points,
    std::span<const std::int32_t> index) {
  const std::size_t size = index.size();
  if (size > bins_.size()) {
    for (auto* floats : {&x_, &y_, &z_, &nx_, &ny_, &nz_}) floats->resize(size);
    bins_.resize(size);
  }
  for (std::size_t k = 0; k < size; ++k) {
    const OrientedPoint& point = points[static_cast<std::size_t>(index[k])];
    x_[k] = point.x;
    y_[k] = point.y;
    z_[k] = point.z;
    nx_[k] = point.nx;
    ny_[k] = point.ny;
    nz_[k] = point.nz;
  }
  FindAll(own,
          x_.data(),
          y_.data(),
          z_.data(),
          nx_.data(),
          ny_.data(),
          nz_.data(),
          size,
          bins_.data());
  return {bins_.data(), size};
}

}  // namespace quatro
