// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/max_consensus.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <queue>
#include <sstream>
#include <vector>

namespace quatro {
namespace {

constexpr int kNumFirstIntervals = 64;

// An array of counts as a segment tree: adds to ranges and finds the maximum.
class RangeCounter {
 public:
  explicit RangeCounter(std::size_t size) {
    while (size_ < size) size_ *= 2;
    most_.assign(2 * size_, 0);
    added_.assign(2 * size_, 0);
  }

  // Adds `amount` to [first, last].
  void Add(std::size_t first, std::size_t last, int amount) {
    Add(1, 0, size_ - 1, first, last, amount);
  }

  int Most() const { return most_[1]; }

  // A place where the count is the largest.
  std::size_t Where() const {
    std::size_t node = 1;
    while (node < size_) {
      node = most_[2 * node] >= most_[2 * node + 1] ? 2 * node : 2 * node + 1;
    }
    return node - size_;
  }

 private:
  void Add(std::size_t node,
           std::size_t begin,
           std::size_t end,
           std::size_t first,
           std::size_t last,
           int amount) {
    if (last < begin || end < first) return;
    if (first <= begin && end <= last) {
      most_[node] += amount;
      added_[node] += amount;
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    Add(2 * node, begin, middle, first, last, amount);
    Add(2 * node + 1, middle + 1, end, first, last, amount);
    most_[node] = added_[node] + std::max(most_[2 * node], most_[2 * node + 1]);
  }

  std::size_t size_ = 1;
  std::vector<int> most_;
  std::vector<int> added_;
};

// A point, and the number of squares that contain it.
struct Depth {
  int num = 0;
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
};

// The point in the largest number of squares, by a sweep along x. Squares are
// closed: one that begins where another ends shares a point with it.
Depth DeepestPoint(const Eigen::Matrix2Xd& centers,
                   const Eigen::ArrayXd& half_widths) {
  struct Event {
    double x;
    bool is_end;
    Eigen::Index square;
  };
  const Eigen::Index n = centers.cols();
  std::vector<Event> events;
  std::vector<double> ys;
  events.reserve(static_cast<std::size_t>(2 * n));
  ys.reserve(static_cast<std::size_t>(2 * n));
  for (Eigen::Index i = 0; i < n; ++i) {
    events.push_back({centers(0, i) - half_widths[i], false, i});
    events.push_back({centers(0, i) + half_widths[i], true, i});
    ys.push_back(centers(1, i) - half_widths[i]);
    ys.push_back(centers(1, i) + half_widths[i]);
  }
  std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
    if (a.x != b.x) return a.x < b.x;
    return a.is_end != b.is_end ? b.is_end : a.square < b.square;
  });
  std::sort(ys.begin(), ys.end());
  ys.erase(std::unique(ys.begin(), ys.end()), ys.end());
  const auto index_of = [&](double y) {
    return static_cast<std::size_t>(std::lower_bound(ys.begin(), ys.end(), y) -
                                    ys.begin());
  };
  RangeCounter counter(ys.size());
  Depth deepest;
  for (const Event& event : events) {
    const Eigen::Index i = event.square;
    counter.Add(index_of(centers(1, i) - half_widths[i]),
                index_of(centers(1, i) + half_widths[i]),
                event.is_end ? -1 : 1);
    if (!event.is_end && counter.Most() > deepest.num) {
      deepest.num = counter.Most();
      deepest.point << event.x, ys[counter.Where()];
    }
  }
  return deepest;
}

struct Interval {
  double center;
  double width;  // To each side.
  int bound;

  bool operator<(const Interval& other) const {
    return bound != other.bound ? bound < other.bound : center > other.center;
  }
};

}  // namespace

bool MaxConsensusOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(noise_bound > 0.0 && std::isfinite(noise_bound))) {
    problem << "noise_bound = " << noise_bound << ", must be > 0 and finite";
  } else if (!(min_width > 0.0)) {
    problem << "min_width = " << min_width << ", must be > 0";
  } else if (max_num_intervals < 1) {
    problem << "max_num_intervals = " << max_num_intervals << ", must be >= 1";
  }
  *error = problem.str();
  return error->empty();
}

MaxConsensus FindMaxConsensus(const PointsRef& source,
                              const PointsRef& target,
                              const MaxConsensusOptions& options) {
  MaxConsensus best;
  const Eigen::Index n = source.cols();
  if (n == 0) return best;
  // Coordinates are relative to the mean of the source, so that the |p_i| are
  // small.
  const Eigen::Vector2d middle = source.topRows<2>().rowwise().mean();
  const Eigen::Matrix2Xd p = source.topRows<2>().colwise() - middle;
  const Eigen::Matrix2Xd q = target.topRows<2>();
  const Eigen::ArrayXd ranges = p.colwise().norm().transpose().array();

  std::priority_queue<Interval> open;
  const auto look = [&](double center, double width) {
    const Eigen::Matrix2d rotation =
        Eigen::Rotation2D<double>(center).toRotationMatrix();
    const Eigen::Matrix2Xd centers = q - rotation * p;
    const Depth at_center =
        DeepestPoint(centers, Eigen::ArrayXd::Constant(n, options.noise_bound));
    if (at_center.num > best.num_inliers) {
      best.num_inliers = at_center.num;
      best.yaw = std::remainder(center, 2.0 * M_PI);
      best.translation = at_center.point - rotation * middle;
    }
    const double chord = 2.0 * std::sin(0.5 * std::min(width, M_PI));
    const Depth anywhere =
        DeepestPoint(centers, options.noise_bound + chord * ranges);
    open.push({center, width, anywhere.num});
    ++best.num_intervals;
  };
  for (int k = 0; k < kNumFirstIntervals; ++k) {
    look((2 * k + 1) * M_PI / kNumFirstIntervals, M_PI / kNumFirstIntervals);
  }
  while (!open.empty() && open.top().bound > best.num_inliers &&
         open.top().width > options.min_width &&
         best.num_intervals < options.max_num_intervals) {
    const Interval interval = open.top();
    open.pop();
    const double half = 0.5 * interval.width;
    look(interval.center - half, half);
    look(interval.center + half, half);
  }
  best.upper_bound = std::max<Eigen::Index>(best.num_inliers, open.top().bound);
  return best;
}

}  // namespace quatro
