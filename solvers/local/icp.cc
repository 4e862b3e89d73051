// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/local/icp.h"

#include "features/base/stopwatch.h"
#include "solvers/local/nearest_points.h"

namespace quatro {
namespace {

class IcpTerms final : public AlignmentTerms {
 public:
  IcpTerms(const Points& source, const KdTree& target, double max_distance)
      : source_(source),
        target_(target),
        nearest_(target, source.cols(), max_distance) {}

  const Points& source() const override { return source_; }

  bool Find(Eigen::Index i, const Rigid3& pose, AlignmentTerm* term) override {
    const Eigen::Index j =
        nearest_.Find(i, pose * Eigen::Vector3d(source_.col(i)));
    if (j < 0) return false;
    term->target = target_.points().col(j);
    term->information.setIdentity();
    return true;
  }

 private:
  const Points& source_;
  const KdTree& target_;
  NearestPoints nearest_;
};

}  // namespace

std::unique_ptr<AlignmentTerms> MakeIcpTerms(
    const Points& source,
    const KdTree& target,
    double max_correspondence_distance) {
  return std::make_unique<IcpTerms>(
      source, target, max_correspondence_distance);
}

AlignmentSummary SolveIcp(const Points& source,
                          const KdTree& target,
                          const Rigid3& initial_target_from_source,
                          const LocalAlignmentOptions& options) {
  Stopwatch stopwatch;
  const auto terms =
      MakeIcpTerms(source, target, options.max_correspondence_distance);
  AlignmentSummary summary =
      AlignLocally(initial_target_from_source, options, terms.get());
  summary.stage_times.push_back({"alignment", stopwatch.Lap()});
  return summary;
}

AlignmentSummary SolveIcp(const Points& source,
                          const Points& target,
                          const Rigid3& initial_target_from_source,
                          const LocalAlignmentOptions& options) {
  AlignmentSummary summary;
  if (!CanAlign(source, target, options, &summary)) return summary;
  Stopwatch stopwatch;
  const KdTree tree(target);
  const double seconds = stopwatch.Lap();
  summary = SolveIcp(source, tree, initial_target_from_source, options);
  summary.stage_times.insert(summary.stage_times.begin(), {"tree", seconds});
  return summary;
}

}  // namespace quatro
