// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/pose_search.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "features/base/parallel.h"
#include "robust/estimators/distinct_matches.h"
#include "robust/registration/vertical.h"
#include "robust/verdict/structure.h"
#include "solvers/closed_form/gravity.h"
#include "solvers/local/vgicp.h"

namespace quatro {
namespace {

// Points of the source that VG-ICP aligns, two thirds of them structure.
constexpr std::size_t kNumAlignedPoints = 1500;

// Voxels of VG-ICP, first coarse, then fine [voxel sizes of the clouds].
constexpr double kCoarseVoxels = 20.0 / 3.0;
constexpr double kFineVoxels = 10.0 / 3.0;
constexpr int kCoarseIterations = 10;
constexpr int kFineIterations = 20;

// Two candidates are alike if they differ by less than both.
constexpr double kSameRotation = 0.035;  // [rad]
constexpr double kSameShift = 2.0;       // [noise bounds]

// The max_tilt of the consensus search covers a smaller inclination [rad].
constexpr double kMinInclination = 0.05;

// VG-ICP may move a proposal into the bounds from this far outside.
constexpr double kMaxShiftIntoBounds = 4.0;  // [noise bounds]
constexpr double kMaxTurnIntoBounds = 0.1;   // [rad]

// Candidates whose geometric score after the coarse stage is below this are
// wrong, and not aligned any further.
constexpr double kMinCoarseScore = 0.05;

constexpr int kNumSegmentPoses = 32;

// VG-ICP cannot number the voxels of a wider cloud [voxel sizes].
constexpr double kMaxWidth = 1e6;

// Appends at most `num_wanted` of the points, evenly over their order.
void Thin(const std::vector<Eigen::Index>& from,
          std::size_t num_wanted,
          std::vector<Eigen::Index>* to) {
  const std::size_t num = std::min(num_wanted, from.size());
  for (std::size_t k = 0; k < num; ++k) {
    to->push_back(from[k * from.size() / num]);
  }
}

DescribedCloud SampleForAlignment(const DescribedCloud& cloud) {
  std::vector<Eigen::Index> structure, ground, kept;
  for (Eigen::Index i = 0; i < cloud.normals.cols(); ++i) {
    if (cloud.normals.col(i).isZero(0.0)) continue;
    (IsStructure(cloud.normals.col(i)) ? structure : ground).push_back(i);
  }
  Thin(ground, kNumAlignedPoints / 3, &kept);
  Thin(structure, kNumAlignedPoints - kNumAlignedPoints / 3, &kept);
  DescribedCloud sample;
  const auto num = static_cast<Eigen::Index>(kept.size());
  Points points(3, num);
  sample.normals.resize(3, num);
  for (Eigen::Index k = 0; k < num; ++k) {
    const Eigen::Index i = kept[static_cast<std::size_t>(k)];
    points.col(k) = cloud.points().col(i);
    sample.normals.col(k) = cloud.normals.col(i);
  }
  sample.tree = std::make_shared<const KdTree>(std::move(points));
  sample.sensor = cloud.sensor;
  sample.is_scan = cloud.is_scan;
  return sample;
}

PoseBounds Widened(const PoseBounds& bounds, double noise_bound) {
  PoseBounds wide = bounds;
  wide.max_translation += kMaxShiftIntoBounds * noise_bound;
  wide.max_yaw = std::min(M_PI, bounds.max_yaw + kMaxTurnIntoBounds);
  wide.max_tilt = std::min(M_PI, bounds.max_tilt + kMaxTurnIntoBounds);
  return wide;
}

double Width(const Points& points) {
  return points.cols() == 0
             ? 0.0
             : (points.rowwise().maxCoeff() - points.rowwise().minCoeff())
                   .maxCoeff();
}

}  // namespace

bool PoseSearchOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (max_rung < 0 || max_rung > 3) {
    problem << "search.max_rung = " << max_rung << ", must be in [0, 3]";
  } else if (scale_factors.empty() ||
             !std::all_of(
                 scale_factors.begin(), scale_factors.end(), [](double factor) {
                   return factor > 0.0 && std::isfinite(factor);
                 })) {
    problem << "search.scale_factors must be > 0 and finite, at least one";
  } else if (!(time_limit_seconds >= 0.0)) {
    problem << "search.time_limit_seconds = " << time_limit_seconds
            << ", must be >= 0";
  } else if (max_num_proposals < 1) {
    problem << "search.max_num_proposals = " << max_num_proposals
            << ", must be >= 1";
  } else if (num_aligned < 1) {
    problem << "search.num_aligned = " << num_aligned << ", must be >= 1";
  } else if (!(max_tilt >= 0.0 && max_tilt <= M_PI / 4.0)) {
    problem << "search.max_tilt = " << max_tilt << ", must be in [0, pi/4]";
  } else if (!(bound_factor > 0.0 && std::isfinite(bound_factor))) {
    problem << "search.bound_factor = " << bound_factor
            << ", must be > 0 and finite";
  }
  *error = problem.str();
  return error->empty();
}

