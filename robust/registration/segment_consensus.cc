// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/segment_consensus.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "features/base/degree.h"

namespace quatro {
namespace {

constexpr int kNumYaws = 180;
constexpr double kMaxWallTurn = 3.0 * kDegree;  // The error of a normal.
constexpr double kMinOverlap = 4.0;             // Of two walls [noise bounds].
constexpr double kFullOverlap = 15.0;  // From here on, walls count fully.
constexpr double kWallVotes = 2.0;     // Of two walls that count fully.
constexpr double kMaxHeightRatio = 2.5;
constexpr double kMinMean = 0.5;       // Of lambda.
constexpr float kMinVotes = 3.0f;      // Of a cell that is kept.
constexpr std::size_t kNumPerYaw = 8;  // Cells kept per yaw, the fullest.
constexpr int kNumFits = 3;
constexpr double kMaxHalf = 1024.0;  // Cells from the middle to the border.

double AngleDifference(double a, double b) {
  return std::remainder(a - b, 2.0 * M_PI);
}

double AzimuthOf(const Eigen::Vector2d& v) { return std::atan2(v.y(), v.x()); }

double YawOf(const Eigen::Matrix3d& rotation) {
  return std::atan2(rotation(1, 0), rotation(0, 0));
}

bool AreAlike(double height, double other) {
  return std::max(height, other) < kMaxHeightRatio * std::min(height, other);
}

std::vector<WallPair> PairsOf(const std::vector<Wall>& source,
                              const std::vector<Wall>& target) {
  std::vector<WallPair> pairs;
  for (const Wall& s : source) {
    for (const Wall& t : target) {
      if (!AreAlike(s.height(), t.height())) continue;
      pairs.push_back(
          {s, t, AngleDifference(AzimuthOf(t.normal), AzimuthOf(s.normal))});
    }
  }
  return pairs;
}

std::vector<PostPair> PairsOf(const std::vector<Post>& source,
                              const std::vector<Post>& target) {
  std::vector<PostPair> pairs;
  for (const Post& s : source) {
    for (const Post& t : target) {
      if (s.is_pole == t.is_pole && AreAlike(s.height(), t.height())) {
        pairs.push_back({s, t});
      }
    }
  }
  return pairs;
}

// The votes of two walls if the source wall is moved along the target wall.
double VotesOf(const WallPair& pair, double along, double noise_bound) {
  const double overlap = std::min(pair.source.end + along, pair.target.end) -
                         std::max(pair.source.begin + along, pair.target.begin);
  const double length = overlap / noise_bound;
  return length < kMinOverlap
             ? 0.0
             : kWallVotes * std::min(1.0, length / kFullOverlap);
}

// The distance of the farthest segment from the origin.
double ExtentOf(const Segments& segments) {
  double extent = 0.0;
  for (const Wall& wall : segments.walls) {
    extent = std::max({extent,
                       std::hypot(wall.offset, wall.begin),
                       std::hypot(wall.offset, wall.end)});
  }
  for (const Post& post : segments.posts) {
    extent = std::max(extent, post.center.norm());
  }
  return extent;
}

}  // namespace

// Votes of all pairs at one yaw, in cells as wide as the noise bound.
class SegmentConsensus::Ballot {
 public:
  // Coordinates of translations are at most `extent`.
  Ballot(const SegmentConsensus& consensus, double extent)
      : consensus_(consensus),
        width_(consensus.noise_bound_),
        half_(static_cast<int>(
            std::min(std::ceil(extent / width_) + 2.0, kMaxHalf))),
        votes_(static_cast<std::size_t>(4 * half_ * half_), 0.0f) {}

  // Appends the fullest cells. Returns lambda.
  double Count(double yaw, std::vector<Planar>* fullest) {
    const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(yaw).matrix();
    for (const PostPair& pair : consensus_.posts_) {
      Vote(pair.target.center - rotation * pair.source.center, 1.0f);
    }
    for (const WallPair& pair : consensus_.walls_) {
      if (std::abs(AngleDifference(yaw, pair.yaw)) <= kMaxWallTurn) {
        VoteAlong(pair);
      }
    }
    if (voted_.empty()) return kMinMean;
    double sum = 0.0;
    for (const std::size_t cell : voted_) {
      sum += static_cast<double>(votes_[cell]);
    }
    const double mean =
        std::max(kMinMean, sum / static_cast<double>(voted_.size()));
    AppendFullest(yaw, fullest);
    for (const std::size_t cell : voted_) votes_[cell] = 0.0f;
    voted_.clear();
    return mean;
  }

