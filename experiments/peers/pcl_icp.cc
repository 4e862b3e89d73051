// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/peers/pcl_icp.h"

#include <pcl/console/print.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>

#include <cmath>
#include <exception>
#include <string>

#include "experiments/peers/pcl_cloud.h"
#include "features/kd_tree.h"

namespace quatro {
namespace {

constexpr int kNumNeighbors = 20;
constexpr Eigen::Index kNumNeeded = 3;

// PCL reports "converged" even if it ran out of iterations.
template <typename Base>
struct Counting : Base {
  bool RanOut() const { return this->nr_iterations_ >= this->max_iterations_; }
};

struct Icp
    : Counting<pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ>> {
  explicit Icp(const RefinementOptions& options) {
    const double move = options.alignment.translation_tolerance;
    setTransformationEpsilon(move * move);  // PCL compares squared lengths.
    setTransformationRotationEpsilon(
        std::cos(options.alignment.rotation_tolerance));
  }
};

struct Gicp
    : Counting<
          pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ>> {
  explicit Gicp(const RefinementOptions& options) {
    setTransformationEpsilon(options.alignment.translation_tolerance);
    setRotationEpsilon(options.alignment.rotation_tolerance);
    setCorrespondenceRandomness(kNumNeighbors);
  }
};

Eigen::Index CountWithin(double distance,
                         const Points& source,
                         const Points& target) {
  const KdTree tree(target);
  Eigen::Index count = 0;
  for (const auto point : source.colwise()) {
    count += tree.Nearest(point, 1)[0].squared_distance <= distance * distance;
  }
  return count;
}

template <typename Method>
void Solve(const Points& source,
           const Points& target,
           const Rigid3& initial_target_from_source,
           const RefinementOptions& options,
           AlignmentSummary* summary) {
  const Eigen::Vector3d origin = target.rowwise().mean();
  const double max_distance = options.alignment.max_correspondence_distance;
  Rigid3 guess = initial_target_from_source;
  guess.translation += guess.rotation * origin - origin;
  Method method(options);
  method.setMaxCorrespondenceDistance(max_distance);
  method.setMaximumIterations(options.alignment.max_num_iterations);
  method.setInputSource(ToPclCloud(source, origin));
  method.setInputTarget(ToPclCloud(target, origin));
  PclCloud unused;
  method.align(unused, guess.ToMatrix().template cast<float>());
  const Eigen::Matrix4f matrix = method.getFinalTransformation();
  const Rigid3 pose = FromPclMatrix(matrix, origin);
  summary->termination = AlignmentTermination::kInsufficient;
  summary->message =
      "PCL ended at a pose with fewer than three correspondences";
  if (!method.hasConverged() || !matrix.allFinite()) return;
  summary->num_inliers = CountWithin(max_distance, pose.Apply(source), target);
  if (summary->num_inliers < kNumNeeded) return;
  summary->termination = method.RanOut() ? AlignmentTermination::kNotConverged
                                         : AlignmentTermination::kConverged;
  summary->message = method.RanOut() ? "PCL did not converge" : "PCL converged";
  summary->target_from_source = pose;
}

}  // namespace

AlignmentSummary AlignByPcl(const Points& source,
                            const Points& target,
                            const Rigid3& initial_target_from_source,
                            const RefinementOptions& options) {
  AlignmentSummary summary;
  const bool is_gicp = options.method == RefinementMethod::kGicp;
  if (!is_gicp && options.method != RefinementMethod::kIcp) {
    summary.message = "PCL only has ICP and G-ICP";
    return summary;
  }
  if (!CanAlign(source, target, options.alignment, &summary)) return summary;
  if (is_gicp && source.cols() < kNumNeighbors) {
    summary.termination = AlignmentTermination::kInsufficient;
    summary.message = "PCL's G-ICP needs at least 20 points";
    return summary;
  }
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  try {
    (is_gicp ? Solve<Gicp> : Solve<Icp>)(source,
                                         target,
                                         initial_target_from_source,
                                         options,
                                         &summary);
  } catch (const std::exception& exception) {
    summary = {};
    summary.message = std::string("PCL: ") + exception.what();
  }
  return summary;
}

}  // namespace quatro