double PoseCandidate::Score() const {
  return geometry.value() * std::sqrt(log_likelihood_ratio);
}

// VG-ICP from a sample of the source. The voxels of the target are computed
// once.
struct PoseSearch::Aligner {
  Aligner(const DescribedCloud& source,
          const DescribedCloud& target,
          double voxel_size)
      : sample(SampleForAlignment(source)),
        coarse(Stage(kCoarseVoxels * voxel_size, kCoarseIterations)),
        fine(Stage(kFineVoxels * voxel_size, kFineIterations)),
        coarse_terms(MakeVgicpTerms(sample, target, coarse)),
        fine_terms(MakeVgicpTerms(sample, target, fine)) {}

  static VgicpOptions Stage(double voxel_size, int num_iterations) {
    VgicpOptions options;
    options.voxel_size = voxel_size;
    options.alignment.max_correspondence_distance = voxel_size;
    options.alignment.translation_tolerance = 0.01 * voxel_size;
    options.alignment.rotation_tolerance = 1e-3;
    options.alignment.max_num_iterations = num_iterations;
    options.alignment.min_conditioning = 0.0;
    return options;
  }

  Rigid3 AlignCoarsely(const Rigid3& pose) const {
    return AlignLocally(pose, coarse.alignment, coarse_terms.get())
        .target_from_source.value_or(pose);
  }

  Rigid3 AlignFinely(const Rigid3& pose) const {
    return AlignLocally(pose, fine.alignment, fine_terms.get())
        .target_from_source.value_or(pose);
  }

  DescribedCloud sample;
  VgicpOptions coarse;
  VgicpOptions fine;
  std::unique_ptr<AlignmentTerms> coarse_terms;
  std::unique_ptr<AlignmentTerms> fine_terms;
};

PoseSearch::PoseSearch(const DescribedCloud& source,
                       const DescribedCloud& target,
                       double max_distance,
                       double voxel_size,
                       double noise_bound,
                       const PoseSearchOptions& options,
                       int num_threads)
    : source_(source),
      target_(target),
      voxel_size_(voxel_size),
      noise_bound_(noise_bound),
      options_(options),
      num_threads_(num_threads),
      scorer_(source, target, max_distance, voxel_size, num_threads) {
  if (std::max(Width(source.points()), Width(target.points())) <
      kMaxWidth * voxel_size) {
    aligner_ = std::make_unique<Aligner>(source, target, voxel_size);
  }
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d source_up = EstimateVertical(source, z).value_or(z);
  const Eigen::Vector3d target_up = EstimateVertical(target, z).value_or(z);
  levels_.emplace_back();
  if (std::min(source_up.z(), target_up.z()) < std::cos(kMinInclination)) {
    levels_.push_back({RotationBetween(source_up, z),
                       RotationBetween(target_up, z),
                       ", leveled by walls"});
  }
}

