// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/consensus_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <utility>

#include "features/base/parallel.h"
#include "solvers/closed_form/yaw_translation.h"

namespace quatro {
namespace {

// Cells are as wide as the bound. They repeat after a power of two in x and in
// y, which bounds the memory. Matches that share a cell only for that reason
// are separated by the refinement, where every match is compared with the pose.
constexpr int kMinNumCells = 256;
constexpr int kMaxNumCells = 1024;

constexpr int kNumPerYaw = 16;        // Cells kept per yaw, the fullest.
constexpr int kRefinedPerWanted = 2;  // Cells refined per proposal.
constexpr int kNumRefinements = 3;
constexpr Eigen::Index kYawsPerPiece = 16;

// The largest coordinate, in noise bounds, that single precision can compare
// with the bound.
constexpr double kMaxBounds = 1e5;

// A block of two by two cells, given by its lower corner.
struct Cell {
  int votes = 0;
  int yaw = 0;  // Index of the yaw step.
  int x = 0;
  int y = 0;
};

bool IsBefore(const Cell& a, const Cell& b) {
  if (a.votes != b.votes) return a.votes > b.votes;
  if (a.yaw != b.yaw) return a.yaw < b.yaw;
  return a.x != b.x ? a.x < b.x : a.y < b.y;
}

// The matches that can be compared, in noise bounds, relative to the middle of
// each cloud.
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

float Extent(const Points& points) {
  return static_cast<float>(points.topRows<2>().cwiseAbs().maxCoeff());
}

// One yaw step moves a point of typical range by one noise bound.
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

// The coordinates of all matches, row by row.
struct Rows {
  explicit Rows(const CenteredMatches& matches)
      : px(matches.source.row(0).cast<float>()),
        py(matches.source.row(1).cast<float>()),
        qx(matches.target.row(0).cast<float>()),
        qy(matches.target.row(1).cast<float>()),
        dz((matches.target.row(2) - matches.source.row(2)).cast<float>()),
        range((px.square() + py.square()).sqrt()) {}

  Eigen::ArrayXf px, py, qx, qy;
  Eigen::ArrayXf dz;     // q_z - p_z
  Eigen::ArrayXf range;  // |p_xy|
};

// Votes of all matches at one yaw, and the fullest blocks of two by two cells.
class Ballot {
 public:
  // Coordinates of translations are less than `extent`.
  Ballot(const Rows& rows, int num_cells, float extent)
      : rows_(rows),
        shift_(std::countr_zero(static_cast<unsigned>(num_cells))),
        offset_(std::exp2(std::ceil(std::log2(extent + 1.0f)))),
        cells_(static_cast<std::size_t>(rows.px.size())),
        votes_(static_cast<std::size_t>(num_cells) *
               static_cast<std::size_t>(num_cells)) {}

  // Appends the fullest blocks of at least three votes, the fullest first.
  void Count(double yaw, int step, std::vector<Cell>* fullest) {
    const auto c = static_cast<float>(std::cos(yaw));
    const auto s = static_cast<float>(std::sin(yaw));
    // A conversion rounds toward 0, so the offset keeps the values positive.
    x_ = (rows_.qx - c * rows_.px + s * rows_.py + offset_).cast<int>();
    y_ = (rows_.qy - s * rows_.px - c * rows_.py + offset_).cast<int>();
    const auto mask = static_cast<std::uint32_t>(votes_.size() - 1);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      cells_[i] = static_cast<std::uint32_t>((x_[k] << shift_) + y_[k]) & mask;
    }
    for (const std::uint32_t cell : cells_) ++votes_[cell];
    int least = 3;
    const std::size_t begin = fullest->size();
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      // The fullest cell of a block has at least a quarter of its votes.
      if (4 * votes_[cells_[i]] < least) continue;
      if (NumVotesAround(cells_[i]) < least) continue;
      const Cells around = CellsAround(cells_[i]);
      const auto k = static_cast<Eigen::Index>(i);
      const int x = x_[k] - static_cast<int>(offset_);
      const int y = y_[k] - static_cast<int>(offset_);
      // The four blocks that the cell is part of.
      for (const int dx : {0, 1}) {
        for (const int dy : {0, 1}) {
          const auto block = around.block<2, 2>(dx, dy);
          const int votes = block.sum();
          if (votes < least || !IsFullest(block, 1 - dx, 1 - dy)) continue;
          fullest->push_back({votes, step, x - 1 + dx, y - 1 + dy});
          if (fullest->size() - begin >= 8 * kNumPerYaw) {
            Keep(begin, fullest);
            if (fullest->size() - begin == kNumPerYaw) {
              least = fullest->back().votes;
            }
          }
        }
      }
    }
    Keep(begin, fullest);
    for (const std::uint32_t cell : cells_) votes_[cell] = 0;
  }

