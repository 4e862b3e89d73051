// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/level_registration.h"

#include <algorithm>
#include <utility>

#include "features/guided_matching.h"
#include "robust/estimators/bound_solver.h"
#include "robust/registration/refinement.h"
#include "robust/verdict/contact_covariance.h"
#include "robust/verdict/error_radius.h"
#include "robust/verdict/evidence.h"
#include "robust/verdict/summary_covariance.h"

namespace quatro {
namespace {

// Guided matches are inliers within the noise bound, or within this radius if
// it is smaller [voxel sizes].
constexpr double kMaxGuidedInlierRadius = 2.5;

// Guided matches may be this far from the pose [inlier radii]. Descriptors that
// choose at random on a surface then hit an inlier once in sixteen times.
constexpr double kGuidedRadius = 4.0;

class LevelRegistration {
 public:
  LevelRegistration(const PointsRef& matched_source,
                    const PointsRef& matched_target,
                    const LevelProblem& problem,
                    RegistrationSummary* summary)
      : matched_source_(matched_source),
        matched_target_(matched_target),
        source_(problem.source),
        target_(problem.target),
        bounds_(problem.bounds),
        options_(problem.options),
        solver_(problem.solver),
        search_(problem.search),
        summary_(*summary) {}

  void Run() {
    Estimate();
    if (source_ && summary_.solution.IsUsable()) {
      Refine();
      WeighGeometry();
    }
    Judge();
    if (by_contacts_) ReplaceCovariance();
  }

 private:
  void FinishStage(const char* stage) {
    summary_.stage_times.push_back({stage, stopwatch_.Lap()});
    if (options_.progress) options_.progress(summary_.stage_times.back());
  }

  void Estimate() {
    const PoseSolver solve = [this](const PointsRef& p, const PointsRef& q) {
      return SolveLevel(p, q, solver_, options_.noise_bound, options_.ins);
    };
    summary_.solution = BoundSolver(solve, bounds_, options_.noise_bound)(
        matched_source_, matched_target_);
    MatchedPoints guided_inliers;
    if (search_ && summary_.solution.IsUsable()) {
      guided_inliers = FindGuidedInliers();
    }
    AddCovariance(matched_source_,
                  matched_target_,
                  options_.noise_bound,
                  options_.covariance,
                  guided_inliers,
                  &summary_.solution);
    stopwatch_.Lap();
    for (const StageTime& time : summary_.solution.stage_times) {
      summary_.stage_times.push_back(time);
      if (options_.progress) options_.progress(time);
    }
  }

  // Matches the clouds near the pose, and returns the inliers.
  MatchedPoints FindGuidedInliers() {
    Stopwatch stopwatch;
    const Rigid3& pose = *summary_.solution.target_from_source;
    const double inlier_radius =
        std::min(options_.noise_bound,
                 kMaxGuidedInlierRadius * options_.front_end.voxel_size);
    const std::vector<Match> matches =
        MatchGuided(*source_,
                    *target_,
                    pose,
                    kGuidedRadius * inlier_radius,
                    options_.num_threads);
    const Points& source = source_->points();
    const Points& target = target_->points();
    std::vector<Eigen::Index> source_inliers, target_inliers;
    for (const Match& match : matches) {
      if ((target.col(match.target) - pose * source.col(match.source)).norm() <=
          inlier_radius) {
        source_inliers.push_back(match.source);
        target_inliers.push_back(match.target);
      }
    }
    search_->num_guided_matches = static_cast<Eigen::Index>(matches.size());
    search_->num_guided_inliers =
        static_cast<Eigen::Index>(source_inliers.size());
    summary_.solution.stage_times.push_back(
        {"guided matching", stopwatch.Lap()});
    return {Columns(source, source_inliers), Columns(target, target_inliers)};
  }