PoseSearch::~PoseSearch() = default;

void PoseSearch::UseSegments() {
  const auto find = [&](const DescribedCloud& cloud,
                        const Eigen::Matrix3d& level_from_cloud) {
    return FindSegments(
        level_from_cloud * (cloud.points().colwise() - cloud.sensor),
        level_from_cloud * cloud.normals,
        voxel_size_);
  };
  for (const Level& level : levels_) {
    segments_.emplace_back(find(source_, level.from_source),
                           find(target_, level.from_target),
                           options_.bound_factor * noise_bound_);
  }
}

std::vector<ProposedPose> PoseSearch::SegmentPoses() const {
  std::vector<ProposedPose> poses;
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    const Level& level = levels_[k];
    const Eigen::Matrix3d target_from_level = level.from_target.transpose();
    for (const Rigid3& pose : segments_[k].Propose(kNumSegmentPoses)) {
      const Eigen::Matrix3d rotation =
          target_from_level * pose.rotation * level.from_source;
      poses.push_back({"segments" + level.origin,
                       {rotation,
                        target_from_level * pose.translation + target_.sensor -
                            rotation * source_.sensor}});
    }
  }
  return poses;
}

double PoseSearch::SegmentRatio(const Rigid3& target_from_source) const {
  const Eigen::Vector3d shift =
      target_from_source * source_.sensor - target_.sensor;
  double ratio = 0.0;
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    const Level& level = levels_[k];
    const Rigid3 pose{level.from_target * target_from_source.rotation *
                          level.from_source.transpose(),
                      level.from_target * shift};
    ratio = std::max(ratio, segments_[k].LogLikelihoodRatio(pose));
  }
  return ratio;
}

Rigid3 PoseSearch::Align(const Rigid3& target_from_source) const {
  if (!aligner_) return target_from_source;
  return aligner_->AlignFinely(aligner_->AlignCoarsely(target_from_source));
}

ConsensusSearchOptions PoseSearch::ConsensusOptions(const Level& level) const {
  ConsensusSearchOptions consensus;
  consensus.noise_bound = options_.bound_factor * noise_bound_;
  consensus.max_tilt = options_.max_tilt;
  consensus.max_num_proposals = options_.max_num_proposals;
  consensus.source_center = level.from_source * source_.sensor;
  consensus.target_center = level.from_target * target_.sensor;
  consensus.num_threads = num_threads_;
  return consensus;
}

void PoseSearch::Propose(const PointsRef& matched_source,
                         const PointsRef& matched_target,
                         const std::string& origin,
                         const Level& level,
                         std::vector<PoseCandidate>* candidates) const {
  const Eigen::Matrix3d target_from_level = level.from_target.transpose();
  for (const Proposal& proposal :
       SearchConsensus(level.from_source * matched_source,
                       level.from_target * matched_target,
                       ConsensusOptions(level))) {
    const Rigid3& pose = proposal.target_from_source;
    PoseCandidate candidate;
    candidate.target_from_source = {
        target_from_level * pose.rotation * level.from_source,
        target_from_level * pose.translation};
    candidate.origin = origin + level.origin;
    candidate.log_likelihood_ratio = proposal.log_likelihood_ratio;
    candidates->push_back(std::move(candidate));
  }
}

std::vector<PoseCandidate> PoseSearch::Find(
    const PointsRef& matched_source,
    const PointsRef& matched_target,
    const std::string& origin,
    const std::vector<ProposedPose>& more,
    const PoseBounds& bounds) const {
  if (!bounds.IsActive()) {
    return FindAmong(matched_source, matched_target, origin, more, bounds);
  }
  const PoseBounds wide = Widened(bounds, noise_bound_);
  const std::vector<Eigen::Index> columns = wide.PossibleInliers(
      matched_source, matched_target, options_.bound_factor * noise_bound_);
  return FindAmong(Columns(matched_source, columns),
                   Columns(matched_target, columns),
                   origin,
                   more,
                   bounds);
}

