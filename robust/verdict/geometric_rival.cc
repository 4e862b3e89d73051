// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/geometric_rival.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <vector>

#include "features/base/degree.h"
#include "features/base/parallel.h"
#include "robust/verdict/structure_grid.h"

namespace quatro {
namespace {

constexpr double kMinTurn = 10.0 * kDegree;
constexpr double kMaxShift = 400.0;  // [voxel sizes]

// D of equation (1): a rotation about the middle, then a shift.
struct Move {
  double yaw = 0.0;                                 // [rad], in [-pi, pi].
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  // [m]: x along direction.
  double overlap = -1.0;
};

class Comparison {
 public:
  Comparison(const StructureGrid& source_grid,
             const StructureGrid& target_grid,
             const StructureSample& source_sample,
             const StructureSample& target_sample,
             const Rigid3& target_from_source,
             const Eigen::Vector3d& middle,
             const Eigen::Vector3d& direction)
      : source_grid_(source_grid),
        target_grid_(target_grid),
        source_sample_(source_sample),
        target_sample_(target_sample),
        target_from_source_(target_from_source),
        middle_(middle) {
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    axes_ << direction, up.cross(direction), up;
    Turn(0.0);
    Count(Eigen::Vector3d::Zero());
    pose_in_range_ = in_range_;
  }

  // Sets the rotation for the next calls of Count().
  void Turn(double yaw) {
    if (yaw == yaw_) return;
    yaw_ = yaw;
    turned_ = Moved({yaw});
    source_turned_ = target_grid_.Turn(source_sample_, turned_);
    target_turned_ = source_grid_.Turn(target_sample_, Inverse(turned_));
  }

  // Returns o(D X), or -1 if too few points are in range. If o(D X) is at most
  // `least_wanted`, may return any value up to `least_wanted`.
  double Count(const Eigen::Vector3d& shift, double least_wanted = -1.0) {
    const Eigen::Vector3d shift_in_target = InTarget(shift);
    const OverlapCount of_source =
        target_grid_.Count(source_turned_, shift_in_target);
    if (of_source.Share() <= least_wanted) return of_source.Share();
    const OverlapCount of_target = source_grid_.Count(
        target_turned_, -(turned_.rotation.transpose() * shift_in_target));
    in_range_ = {of_source.num_in_range, of_target.num_in_range};
    for (const std::size_t way : {0u, 1u}) {
      if (2 * in_range_[way] < pose_in_range_[way]) return -1.0;
    }
    return std::min(of_source.Share(), of_target.Share());
  }

  double Overlap(const Move& move) {
    Turn(move.yaw);
    return Count(move.shift);
  }

  Eigen::Vector3d InTarget(const Eigen::Vector3d& shift) const {
    return axes_ * shift;
  }

  Rigid3 Moved(const Move& move) const {
    const Eigen::Matrix3d turn = RotationZ(move.yaw);
    return Rigid3{turn, middle_ - turn * middle_ + InTarget(move.shift)} *
           target_from_source_;
  }

 private:
  const StructureGrid& source_grid_;
  const StructureGrid& target_grid_;
  const StructureSample& source_sample_;
  const StructureSample& target_sample_;
  Rigid3 target_from_source_;
  Eigen::Vector3d middle_;
  Eigen::Matrix3d axes_;
  double yaw_ = std::numeric_limits<double>::quiet_NaN();
  Rigid3 turned_;  // The pose after the rotation, before any shift.
  TurnedSample source_turned_;
  TurnedSample target_turned_;
  std::array<int, 2> in_range_{};
  std::array<int, 2> pose_in_range_{};
};

bool IsRival(const Comparison& comparison,
             const Move& move,
             const GeometricRivalOptions& options) {
  return (std::abs(move.yaw) > kMinTurn ||
          move.shift.head<2>().norm() > options.min_shift) &&
         options.bounds.Contain(comparison.Moved(move), 0.0);
}

// The best shift on a grid, and on a finer line along `direction`.
Move FindBestShift(Comparison& comparison,
                   double yaw,
                   double max_shift,
                   double step,
                   const GeometricRivalOptions& options) {
  Move best{yaw};
  comparison.Turn(yaw);
  const auto look = [&](double x, double y) {
    const Move move{yaw, {x, y, 0.0}};
    if (std::hypot(x, y) > max_shift || !IsRival(comparison, move, options)) {
      return;
    }
    const double overlap = comparison.Count(move.shift, best.overlap);
    if (overlap > best.overlap) best = {yaw, move.shift, overlap};
  };
  const int reach = static_cast<int>(max_shift / step);
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) look(i * step, j * step);
  }
  for (int i = -3 * reach; i <= 3 * reach; ++i) look(i * step / 3.0, 0.0);
  return best;
}

