// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/consensus_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <utility>

#include "features/base/parallel.h"
#include "solvers/closed_form/yaw_translation.h"

namespace quatro {
namespace {

// Cells are as wide as the bound. They repeat after kNumCells in x and in y,
// which bounds the memory; what coincides by that alone is lost in the
// refinement, where every match is compared with the pose itself.
constexpr int kNumCells = 512;
constexpr std::size_t kMask = kNumCells - 1;

constexpr int kNumPerYaw = 16;        // Fullest cells of one yaw that are kept.
constexpr int kRefinedPerWanted = 4;  // Refined for each proposal wanted.
constexpr int kNumRefinements = 3;
constexpr Eigen::Index kYawsPerPiece = 8;

// A farther coordinate cannot be compared with the bound [r].
constexpr double kMaxBounds = 1e9;

// The fullest cells of a yaw.
struct Cell {
  int votes = 0;
  int yaw = 0;  // The step.
  std::uint32_t x = 0;
  std::uint32_t y = 0;
};

bool IsBefore(const Cell& a, const Cell& b) {
  if (a.votes != b.votes) return a.votes > b.votes;
  if (a.yaw != b.yaw) return a.yaw < b.yaw;
  return a.x != b.x ? a.x < b.x : a.y < b.y;
}

// The matches that can be compared, in bounds, from the middle of each cloud.
struct CenteredMatches {
  std::vector<Eigen::Index> columns;
  Points source;
  Points target;
  Eigen::Vector3d source_middle;  // [m]
  Eigen::Vector3d target_middle;
};

Eigen::Vector3d Median(const PointsRef& points) {
  Eigen::Vector3d median;
  std::vector<double> values(static_cast<std::size_t>(points.cols()));
  for (int axis = 0; axis < 3; ++axis) {
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      values[static_cast<std::size_t>(i)] = points(axis, i);
    }
    const auto middle =
        values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    median[axis] = *middle;
  }
  return median;
}

CenteredMatches Center(const PointsRef& source,
                       const PointsRef& target,
                       const ConsensusSearchOptions& options) {
  CenteredMatches matches;
  matches.source_middle = options.source_center.value_or(Median(source));
  matches.target_middle = options.target_center.value_or(Median(target));
  matches.source.resize(3, source.cols());
  matches.target.resize(3, source.cols());
  Eigen::Index n = 0;
  for (Eigen::Index i = 0; i < source.cols(); ++i) {
    const Eigen::Vector3d p =
        (source.col(i) - matches.source_middle) / options.noise_bound;
    const Eigen::Vector3d q =
        (target.col(i) - matches.target_middle) / options.noise_bound;
    if (!(p.cwiseAbs().maxCoeff() < kMaxBounds &&
          q.cwiseAbs().maxCoeff() < kMaxBounds)) {
      continue;
    }
    matches.source.col(n) = p;
    matches.target.col(n) = q;
    matches.columns.push_back(i);
    ++n;
  }
  matches.source.conservativeResize(3, n);
  matches.target.conservativeResize(3, n);
  return matches;
}

// A turn of one step moves a point of typical range by one bound.
int NumYaws(const CenteredMatches& matches) {
  std::vector<double> ranges(static_cast<std::size_t>(matches.source.cols()));
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    ranges[i] =
        matches.source.col(static_cast<Eigen::Index>(i)).head<2>().norm();
  }
  const auto at =
      ranges.begin() + static_cast<std::ptrdiff_t>(3 * ranges.size() / 4);
  std::nth_element(ranges.begin(), at, ranges.end());
  return static_cast<int>(std::clamp(2.0 * M_PI * *at, 60.0, 720.0));
}

// Votes of all matches at one yaw, and the fullest blocks of two by two cells.
class Ballot {
 public:
  explicit Ballot(const CenteredMatches& matches)
      : source_(matches.source.topRows<2>().cast<float>()),
        target_(matches.target.topRows<2>().cast<float>()),
        corners_(static_cast<std::size_t>(source_.cols())),
        votes_(kNumCells * kNumCells) {}

