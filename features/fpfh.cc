// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/fpfh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "features/parallel.h"
#include "features/simd.h"

namespace quatro {
namespace {

// Cosines to the line that differ less than this are equal but for rounding.
constexpr float kEqualCosines = 1e-5f;

// Sine of the angle between line and normal, below which v in (1) is rounding.
constexpr float kMinSine = 1e-4f;

// One part of a descriptor to a row; the last lane takes what has no feature.
constexpr int kRowLanes = 16;
constexpr std::int32_t kNoBin = kRowLanes - 1;
using Row __attribute__((vector_size(4 * kRowLanes), may_alias)) = float;

struct alignas(64) Histogram {
  float part[3][kRowLanes];
};

// A point in single precision.
struct OrientedPoint {
  float x, y, z;
  float nx, ny, nz;
  bool has_normal;
};

// The neighbours of one point that have a normal.
struct Neighborhood {
  std::vector<float> x, y, z, nx, ny, nz;
  std::vector<std::int32_t> bins;
  std::size_t size = 0;
  std::int32_t num_apart = 0;  // Those at some distance.

  void Gather(const std::vector<OrientedPoint>& points,
              const Neighborhoods& neighborhoods,
              std::size_t i) {
    const Neighborhoods::Row& row =
        neighborhoods.row(static_cast<Eigen::Index>(i));
    if (row.size() > x.size()) {
      for (auto* floats : {&x, &y, &z, &nx, &ny, &nz}) {
        floats->resize(row.size());
      }
      bins.resize(row.size());
    }
    size = 0;
    num_apart = 0;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::int32_t j = row.index[k];
      const OrientedPoint& point = points[static_cast<std::size_t>(j)];
      x[size] = point.x;
      y[size] = point.y;
      z[size] = point.z;
      nx[size] = point.nx;
      ny[size] = point.ny;
      nz[size] = point.nz;
      size += point.has_normal & (static_cast<std::size_t>(j) != i);
      num_apart += point.has_normal & (row.squared_distance[k] > 0.0f);
    }
  }
};

QUATRO_SIMD_INLINE std::int32_t Bin(float f) {
  const auto bin =
      static_cast<std::int32_t>((f + 1.0f) * 0.5f * kFpfhBinsPerPart);
  const std::int32_t not_below = bin < 0 ? 0 : bin;
  return not_below < kFpfhBinsPerPart ? not_below : kFpfhBinsPerPart - 1;
}

// The bin of atan2(y, x) / pi without the angle: how many of the edges at
// t = pi/11, 3 pi/11, .. 9 pi/11 that of (x, |y|) is past, |y| cos t >= x sin
// t.
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

// The bins of each neighbour's pair with `own`, four bits a part. Operation by
// operation what ComputePairFeature() does, but for the angle.
QUATRO_SIMD_CLONES void FindBins(const OrientedPoint& own,
                                 const float* __restrict x,
                                 const float* __restrict y,
                                 const float* __restrict z,
                                 const float* __restrict nx,
                                 const float* __restrict ny,
                                 const float* __restrict nz,
                                 std::size_t size,
                                 std::int32_t* __restrict bins) {
  const OrientedPoint p = own;
  for (std::size_t k = 0; k < size; ++k) {
    float dx = x[k] - p.x;
    float dy = y[k] - p.y;
    float dz = z[k] - p.z;
    const float distance = std::sqrt(dx * dx + (dy * dy + dz * dz));
    const bool is_apart = distance > 0.0f;
    const float divisor = is_apart ? distance : 1.0f;
    dx /= divisor;
    dy /= divisor;
    dz /= divisor;
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
    const float sine = has_feature ? length : 1.0f;
    vx /= sine;
    vy /= sine;
    vz /= sine;
    const float wx = sy * vz - sz * vy;
    const float wy = sz * vx - sx * vz;
    const float wz = sx * vy - sy * vx;
    const std::int32_t angle =
        AngleBin(wx * tx + (wy * ty + wz * tz), sx * tx + (sy * ty + sz * tz));
    const std::int32_t across = Bin(vx * tx + (vy * ty + vz * tz));
    const std::int32_t along = Bin(sx * dx + (sy * dy + sz * dz));
    const std::int32_t all = angle | across << 4 | along << 8;
    bins[k] = has_feature ? all : kNoBin | kNoBin << 4 | kNoBin << 8;
  }
}

// 1 / distance, and 0 for points at no distance.
QUATRO_SIMD_CLONES void FindWeights(const float* __restrict squared_distance,
                                    std::size_t size,
                                    float* __restrict weights) {
  for (std::size_t k = 0; k < size; ++k) {
    const bool is_apart = squared_distance[k] > 0.0f;
    const float divisor = std::sqrt(is_apart ? squared_distance[k] : 1.0f);
    weights[k] = is_apart ? 1.0f / divisor : 0.0f;
  }
}

// The sum in (2). Points without a normal have an SPFH of zero.
QUATRO_SIMD_CLONES void AddUp(const Histogram* spfh,
                              const std::int32_t* index,
                              const float* weights,
                              std::size_t size,
                              Histogram* out) {
  Row sum0 = {}, sum1 = {}, sum2 = {};
  for (std::size_t k = 0; k < size; ++k) {
    const auto* rows = reinterpret_cast<const Row*>(spfh[index[k]].part[0]);
    sum0 += rows[0] * weights[k];
    sum1 += rows[1] * weights[k];
    sum2 += rows[2] * weights[k];
  }
  auto* rows = reinterpret_cast<Row*>(out->part[0]);
  rows[0] = sum0;
  rows[1] = sum1;
  rows[2] = sum2;
}

// Each part to this sum; a part without mass is left at zero.
void NormalizeParts(float sum, Histogram* histogram) {
  for (auto& part : histogram->part) {
    float mass = 0.0f;
    for (int bin = 0; bin < kFpfhBinsPerPart; ++bin) mass += part[bin];
    if (!(mass > 0.0f)) continue;
    const float scale = sum / mass;
    for (int bin = 0; bin < kFpfhBinsPerPart; ++bin) part[bin] *= scale;
  }
}

// SPFH of a point of these pairs.
Histogram CountBins(const std::vector<std::int32_t>& bins, std::size_t size) {
  // In two counts, since neighbours often fall into the same bin.
  std::int32_t count[2][3][kRowLanes] = {};
  for (std::size_t k = 0; k < size; ++k) {
    auto& parts = count[k % 2];
    ++parts[0][bins[k] & 15];
    ++parts[1][bins[k] >> 4 & 15];
    ++parts[2][bins[k] >> 8];
  }
  Histogram histogram = {};
  for (int part = 0; part < 3; ++part) {
    for (int bin = 0; bin < kFpfhBinsPerPart; ++bin) {
      histogram.part[part][bin] =
          static_cast<float>(count[0][part][bin] + count[1][part][bin]);
    }
  }
  NormalizeParts(1.0f, &histogram);
  return histogram;
}

}  // namespace