 private:
  using Cells = Eigen::Matrix<int, 3, 3>;

  std::uint16_t At(std::uint32_t cell) const {
    return votes_[cell & (votes_.size() - 1)];
  }

  // The sum of CellsAround(), which leaves most matches out.
  int NumVotesAround(std::uint32_t middle) const {
    const std::uint32_t n = 1u << shift_;
    if (middle <= n || middle + n + 1 >= votes_.size()) {
      return CellsAround(middle).sum();
    }
    int sum = 0;
    for (const std::uint32_t row : {middle - n, middle, middle + n}) {
      sum += votes_[row - 1] + votes_[row] + votes_[row + 1];
    }
    return sum;
  }

  // The votes of three by three cells, by their middle.
  Cells CellsAround(std::uint32_t middle) const {
    const std::uint32_t n = 1u << shift_;
    Cells around;
    around << At(middle - n - 1), At(middle - n), At(middle - n + 1),
        At(middle - 1), At(middle), At(middle + 1), At(middle + n - 1),
        At(middle + n), At(middle + n + 1);
    return around;
  }

  // Whether (x, y) is the first of the fullest cells of the block. A block is
  // found by the matches of that cell only.
  template <typename Block>
  static bool IsFullest(const Block& block, int x, int y) {
    for (int k = 0; k < 4; ++k) {
      const int votes = block(k / 2, k % 2);
      if (k < 2 * x + y ? votes >= block(x, y) : votes > block(x, y)) {
        return false;
      }
    }
    return true;
  }

  // The fullest, each once: all matches of its fullest cell found it.
  static void Keep(std::size_t begin, std::vector<Cell>* fullest) {
    const auto first = fullest->begin() + static_cast<std::ptrdiff_t>(begin);
    std::sort(first, fullest->end(), IsBefore);
    fullest->erase(std::unique(first,
                               fullest->end(),
                               [](const Cell& a, const Cell& b) {
                                 return !IsBefore(a, b);
                               }),
                   fullest->end());
    fullest->resize(std::min(fullest->size(), begin + kNumPerYaw));
  }

  const Rows& rows_;
  int shift_;  // The binary logarithm of num_cells.
  float offset_;
  Eigen::ArrayXi x_, y_;
  std::vector<std::uint32_t> cells_;  // Of the matches, modulo the size.

  // Cell x num_cells + y, modulo the size; all 0 between counts.
  std::vector<std::uint16_t> votes_;
};

// Leaves out blocks that are next to a fuller one in yaw and position, because
// they would be refined to the same pose. `cells` are sorted.
std::vector<Cell> WithoutNeighbors(const std::vector<Cell>& cells,
                                   int num_yaws,
                                   std::size_t num_wanted) {
  std::vector<Cell> kept;
  for (const Cell& cell : cells) {
    const bool has_neighbor =
        std::any_of(kept.begin(), kept.end(), [&](const Cell& other) {
          const int turn = std::abs(cell.yaw - other.yaw);
          return std::min(turn, num_yaws - turn) <= 1 &&
                 std::abs(cell.x - other.x) <= 1 &&
                 std::abs(cell.y - other.y) <= 1;
        });
    if (!has_neighbor) kept.push_back(cell);
    if (kept.size() == num_wanted) break;
  }
  return kept;
}

// A refined cell, in noise bounds and relative to the middles.
struct Refined {
  double yaw = 0.0;
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  std::vector<Eigen::Index> inliers;  // Columns of the centered matches.
  double ratio = 0.0;                 // (3)
};