 private:
  // Votes for the block of two by two cells around a translation.
  void Vote(const Eigen::Vector2d& translation, float votes) {
    const Eigen::Vector2d at =
        translation / width_ + Eigen::Vector2d::Constant(half_ - 0.5);
    if (!(at.minCoeff() >= 0.0 && at.maxCoeff() < 2.0 * half_ - 1.0)) return;
    const auto x = static_cast<int>(at.x());
    const auto y = static_cast<int>(at.y());
    const auto first = static_cast<std::size_t>(x * 2 * half_ + y);
    for (const std::size_t row :
         {first, first + static_cast<std::size_t>(2 * half_)}) {
      for (const std::size_t cell : {row, row + 1}) {
        if (votes_[cell] == 0.0f) voted_.push_back(cell);
        votes_[cell] += votes;
      }
    }
  }

  // Votes for the blocks on the line that the pair allows.
  void VoteAlong(const WallPair& pair) {
    const Eigen::Vector2d& normal = pair.target.normal;
    const Eigen::Vector2d tangent(-normal.y(), normal.x());
    const Eigen::Vector2d foot =
        normal * (pair.target.offset - pair.source.offset);
    // Cells farther along are not in the grid, whatever the foot.
    const double reach = 2.0 * half_ * width_;
    const double begin = std::max(-reach, pair.target.begin - pair.source.end);
    const double end = std::min(reach, pair.target.end - pair.source.begin);
    for (double along = begin; along < end; along += 2.0 * width_) {
      const double votes = VotesOf(pair, along, width_);
      if (votes > 0.0) {
        Vote(foot + along * tangent, static_cast<float>(votes));
      }
    }
  }

  // The fullest cells at least three cells apart. Their ratio is left at 0.
  void AppendFullest(double yaw, std::vector<Planar>* fullest) const {
    std::vector<std::pair<float, std::size_t>> cells;
    for (const std::size_t cell : voted_) {
      if (votes_[cell] >= kMinVotes) cells.emplace_back(-votes_[cell], cell);
    }
    std::sort(cells.begin(), cells.end());
    std::vector<Eigen::Vector2i> kept;
    for (const auto& [negative, cell] : cells) {
      const Eigen::Vector2i at(static_cast<int>(cell) / (2 * half_) - half_,
                               static_cast<int>(cell) % (2 * half_) - half_);
      const bool is_near =
          std::any_of(kept.begin(), kept.end(), [&](const auto& other) {
            return (at - other).cwiseAbs().maxCoeff() <= 3;
          });
      if (is_near) continue;
      kept.push_back(at);
      Planar pose;
      pose.yaw = yaw;
      pose.translation =
          width_ * (at.cast<double>() + Eigen::Vector2d::Constant(0.5));
      pose.ratio = -static_cast<double>(negative);
      fullest->push_back(pose);
      if (kept.size() == kNumPerYaw) break;
    }
  }