std::optional<Eigen::Vector3f> ComputePairFeature(const Eigen::Vector3f& p1,
                                                  const Eigen::Vector3f& n1,
                                                  const Eigen::Vector3f& p2,
                                                  const Eigen::Vector3f& n2) {
  Eigen::Vector3f d = p2 - p1;
  const float distance = d.norm();
  if (!(distance > 0.0f)) return std::nullopt;
  d /= distance;
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
  v /= v_norm;
  const Eigen::Vector3f w = n_s.cross(v);
  constexpr float kPi = 3.14159265358979f;
  return Eigen::Vector3f(
      std::atan2(w.dot(n_t), n_s.dot(n_t)) / kPi, v.dot(n_t), n_s.dot(d));
}

Fpfh ComputeFpfh(const PointsRef& points,
                 const PointsRef& normals,
                 const Neighborhoods& neighborhoods,
                 int num_threads) {
  const Eigen::Index n = points.cols();
  Fpfh fpfh = Fpfh::Zero(kFpfhSize, n);
  if (n == 0) return fpfh;
  // Single precision about a point of the cloud, so that large coordinates keep
  // their digits.
  const Eigen::Vector3d center = points.col(n / 2);
  std::vector<OrientedPoint> oriented(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3f p = (points.col(i) - center).cast<float>();
    const Eigen::Vector3f normal = normals.col(i).cast<float>();
    oriented[static_cast<std::size_t>(i)] = {p.x(),
                                             p.y(),
                                             p.z(),
                                             normal.x(),
                                             normal.y(),
                                             normal.z(),
                                             !normal.isZero(0.0f)};
  }

  std::vector<Histogram> spfh(static_cast<std::size_t>(n));
  std::vector<std::int32_t> num_summed(static_cast<std::size_t>(n));
  ParallelFor(num_threads, n, 256, [&](Eigen::Index begin, Eigen::Index end) {
    Neighborhood around;
    for (auto i = static_cast<std::size_t>(begin);
         i < static_cast<std::size_t>(end);
         ++i) {
      if (!oriented[i].has_normal) continue;
      around.Gather(oriented, neighborhoods, i);
      FindBins(oriented[i],
               around.x.data(),
               around.y.data(),
               around.z.data(),
               around.nx.data(),
               around.ny.data(),
               around.nz.data(),
               around.size,
               around.bins.data());
      spfh[i] = CountBins(around.bins, around.size);
      num_summed[i] = around.num_apart;
    }
  });

  ParallelFor(num_threads, n, 256, [&](Eigen::Index begin, Eigen::Index end) {
    std::vector<float> weights;
    for (auto i = static_cast<std::size_t>(begin);
         i < static_cast<std::size_t>(end);
         ++i) {
      if (!oriented[i].has_normal) continue;
      // Equation (2).
      const Neighborhoods::Row& row =
          neighborhoods.row(static_cast<Eigen::Index>(i));
      weights.resize(std::max(weights.size(), row.size()));
      FindWeights(row.squared_distance.data(), row.size(), weights.data());
      Histogram sum;
      AddUp(spfh.data(), row.index.data(), weights.data(), row.size(), &sum);
      const std::int32_t num = num_summed[i];
      for (int part = 0; part < 3; ++part) {
        for (int bin = 0; bin < kFpfhBinsPerPart; ++bin) {
          float& mean = sum.part[part][bin];
          if (num > 0) mean /= static_cast<float>(num);
          mean += spfh[i].part[part][bin];
        }
      }
      NormalizeParts(100.0f, &sum);
      for (int part = 0; part < 3; ++part) {
        std::copy_n(
            sum.part[part],
            kFpfhBinsPerPart,
            &fpfh(part * kFpfhBinsPerPart, static_cast<Eigen::Index>(i)));
      }
    }
  });
  return fpfh;
}

}  // namespace quatro