  void Refine() {
    if (options_.refinement.method == RefinementMethod::kNone) return;
    RefinementSummary refinement =
        quatro::Refine(*source_,
                       *target_,
                       matched_source_,
                       matched_target_,
                       options_.noise_bound,
                       *summary_.solution.target_from_source,
                       options_.refinement);
    if (!bounds_.Contain(refinement.target_from_source, options_.noise_bound)) {
      refinement.is_accepted = false;
      refinement.message = "the refined pose is outside of the bounds";
      refinement.target_from_source = refinement.unrefined_target_from_source;
    }
    summary_.solution.target_from_source = refinement.target_from_source;
    summary_.refinement = std::move(refinement);
    FinishStage("refinement");
  }

  // Measures the geometric evidence, and which directions the surfaces
  // constrain.
  void WeighGeometry() {
    const Rigid3& pose = *summary_.solution.target_from_source;
    const double voxel_size = options_.front_end.voxel_size;
    const int num_threads = options_.num_threads;
    EvidenceOptions evidence = options_.evidence;
    evidence.rival.bounds = bounds_;
    const MutualContacts contacts =
        FindMutualContacts(*source_,
                           *target_,
                           pose,
                           evidence.MaxDistance(voxel_size),
                           num_threads);
    summary_.surface_observability =
        MeasureSurfaceObservability(*source_,
                                    *target_,
                                    pose,
                                    contacts,
                                    options_.surface_observability,
                                    num_threads);
    if (summary_.surface_observability) {
      auto& unobservable = summary_.solution.covariance->unobservable;
      const auto& more = summary_.surface_observability->unobservable;
      unobservable.insert(unobservable.end(), more.begin(), more.end());
    }
    by_contacts_ = MeasureContactCovariance(
        *source_, *target_, pose, contacts, voxel_size);
    // Without enough structure to measure, there is no evidence for the pose.
    geometry_ = MeasureGeometricEvidence(*source_,
                                         *target_,
                                         pose,
                                         contacts,
                                         voxel_size,
                                         evidence,
                                         num_threads)
                    .value_or(GeometricEvidence());
    geometry_->search = search_;
    FinishStage("evidence");
  }

  void Judge() {
    VerdictOptions verdict = options_.verdict;
    verdict.rival.bounds = bounds_;
    summary_.verdict = quatro::Judge(matched_source_,
                                     matched_target_,
                                     summary_.solution,
                                     options_.noise_bound,
                                     geometry_,
                                     verdict);
    FinishStage("verdict");
  }

  // Replaces the covariance of the matches by that of the final pose, unless a
  // direction is not observable. The verdict was about the matches.
  void ReplaceCovariance() {
    PoseCovariance& covariance = *summary_.solution.covariance;
    if (!covariance.covariance || summary_.solution.scale != 1.0) return;
    const Regime regime = FindRegime(*source_, *target_, search_.has_value());
    const Rigid3& pose = *summary_.solution.target_from_source;
    covariance.center = by_contacts_->center;
    covariance.covariance_at_center =
        CovarianceFactor(regime) * by_contacts_->covariance_at_center;
    const Matrix6 at_origin =
        CovarianceAtOrigin(by_contacts_->covariance_at_center,
                           by_contacts_->center - pose.translation);
    covariance.covariance = CovarianceFactor(regime) * at_origin;
    summary_.error_radius = RadiusOf(
        at_origin, options_.front_end.voxel_size, by_contacts_->extent, regime);
    FinishStage("error radius");
  }

  const PointsRef& matched_source_;
  const PointsRef& matched_target_;
  const DescribedCloud* source_;
  const DescribedCloud* target_;
  const PoseBounds& bounds_;
  const RegistrationOptions& options_;
  const PoseSolver& solver_;
  std::optional<SearchEvidence> search_;
  RegistrationSummary& summary_;
  Stopwatch stopwatch_;
  std::optional<GeometricEvidence> geometry_;
  std::optional<ContactCovariance> by_contacts_;
};

}  // namespace

void RegisterLevel(const PointsRef& matched_source,
                   const PointsRef& matched_target,
                   const LevelProblem& problem,
                   RegistrationSummary* summary) {
  LevelRegistration(matched_source, matched_target, problem, summary).Run();
}

}  // namespace quatro