  const SegmentConsensus& consensus_;
  double width_;
  int half_;                        // Cells from the middle to the border.
  std::vector<float> votes_;        // Cell x * 2 half + y.
  std::vector<std::size_t> voted_;  // Cells with votes.
};

SegmentConsensus::SegmentConsensus(const Segments& source,
                                   const Segments& target,
                                   double noise_bound)
    : noise_bound_(noise_bound),
      walls_(PairsOf(source.walls, target.walls)),
      posts_(PairsOf(source.posts, target.posts)),
      means_(kNumYaws, kMinMean) {
  if (walls_.empty() && posts_.empty()) return;
  Ballot ballot(*this, ExtentOf(source) + ExtentOf(target));
  for (int k = 0; k < kNumYaws; ++k) {
    const double yaw = 2.0 * M_PI * k / kNumYaws;
    means_[static_cast<std::size_t>(k)] = ballot.Count(yaw, &fullest_);
  }
  for (Planar& pose : fullest_) pose.ratio = RatioOf(pose.ratio, pose.yaw);
  std::stable_sort(
      fullest_.begin(), fullest_.end(), [](const Planar& a, const Planar& b) {
        return a.ratio > b.ratio;
      });
}

double SegmentConsensus::RatioOf(double votes, double yaw) const {
  const long step = std::lround(yaw * kNumYaws / (2.0 * M_PI));
  const double mean =
      means_[static_cast<std::size_t>((step % kNumYaws + kNumYaws) % kNumYaws)];
  return votes > mean ? votes * std::log(votes / mean) - (votes - mean) : 0.0;
}

SegmentConsensus::Agreeing SegmentConsensus::FindAgreeing(
    const Planar& pose, double noise_bound) const {
  Agreeing agreeing;
  for (const WallPair& pair : walls_) {
    const Eigen::Vector2d& normal = pair.target.normal;
    if (std::abs(AngleDifference(pose.yaw, pair.yaw)) > kMaxWallTurn ||
        std::abs(pair.source.offset + normal.dot(pose.translation) -
                 pair.target.offset) > noise_bound) {
      continue;
    }
    const Eigen::Vector2d tangent(-normal.y(), normal.x());
    const double votes =
        VotesOf(pair, tangent.dot(pose.translation), noise_bound_);
    if (votes == 0.0) continue;
    agreeing.walls.push_back(&pair);
    agreeing.votes += votes;
  }
  const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(pose.yaw).matrix();
  for (const PostPair& pair : posts_) {
    const Eigen::Vector2d moved =
        rotation * pair.source.center + pose.translation;
    if ((moved - pair.target.center).norm() > noise_bound) continue;
    agreeing.posts.push_back(&pair);
    agreeing.votes += 1.0;
  }
  return agreeing;
}

bool SegmentConsensus::Fit(const Agreeing& agreeing, Planar* pose) {
  const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(pose->yaw).matrix();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  // The error along a direction of a source point that should be at `target`.
  const auto add = [&](const Eigen::Vector2d& source,
                       const Eigen::Vector2d& target,
                       const Eigen::Vector2d& direction) {
    const Eigen::Vector2d rotated = rotation * source;
    const Eigen::Vector3d jacobian(
        direction.dot(Eigen::Vector2d(-rotated.y(), rotated.x())),
        direction.x(),
        direction.y());
    information += jacobian * jacobian.transpose();
    gradient += jacobian * direction.dot(target - rotated - pose->translation);
  };
  for (const WallPair* pair : agreeing.walls) {
    const Eigen::Vector2d& normal = pair->source.normal;
    const Eigen::Vector2d tangent(-normal.y(), normal.x());
    for (const double along : {pair->source.begin, pair->source.end}) {
      add(pair->source.offset * normal + along * tangent,
          pair->target.offset * pair->target.normal,
          pair->target.normal);
    }
  }
  for (const PostPair* pair : agreeing.posts) {
    add(pair->source.center, pair->target.center, {1.0, 0.0});
    add(pair->source.center, pair->target.center, {0.0, 1.0});
  }
  const Eigen::LDLT<Eigen::Matrix3d> solver(information);
  const Eigen::Vector3d pivots = solver.vectorD();
  if (!(pivots.minCoeff() > 1e-6 * pivots.maxCoeff())) return false;
  const Eigen::Vector3d step = solver.solve(gradient);
  pose->yaw += step[0];
  pose->translation += step.tail<2>();
  return true;
}

std::vector<Rigid3> SegmentConsensus::Propose(int max_num) const {
  std::vector<Planar> kept;
  std::vector<Rigid3> proposed;
  for (Planar pose : fullest_) {
    if (static_cast<int>(proposed.size()) == max_num) break;
    Agreeing agreeing = FindAgreeing(pose, 2.0 * noise_bound_);
    for (int fit = 0; fit < kNumFits; ++fit) {
      if (!Fit(agreeing, &pose)) {
        agreeing = {};
        break;
      }
      agreeing = FindAgreeing(pose, noise_bound_);
    }
    const bool is_known =
        std::any_of(kept.begin(), kept.end(), [&](const Planar& other) {
          return std::abs(AngleDifference(pose.yaw, other.yaw)) <
                     kMaxWallTurn &&
                 (pose.translation - other.translation).norm() <
                     2.0 * noise_bound_;
        });
    if (agreeing.votes == 0.0 || is_known) continue;
    kept.push_back(pose);
    std::vector<double> heights;
    for (const WallPair* pair : agreeing.walls) {
      heights.push_back(pair->target.bottom - pair->source.bottom);
    }
    for (const PostPair* pair : agreeing.posts) {
      heights.push_back(pair->target.bottom - pair->source.bottom);
    }
    const auto middle =
        heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
    std::nth_element(heights.begin(), middle, heights.end());
    proposed.push_back({RotationZ(pose.yaw),
                        {pose.translation.x(), pose.translation.y(), *middle}});
  }
  return proposed;
}

double SegmentConsensus::LogLikelihoodRatio(
    const Rigid3& target_from_source) const {
  Planar pose;
  pose.yaw = YawOf(target_from_source.rotation);
  pose.translation = target_from_source.translation.head<2>();
  return RatioOf(FindAgreeing(pose, noise_bound_).votes, pose.yaw);
}

}  // namespace quatro