// The middle of the first interval on which the most intervals [value - reach,
// value + reach] overlap.
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
             const Rows& rows,
             const ConsensusSearchOptions& options)
      : matches_(matches),
        rows_(rows),
        reach_(1.0f +
               static_cast<float>(std::tan(options.max_tilt)) * rows.range),
        share_(rows.range.unaryExpr([](float range) {
          return range > 1.0f
                     ? std::asin(1.0f / range) / static_cast<float>(M_PI)
                     : 0.5f;
        })) {}

  // The inliers and (3) of a pose whose yaw is 0.
  Refined At(const Eigen::Vector3d& translation) const {
    Refined refined;
    refined.translation = translation;
    Collect(FindNear(1.0, refined), 1.0, &refined);
    refined.ratio = LogLikelihoodRatio(refined);
    return refined;
  }

  // Returns nullopt if fewer than two matches are near, or if they do not
  // determine a yaw.
  std::optional<Refined> At(double yaw, double x, double y) const {
    Refined refined;
    refined.yaw = yaw;
    refined.translation << x, y, 0.0;
    const std::vector<Eigen::Index> near = FindNear(1.5, refined);
    if (near.size() < 2) return std::nullopt;
    refined.translation.z() = FindHeight(near);
    Collect(near, 1.5, &refined);
    for (int round = 0; round < kNumRefinements; ++round) {
      if (!Fit(&refined)) return std::nullopt;
      Collect(FindNear(1.0, refined), 1.0, &refined);
    }
    refined.ratio = LogLikelihoodRatio(refined);
    return refined;
  }

 private:
  // The matches with |e_xy| <= bound, in single precision.
  std::vector<Eigen::Index> FindNear(double bound,
                                     const Refined& refined) const {
    const auto c = static_cast<float>(std::cos(refined.yaw));
    const auto s = static_cast<float>(std::sin(refined.yaw));
    const auto x = static_cast<float>(refined.translation.x());
    const auto y = static_cast<float>(refined.translation.y());
    const auto squared_bound = static_cast<float>(bound * bound);
    std::vector<Eigen::Index> near;
    // Few are near, so most pieces are left out as a whole.
    constexpr Eigen::Index kPieceSize = 64;
    Eigen::Array<float, Eigen::Dynamic, 1, 0, kPieceSize, 1> squares;
    for (Eigen::Index begin = 0; begin < rows_.px.size(); begin += kPieceSize) {
      const Eigen::Index n = std::min(kPieceSize, rows_.px.size() - begin);
      const auto px = rows_.px.segment(begin, n);
      const auto py = rows_.py.segment(begin, n);
      squares = (rows_.qx.segment(begin, n) - c * px + s * py - x).square() +
                (rows_.qy.segment(begin, n) - s * px - c * py - y).square();
      if (squares.minCoeff() > squared_bound) continue;
      for (Eigen::Index i = 0; i < n; ++i) {
        if (squares[i] <= squared_bound) near.push_back(begin + i);
      }
    }
    return near;
  }

  double FindHeight(const std::vector<Eigen::Index>& near) const {
    std::vector<std::pair<double, double>> heights;
    heights.reserve(near.size());
    for (const Eigen::Index i : near) {
      heights.emplace_back(rows_.dz[i], reach_[i]);
    }
    return Stab(heights);
  }

  void Collect(const std::vector<Eigen::Index>& near,
               double bound,
               Refined* refined) const {
    const double cosine = std::cos(refined->yaw);
    const double sine = std::sin(refined->yaw);
    refined->inliers.clear();
    for (const Eigen::Index i : near) {
      const auto p = matches_.source.col(i);
      const auto q = matches_.target.col(i);
      const Eigen::Vector3d error(
          q.x() - cosine * p.x() + sine * p.y() - refined->translation.x(),
          q.y() - sine * p.x() - cosine * p.y() - refined->translation.y(),
          q.z() - p.z() - refined->translation.z());
      if (error.head<2>().norm() <= bound && std::abs(error.z()) <= reach_[i]) {
        refined->inliers.push_back(i);
      }
    }
  }

  // Fits the pose to its inliers by least squares.
  bool Fit(Refined* refined) const {
    const auto num = static_cast<Eigen::Index>(refined->inliers.size());
    Points p(3, num), q(3, num);
    for (Eigen::Index k = 0; k < num; ++k) {
      const Eigen::Index i = refined->inliers[static_cast<std::size_t>(k)];
      p.col(k) = matches_.source.col(i);
      q.col(k) = matches_.target.col(i);
    }
    const auto estimate = EstimateYawTranslation(p, q, Weights::Ones(num));
    if (!estimate) return false;
    refined->yaw = estimate->yaw;
    refined->translation = estimate->target_from_source.translation;
    return true;
  }

  // Equations (2) and (3). A match is an inlier at a share of asin(1 / |p|) /
  // pi of all yaws, if | |q - t| - |p| | <= 1.
  double LogLikelihoodRatio(const Refined& refined) const {
    const auto x = static_cast<float>(refined.translation.x());
    const auto y = static_cast<float>(refined.translation.y());
    const auto z = static_cast<float>(refined.translation.z());
    const Eigen::ArrayXf distance =
        ((rows_.qx - x).square() + (rows_.qy - y).square()).sqrt();
    const double expected =
        std::max(0.1f,
                 ((distance - rows_.range).abs() <= 1.0f &&
                  (rows_.dz - z).abs() <= reach_)
                     .select(share_, Eigen::ArrayXf::Zero(share_.size()))
                     .sum());
    const auto votes = static_cast<double>(refined.inliers.size());
    return votes > expected
               ? votes * std::log(votes / expected) - (votes - expected)
               : 0.0;
  }

  const CenteredMatches& matches_;
  const Rows& rows_;
  const Eigen::ArrayXf reach_;  // The bounds of |e_z|.
  const Eigen::ArrayXf share_;  // The shares of yaws for (2).
};