  void Count(double yaw, int step, std::vector<Cell>* fullest) {
    const auto cosine = static_cast<float>(std::cos(yaw));
    const auto sine = static_cast<float>(std::sin(yaw));
    std::fill(votes_.begin(), votes_.end(), std::uint16_t{0});
    for (Eigen::Index i = 0; i < source_.cols(); ++i) {
      const float x =
          target_(0, i) - cosine * source_(0, i) + sine * source_(1, i);
      const float y =
          target_(1, i) - sine * source_(0, i) - cosine * source_(1, i);
      const auto at_x =
          static_cast<std::size_t>(static_cast<std::int64_t>(std::floor(x)));
      const auto at_y =
          static_cast<std::size_t>(static_cast<std::int64_t>(std::floor(y)));
      const std::array<std::size_t, 2> rows = {
          (at_x & kMask) * kNumCells, ((at_x - 1) & kMask) * kNumCells};
      const std::array<std::size_t, 2> columns = {at_y & kMask,
                                                  (at_y - 1) & kMask};
      corners_[static_cast<std::size_t>(i)] = {rows, columns};
      for (const std::size_t row : rows) {
        for (const std::size_t column : columns) ++votes_[row + column];
      }
    }
    int least = 2;
    const std::size_t begin = fullest->size();
    for (const auto& [rows, columns] : corners_) {
      for (const std::size_t row : rows) {
        for (const std::size_t column : columns) {
          std::uint16_t& votes = votes_[row + column];
          if (votes < least) continue;
          fullest->push_back({votes,
                              step,
                              static_cast<std::uint32_t>(row / kNumCells),
                              static_cast<std::uint32_t>(column)});
          votes = 0;
          if (fullest->size() - begin >= 8 * kNumPerYaw) {
            Keep(begin, fullest);
            least = fullest->back().votes;
          }
        }
      }
    }
    Keep(begin, fullest);
  }

 private:
  struct Corners {
    std::array<std::size_t, 2> rows;
    std::array<std::size_t, 2> columns;
  };

  static void Keep(std::size_t begin, std::vector<Cell>* fullest) {
    const auto first = fullest->begin() + static_cast<std::ptrdiff_t>(begin);
    std::sort(first, fullest->end(), IsBefore);
    fullest->resize(std::min(fullest->size(), begin + kNumPerYaw));
  }

  Eigen::Matrix2Xf source_;
  Eigen::Matrix2Xf target_;
  std::vector<Corners> corners_;
  std::vector<std::uint16_t> votes_;  // y fastest.
};

// One cell, refined: in bounds, from the middles.
struct Refined {
  double yaw = 0.0;
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  std::vector<Eigen::Index> inliers;  // Of the centered matches.
  double ratio = 0.0;                 // (3)
};

// The offset on which most of the intervals [value - reach, value + reach]
// overlap: the middle of the place where they do.
double Stab(const std::vector<std::pair<double, double>>& value_and_reach) {
  std::vector<std::pair<double, int>> ends;
  ends.reserve(2 * value_and_reach.size());
  for (const auto& [value, reach] : value_and_reach) {
    ends.emplace_back(value - reach, -1);
    ends.emplace_back(value + reach, 1);
  }
  std::sort(ends.begin(), ends.end());
  int open = 0;
  int most = 0;
  double best = 0.0;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    open -= ends[k].second;
    if (open > most) {
      most = open;
      best = 0.5 * (ends[k].first + ends[k + 1].first);
    }
  }
  return best;
}

class Refinement {
 public:
  Refinement(const CenteredMatches& matches,
             const ConsensusSearchOptions& options)
      : matches_(matches), slope_(std::tan(options.max_tilt)) {}