// Increases the overlap, one parameter after the other, by steps that are
// halved in each round.
Move Refine(Comparison& comparison,
            Move best,
            double step,
            const GeometricRivalOptions& options) {
  double yaw_step = 2.0 * kDegree;
  for (int round = 0; round < 3; ++round) {
    for (int parameter = 0; parameter < 4; ++parameter) {
      for (const double sign : {-1.0, 1.0}) {
        Move move = best;
        if (parameter < 3) {
          move.shift[parameter] += sign * step;
        } else {
          move.yaw = std::remainder(move.yaw + sign * yaw_step, 2.0 * M_PI);
        }
        if (!IsRival(comparison, move, options)) continue;
        move.overlap = comparison.Overlap(move);
        if (move.overlap > best.overlap) best = move;
      }
    }
    step *= 0.5;
    yaw_step *= 0.5;
  }
  return best;
}

}  // namespace

bool GeometricRivalOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(min_shift > 0.0 && std::isfinite(min_shift))) {
    problem << "evidence.rival.min_shift = " << min_shift
            << ", must be > 0 and finite";
  } else if (!(max_shift >= min_shift && max_shift <= kMaxShift)) {
    problem << "evidence.rival.max_shift = " << max_shift
            << ", must be in [min_shift, 400] = [" << min_shift << ", 400]";
  } else if (!(max_turned_shift >= 0.0 && max_turned_shift <= kMaxShift)) {
    problem << "evidence.rival.max_turned_shift = " << max_turned_shift
            << ", must be in [0, 400]";
  } else if (num_search_points < 1) {
    problem << "evidence.rival.num_search_points = " << num_search_points
            << ", must be >= 1";
  } else if (num_compared_points < 1) {
    problem << "evidence.rival.num_compared_points = " << num_compared_points
            << ", must be >= 1";
  }
  *error = problem.str();
  return error->empty() && bounds.IsValid(error);
}

GeometricRival FindGeometricRival(const DescribedCloud& source,
                                  const DescribedCloud& target,
                                  const Rigid3& target_from_source,
                                  const Eigen::Vector3d& middle,
                                  const Eigen::Vector3d& direction,
                                  double max_distance,
                                  double voxel_size,
                                  const GeometricRivalOptions& given,
                                  int num_threads) {
  GeometricRivalOptions options = given;
  for (double* shift :
       {&options.min_shift, &options.max_shift, &options.max_turned_shift}) {
    *shift *= voxel_size;  // [m] from here on.
  }
  std::optional<StructureGrid> source_grid;
  std::optional<StructureGrid> target_grid;
  ParallelDo(
      num_threads,
      [&] { source_grid.emplace(source, max_distance); },
      [&] { target_grid.emplace(target, max_distance); });
  const auto sample_both = [&](Eigen::Index num) {
    std::array<StructureSample, 2> samples;
    ParallelDo(
        num_threads,
        [&] { samples[0] = SampleStructure(source, num); },
        [&] { samples[1] = SampleStructure(target, num); });
    return samples;
  };
  const auto searched = sample_both(options.num_search_points);
  const auto compared = sample_both(options.num_compared_points);
  const auto compare = [&](const auto& samples) {
    return Comparison(*source_grid,
                      *target_grid,
                      samples[0],
                      samples[1],
                      target_from_source,
                      middle,
                      direction);
  };
  const Comparison search = compare(searched);
  const Comparison comparison = compare(compared);

  GeometricRival result;
  result.rival_target_from_source = target_from_source;
  result.overlap = std::max(0.0, Comparison(comparison).Overlap({}));
  // Steps of 1.5 max_distance leave no gap, because points overlap within
  // max_distance to either side.
  const double step = std::max(1.5 * max_distance, options.max_shift / 40.0);
  constexpr std::array kYaws = {0.0, M_PI, 0.5 * M_PI, -0.5 * M_PI};
  std::array<Move, kYaws.size()> best_of;
  const auto find_best = [&](std::size_t i) {
    const double max_shift =
        kYaws[i] == 0.0 ? options.max_shift : options.max_turned_shift;
    Comparison turned = search;
    Move& best = best_of[i];
    best = FindBestShift(turned, kYaws[i], max_shift, step, options);
    if (best.overlap < 0.0) return;
    best = Refine(turned, best, 0.5 * step, options);
    best.overlap = Comparison(comparison).Overlap(best);
  };
  ParallelFor(num_threads,
              static_cast<Eigen::Index>(kYaws.size()),
              1,
              [&](Eigen::Index begin, Eigen::Index end) {
                for (Eigen::Index i = begin; i < end; ++i) {
                  find_best(static_cast<std::size_t>(i));
                }
              });
  for (const Move& best : best_of) {
    if (best.overlap > result.rival_overlap) {
      result.rival_overlap = best.overlap;
      result.rival_target_from_source = comparison.Moved(best);
      result.yaw = best.yaw;
      result.shift = comparison.InTarget(best.shift);
    }
  }
  return result;
}

}  // namespace quatro
