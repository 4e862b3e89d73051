// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/local/gicp.h"

#include <glog/logging.h>

#include "features/base/stopwatch.h"
#include "solvers/local/nearest_points.h"

namespace quatro {
namespace {

// The inverse of C + R B R^T, where a is the normal of C and b is R times the
// normal of B. By Woodbury's identity for 2 I - s U U^T with U = [a b] and s =
// 1 - epsilon.
Eigen::Matrix3d Information(const Eigen::Vector3d& a,
                            const Eigen::Vector3d& b,
                            double epsilon) {
  const double twice_by_s = 2.0 / (1.0 - epsilon);
  const double aa = twice_by_s - a.squaredNorm();
  const double bb = twice_by_s - b.squaredNorm();
  const double ab = a.dot(b);
  const double half_by_det = 0.5 / (aa * bb - ab * ab);
  const Eigen::Vector3d u = half_by_det * (bb * a + ab * b);
  const Eigen::Vector3d v = half_by_det * (ab * a + aa * b);
  Eigen::Matrix3d information = u * a.transpose() + v * b.transpose();
  information.diagonal().array() += 0.5;
  return information;
}

class GicpTerms final : public AlignmentTerms {
 public:
  GicpTerms(const DescribedCloud& source,
            const DescribedCloud& target,
            double max_distance,
            double epsilon)
      : source_(source),
        target_(target),
        epsilon_(epsilon),
        nearest_(*target.tree, source.points().cols(), max_distance) {}

  const Points& source() const override { return source_.points(); }

  bool Find(Eigen::Index i, const Rigid3& pose, AlignmentTerm* term) override {
    const Eigen::Index j =
        nearest_.Find(i, pose * Eigen::Vector3d(source().col(i)));
    if (j < 0) return false;
    term->target = target_.points().col(j);
    term->information = Information(target_.normals.col(j),
                                    pose.rotation * source_.normals.col(i),
                                    epsilon_);
    return true;
  }

 private:
  const DescribedCloud& source_;
  const DescribedCloud& target_;
  double epsilon_;
  NearestPoints nearest_;
};

}  // namespace

std::unique_ptr<AlignmentTerms> MakeGicpTerms(
    const DescribedCloud& source,
    const DescribedCloud& target,
    double max_correspondence_distance,
    double epsilon) {
  CHECK_EQ(source.points().cols(), source.normals.cols());
  CHECK_EQ(target.points().cols(), target.normals.cols());
  return std::make_unique<GicpTerms>(
      source, target, max_correspondence_distance, epsilon);
}

AlignmentSummary SolveGicp(const DescribedCloud& source,
                           const DescribedCloud& target,
                           const Rigid3& initial_target_from_source,
                           const GicpOptions& options) {
  AlignmentSummary summary;
  if (!options.IsValid(&summary.message)) return summary;
  Stopwatch stopwatch;
  const auto terms =
      MakeGicpTerms(source,
                    target,
                    options.alignment.max_correspondence_distance,
                    options.epsilon);
  summary =
      AlignLocally(initial_target_from_source, options.alignment, terms.get());
  summary.stage_times.push_back({"alignment", stopwatch.Lap()});
  return summary;
}

AlignmentSummary SolveGicp(const Points& source,
                           const Points& target,
                           const Rigid3& initial_target_from_source,
                           const GicpOptions& options) {
  AlignmentSummary summary;
  if (!options.IsValid(&summary.message)) return summary;
  return SolveWithNormals(
      source,
      target,
      options,
      [&](const DescribedCloud& from, const DescribedCloud& onto) {
        return SolveGicp(from, onto, initial_target_from_source, options);
      });
}

}  // namespace quatro