  // Nullopt if the cell is empty, or its matches do not determine a yaw.
  std::optional<Refined> At(double yaw, double x, double y) const {
    Refined refined;
    refined.yaw = yaw;
    refined.translation << x, y, 0.0;
    double bound = 1.5;
    if (!FindHeight(bound, &refined)) return std::nullopt;
    for (int round = 0; round < kNumRefinements; ++round) {
      Collect(bound, &refined);
      const auto num = static_cast<Eigen::Index>(refined.inliers.size());
      if (num < 2) return std::nullopt;
      Points p(3, num), q(3, num);
      for (Eigen::Index k = 0; k < num; ++k) {
        const Eigen::Index i = refined.inliers[static_cast<std::size_t>(k)];
        p.col(k) = matches_.source.col(i);
        q.col(k) = matches_.target.col(i);
      }
      const auto estimate = EstimateYawTranslation(p, q, Weights::Ones(num));
      if (!estimate) return std::nullopt;
      refined.yaw = estimate->yaw;
      refined.translation = estimate->target_from_source.translation;
      bound = 1.0;
    }
    Collect(bound, &refined);
    refined.ratio = LogLikelihoodRatio(refined);
    return refined;
  }

 private:
  Eigen::Vector2d Turned(Eigen::Index i, double cosine, double sine) const {
    const auto p = matches_.source.col(i);
    return {cosine * p.x() - sine * p.y(), sine * p.x() + cosine * p.y()};
  }

  double Reach(Eigen::Index i) const {
    return 1.0 + slope_ * matches_.source.col(i).head<2>().norm();
  }

  bool FindHeight(double bound, Refined* refined) const {
    std::vector<std::pair<double, double>> heights;
    ForNear(bound, *refined, [&](Eigen::Index i) {
      heights.emplace_back(matches_.target(2, i) - matches_.source(2, i),
                           Reach(i));
    });
    if (heights.size() < 2) return false;
    refined->translation.z() = Stab(heights);
    return true;
  }

  void Collect(double bound, Refined* refined) const {
    refined->inliers.clear();
    ForNear(bound, *refined, [&](Eigen::Index i) {
      const double error = matches_.target(2, i) - matches_.source(2, i) -
                           refined->translation.z();
      if (std::abs(error) <= Reach(i)) refined->inliers.push_back(i);
    });
  }

  template <typename Visit>
  void ForNear(double bound, const Refined& refined, const Visit& visit) const {
    const double cosine = std::cos(refined.yaw);
    const double sine = std::sin(refined.yaw);
    const Eigen::Vector2d shift = refined.translation.head<2>();
    for (Eigen::Index i = 0; i < matches_.source.cols(); ++i) {
      const Eigen::Vector2d error =
          matches_.target.col(i).head<2>() - Turned(i, cosine, sine) - shift;
      if (error.squaredNorm() <= bound * bound) visit(i);
    }
  }

  // (2) and (3). A match is an inlier at a share of about asin(1 / |p|) / pi of
  // all yaws, provided that | |q - t| - |p| | <= 1.
  double LogLikelihoodRatio(const Refined& refined) const {
    const Eigen::Vector2d shift = refined.translation.head<2>();
    double expected = 0.0;
    for (Eigen::Index i = 0; i < matches_.source.cols(); ++i) {
      const double p = matches_.source.col(i).head<2>().norm();
      const double q = (matches_.target.col(i).head<2>() - shift).norm();
      if (std::abs(q - p) > 1.0) continue;
      const double error = matches_.target(2, i) - matches_.source(2, i) -
                           refined.translation.z();
      if (std::abs(error) > Reach(i)) continue;
      expected += p > 1.0 ? std::asin(1.0 / p) / M_PI : 0.5;
    }
    const auto votes = static_cast<double>(refined.inliers.size());
    expected = std::max(expected, 0.1);
    return votes > expected
               ? votes * std::log(votes / expected) - (votes - expected)
               : 0.0;
  }

  const CenteredMatches& matches_;
  const double slope_;
};

}  // namespace

bool ConsensusSearchOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(noise_bound > 0.0 && std::isfinite(noise_bound))) {
    problem << "noise_bound = " << noise_bound << ", must be > 0 and finite";
  } else if (!(max_tilt >= 0.0 && max_tilt <= M_PI / 4.0)) {
    problem << "max_tilt = " << max_tilt << ", must be in [0, pi/4]";
  } else if (max_num_proposals < 1) {
    problem << "max_num_proposals = " << max_num_proposals << ", must be >= 1";
  } else if (!(min_yaw_difference >= 0.0) || !(min_shift_in_bounds >= 0.0)) {
    problem << "min_yaw_difference and min_shift_in_bounds must be >= 0";
  } else if (num_threads < 0) {
    problem << "num_threads = " << num_threads << ", must be >= 0";
  }
  *error = problem.str();
  return error->empty();
}