std::vector<PoseCandidate> PoseSearch::FindAmong(
    const PointsRef& matched_source,
    const PointsRef& matched_target,
    const std::string& origin,
    const std::vector<ProposedPose>& more,
    const PoseBounds& bounds) const {
  std::vector<PoseCandidate> candidates;
  if (!aligner_ || matched_source.cols() == 0) return candidates;
  if (options_.consensus) {
    for (const Level& level : levels_) {
      Propose(matched_source, matched_target, origin, level, &candidates);
    }
  }
  std::vector<ProposedPose> poses = SegmentPoses();
  poses.insert(poses.end(), more.begin(), more.end());
  for (const ProposedPose& pose : poses) {
    candidates.push_back(
        {pose.target_from_source,
         origin + ", " + pose.origin,
         ConsensusLogLikelihoodRatio(matched_source,
                                     matched_target,
                                     pose.target_from_source,
                                     ConsensusOptions(Level())),
         GeometricScore()});
  }
  for (PoseCandidate& candidate : candidates) {
    candidate.log_likelihood_ratio +=
        SegmentRatio(candidate.target_from_source);
  }
  // Upside down, flat ground alone has as many inliers as the whole scene of a
  // mirrored scan.
  const PoseBounds wide = Widened(bounds, noise_bound_);
  std::erase_if(candidates, [&](const PoseCandidate& candidate) {
    const Rigid3& pose = candidate.target_from_source;
    return !wide.Contain(pose, noise_bound_) ||
           (!options_.allows_upside_down && pose.rotation(2, 2) < 0.0);
  });
  const auto score = [&](PoseCandidate* candidate) {
    candidate->geometry = scorer_.At(candidate->target_from_source);
  };
  const auto for_all = [&](const auto& body) {
    ParallelFor(num_threads_,
                static_cast<Eigen::Index>(candidates.size()),
                1,
                [&](Eigen::Index begin, Eigen::Index end) {
                  for (Eigen::Index k = begin; k < end; ++k) {
                    body(&candidates[static_cast<std::size_t>(k)]);
                  }
                });
  };
  const auto sort = [&] {
    const auto rank = [&](const PoseCandidate& candidate) {
      return options_.geometric_choice ? candidate.Score()
                                       : candidate.log_likelihood_ratio;
    };
    std::stable_sort(candidates.begin(),
                     candidates.end(),
                     [&](const PoseCandidate& a, const PoseCandidate& b) {
                       return rank(a) > rank(b);
                     });
  };
  for_all(score);
  sort();
  candidates.resize(std::min(candidates.size(),
                             static_cast<std::size_t>(options_.num_aligned)));
  for_all([&](PoseCandidate* candidate) {
    Rigid3* const pose = &candidate->target_from_source;
    *pose = aligner_->AlignCoarsely(*pose);
    score(candidate);
    if (candidate->geometry.value() < kMinCoarseScore) return;
    *pose = aligner_->AlignFinely(*pose);
    score(candidate);
  });
  sort();

  const Eigen::Vector3d middle = matched_source.rowwise().mean();
  std::vector<PoseCandidate> kept;
  for (PoseCandidate& candidate : candidates) {
    const Rigid3& pose = candidate.target_from_source;
    const bool is_new =
        std::none_of(kept.begin(), kept.end(), [&](const PoseCandidate& other) {
          const Rigid3& better = other.target_from_source;
          return AngleBetween(pose.rotation, better.rotation) < kSameRotation &&
                 (pose * middle - better * middle).norm() <
                     kSameShift * noise_bound_;
        });
    if (is_new && bounds.Contain(pose, noise_bound_)) {
      kept.push_back(std::move(candidate));
    }
  }
  return kept;
}

}  // namespace quatro
