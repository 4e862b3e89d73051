// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/fpfh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "features/parallel.h"

namespace quatro {
namespace {

// Cosines to the line that differ less than this are equal but for rounding.
constexpr float kEqualCosines = 1e-5f;

// Sine of the angle between line and normal, below which v in (1) is rounding.
constexpr float kMinSine = 1e-4f;

int Bin(float f) {
  const int bin = static_cast<int>((f + 1.0f) * 0.5f * kFpfhBinsPerPart);
  return std::clamp(bin, 0, kFpfhBinsPerPart - 1);
}

// Each part of 11 bins to this sum; a part without mass is left at zero.
void NormalizeParts(float sum, Eigen::Ref<Eigen::VectorXf> histogram) {
  for (int part = 0; part < 3; ++part) {
    auto bins = histogram.segment<kFpfhBinsPerPart>(part * kFpfhBinsPerPart);
    const float mass = bins.sum();
    if (mass > 0.0f) bins *= sum / mass;
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
  const Eigen::Matrix3Xf p = (points.colwise() - center).cast<float>();
  const Eigen::Matrix3Xf normal = normals.cast<float>();
  const auto has_normal = [&](Eigen::Index i) {
    return !normal.col(i).isZero(0.0f);
  };
  const auto for_each_neighbor = [&](Eigen::Index i, const auto& visit) {
    const auto row = static_cast<std::size_t>(i);
    const auto end = static_cast<std::size_t>(neighborhoods.row_begin[row + 1]);
    for (auto k = static_cast<std::size_t>(neighborhoods.row_begin[row]);
         k < end;
         ++k) {
      const Eigen::Index j = neighborhoods.index[k];
      if (j != i && has_normal(j)) visit(j, neighborhoods.squared_distance[k]);
    }
  };

  Fpfh spfh = Fpfh::Zero(kFpfhSize, n);
  ParallelFor(num_threads, n, 256, [&](Eigen::Index begin, Eigen::Index end) {
    for (Eigen::Index i = begin; i < end; ++i) {
      if (!has_normal(i)) continue;
      for_each_neighbor(i, [&](Eigen::Index j, float) {
        const auto feature = ComputePairFeature(
            p.col(i), normal.col(i), p.col(j), normal.col(j));
        if (!feature) return;
        for (int part = 0; part < 3; ++part) {
          spfh(part * kFpfhBinsPerPart + Bin((*feature)[part]), i) += 1.0f;
        }
      });
      NormalizeParts(1.0f, spfh.col(i));
    }
  });

  ParallelFor(num_threads, n, 256, [&](Eigen::Index begin, Eigen::Index end) {
    for (Eigen::Index i = begin; i < end; ++i) {
      if (!has_normal(i)) continue;
      // Equation (2).
      Eigen::Matrix<float, kFpfhSize, 1> sum;
      sum.setZero();
      int k = 0;
      for_each_neighbor(i, [&](Eigen::Index j, float squared_distance) {
        if (!(squared_distance > 0.0f)) return;
        sum += spfh.col(j) / std::sqrt(squared_distance);
        ++k;
      });
      if (k > 0) sum /= static_cast<float>(k);
      fpfh.col(i) = spfh.col(i) + sum;
      NormalizeParts(100.0f, fpfh.col(i));
    }
  });
  return fpfh;
}

}  // namespace quatro