std::vector<Proposal> SearchConsensus(const PointsRef& source,
                                      const PointsRef& target,
                                      const ConsensusSearchOptions& options) {
  std::vector<Proposal> proposals;
  if (source.cols() < 2) return proposals;
  const CenteredMatches matches = Center(source, target, options);
  if (matches.source.cols() < 2) return proposals;

  const int num_yaws = NumYaws(matches);
  const double yaw_step = 2.0 * M_PI / num_yaws;
  std::vector<std::vector<Cell>> cells_of(
      static_cast<std::size_t>((num_yaws + kYawsPerPiece - 1) / kYawsPerPiece));
  ParallelFor(
      options.num_threads,
      num_yaws,
      kYawsPerPiece,
      [&](Eigen::Index begin, Eigen::Index end) {
        Ballot ballot(matches);
        for (Eigen::Index k = begin; k < end; ++k) {
          ballot.Count(
              static_cast<double>(k) * yaw_step,
              static_cast<int>(k),
              &cells_of[static_cast<std::size_t>(begin / kYawsPerPiece)]);
        }
      });
  std::vector<Cell> cells;
  for (const auto& some : cells_of) {
    cells.insert(cells.end(), some.begin(), some.end());
  }
  std::sort(cells.begin(), cells.end(), IsBefore);
  cells.resize(std::min(
      cells.size(),
      static_cast<std::size_t>(kRefinedPerWanted * options.max_num_proposals)));

  const Refinement refinement(matches, options);
  std::vector<std::optional<Refined>> refined(cells.size());
  ParallelFor(options.num_threads,
              static_cast<Eigen::Index>(cells.size()),
              16,
              [&](Eigen::Index begin, Eigen::Index end) {
                for (Eigen::Index k = begin; k < end; ++k) {
                  const Cell& cell = cells[static_cast<std::size_t>(k)];
                  // The corner that four cells share.
                  const auto middle = [](std::uint32_t at) {
                    const int signed_at = static_cast<int>(at);
                    return (signed_at < kNumCells / 2 ? signed_at
                                                      : signed_at - kNumCells) +
                           1.0;
                  };
                  refined[static_cast<std::size_t>(k)] = refinement.At(
                      cell.yaw * yaw_step, middle(cell.x), middle(cell.y));
                }
              });

  std::vector<const Refined*> order;
  for (const auto& one : refined) {
    if (one) order.push_back(&*one);
  }
  std::stable_sort(
      order.begin(), order.end(), [](const Refined* a, const Refined* b) {
        return a->ratio > b->ratio;
      });
  std::vector<const Refined*> kept;
  for (const Refined* one : order) {
    const bool is_new =
        std::none_of(kept.begin(), kept.end(), [&](const Refined* other) {
          return std::abs(std::remainder(one->yaw - other->yaw, 2.0 * M_PI)) <=
                     options.min_yaw_difference &&
                 (one->translation - other->translation).norm() <=
                     options.min_shift_in_bounds;
        });
    if (!is_new) continue;
    kept.push_back(one);
    Proposal proposal;
    proposal.origin = "consensus";
    const Eigen::Matrix3d rotation = RotationZ(one->yaw);
    proposal.target_from_source = {rotation,
                                   matches.target_middle +
                                       options.noise_bound * one->translation -
                                       rotation * matches.source_middle};
    for (const Eigen::Index i : one->inliers) {
      proposal.inliers.push_back(matches.columns[static_cast<std::size_t>(i)]);
    }
    proposal.log_likelihood_ratio = one->ratio;
    proposals.push_back(std::move(proposal));
    if (static_cast<int>(proposals.size()) == options.max_num_proposals) break;
  }
  return proposals;
}

}  // namespace quatro