// The fullest cells of all yaws that are not neighbors, the fullest first.
std::vector<Cell> FindFullest(const CenteredMatches& matches,
                              const Rows& rows,
                              int num_yaws,
                              const ConsensusSearchOptions& options) {
  const float extent = Extent(matches.source) + Extent(matches.target);
  int num_cells = kMinNumCells;
  while (num_cells < kMaxNumCells && static_cast<float>(num_cells) < extent) {
    num_cells *= 2;
  }
  const double yaw_step = 2.0 * M_PI / num_yaws;
  std::vector<std::vector<Cell>> cells_of(
      static_cast<std::size_t>((num_yaws + kYawsPerPiece - 1) / kYawsPerPiece));
  ParallelFor(
      options.num_threads,
      num_yaws,
      kYawsPerPiece,
      [&](Eigen::Index begin, Eigen::Index end) {
        Ballot ballot(rows, num_cells, extent);
        for (Eigen::Index k = begin; k < end; ++k) {
          ballot.Count(
              static_cast<double>(k) * yaw_step,
              static_cast<int>(k),
              &cells_of[static_cast<std::size_t>(begin / kYawsPerPiece)]);
        }
      });
  std::vector<Cell> all;
  for (const auto& some : cells_of) {
    all.insert(all.end(), some.begin(), some.end());
  }
  std::sort(all.begin(), all.end(), IsBefore);
  return WithoutNeighbors(
      all,
      num_yaws,
      static_cast<std::size_t>(kRefinedPerWanted * options.max_num_proposals));
}

// The most significant poses that differ from each other, the best first.
std::vector<const Refined*> Separate(
    const std::vector<std::optional<Refined>>& refined,
    const ConsensusSearchOptions& options) {
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
    if (is_new) kept.push_back(one);
    if (static_cast<int>(kept.size()) == options.max_num_proposals) break;
  }
  return kept;
}

// The proposal in the units and frames of the input.
Proposal ProposalFrom(const Refined& refined,
                      const CenteredMatches& matches,
                      double noise_bound) {
  Proposal proposal;
  const Eigen::Matrix3d rotation = RotationZ(refined.yaw);
  proposal.target_from_source = {rotation,
                                 matches.target_middle +
                                     noise_bound * refined.translation -
                                     rotation * matches.source_middle};
  for (const Eigen::Index i : refined.inliers) {
    proposal.inliers.push_back(matches.columns[static_cast<std::size_t>(i)]);
  }
  proposal.log_likelihood_ratio = refined.ratio;
  return proposal;
}

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

  const Rows rows(matches);
  const int num_yaws = NumYaws(matches);
  const double yaw_step = 2.0 * M_PI / num_yaws;
  const std::vector<Cell> cells = FindFullest(matches, rows, num_yaws, options);
  const Refinement refinement(matches, rows, options);
  std::vector<std::optional<Refined>> refined(cells.size());
  ParallelFor(options.num_threads,
              static_cast<Eigen::Index>(cells.size()),
              16,
              [&](Eigen::Index begin, Eigen::Index end) {
                for (Eigen::Index k = begin; k < end; ++k) {
                  const Cell& cell = cells[static_cast<std::size_t>(k)];
                  refined[static_cast<std::size_t>(k)] = refinement.At(
                      cell.yaw * yaw_step, cell.x + 1.0, cell.y + 1.0);
                }
              });

  for (const Refined* one : Separate(refined, options)) {
    proposals.push_back(ProposalFrom(*one, matches, options.noise_bound));
  }
  return proposals;
}

double ConsensusLogLikelihoodRatio(const PointsRef& source,
                                   const PointsRef& target,
                                   const Rigid3& target_from_source,
                                   const ConsensusSearchOptions& options) {
  const Eigen::Matrix3d& rotation = target_from_source.rotation;
  ConsensusSearchOptions turned = options;
  turned.max_tilt = 0.0;
  if (options.source_center) {
    turned.source_center = rotation * *options.source_center;
  }
  const CenteredMatches matches = Center(rotation * source, target, turned);
  if (matches.source.cols() == 0) return 0.0;
  const Rows rows(matches);
  const Eigen::Vector3d moved_middle =
      matches.source_middle + target_from_source.translation;
  return Refinement(matches, rows, turned)
      .At((moved_middle - matches.target_middle) / options.noise_bound)
      .ratio;
}

}  // namespace quatro
