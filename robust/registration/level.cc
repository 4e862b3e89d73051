// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/level.h"

#include <memory>
#include <optional>
#include <utility>

namespace quatro {
namespace {

void TakeBack(const LevelFrames& frames, Rigid3* pose) {
  const Eigen::Matrix3d back = frames.level_from_target.transpose();
  *pose = Rigid3{back * pose->rotation * frames.level_from_source,
                 back * pose->translation};
}

void TakeBack(const LevelFrames& frames, std::optional<Rigid3>* pose) {
  if (*pose) TakeBack(frames, &**pose);
}

// Rotation and translation are along the axes of the target.
void TakeBack(const LevelFrames& frames, Matrix6* matrix) {
  Matrix6 back = Matrix6::Zero();
  back.topLeftCorner<3, 3>() = frames.level_from_target.transpose();
  back.bottomRightCorner<3, 3>() = frames.level_from_target.transpose();
  *matrix = (back * *matrix * back.transpose()).eval();
}

void TakeBack(const LevelFrames& frames, Eigen::Vector3d* in_target) {
  *in_target = (frames.level_from_target.transpose() * *in_target).eval();
}

void TakeBack(const LevelFrames& frames,
              std::vector<UnobservableDirection>* directions) {
  for (UnobservableDirection& direction : *directions) {
    TakeBack(frames, &direction.axis);
    TakeBack(frames, &direction.point);
  }
}

void TakeBack(const LevelFrames& frames, PoseCovariance* covariance) {
  for (std::optional<Matrix6>* matrix :
       {&covariance->covariance, &covariance->covariance_at_center}) {
    if (*matrix) TakeBack(frames, &**matrix);
  }
  TakeBack(frames, &covariance->center);
  TakeBack(frames, &covariance->unobservable);
}

void TakeBack(const LevelFrames& frames, VerticalPrior* vertical) {
  vertical->up_in_source =
      (frames.level_from_source.transpose() * vertical->up_in_source).eval();
  TakeBack(frames, &vertical->up_in_target);
}

void TakeBack(const LevelFrames& frames, RefinementSummary* refinement) {
  TakeBack(frames, &refinement->target_from_source);
  TakeBack(frames, &refinement->unrefined_target_from_source);
  AlignmentSummary& alignment = refinement->alignment;
  TakeBack(frames, &alignment.target_from_source);
  TakeBack(frames, &alignment.hessian);
  const Eigen::Matrix3d back = frames.level_from_target.transpose();
  for (auto direction : alignment.unobservable.colwise()) {
    direction.head<3>() = (back * direction.head<3>()).eval();
    direction.tail<3>() = (back * direction.tail<3>()).eval();
  }
}

void TakeBack(const LevelFrames& frames, SurfaceObservability* surfaces) {
  TakeBack(frames, &surfaces->information);
  TakeBack(frames, &surfaces->center);
  TakeBack(frames, &surfaces->weakest_level_axis);
  TakeBack(frames, &surfaces->unobservable);
  const Eigen::Matrix3d back = frames.level_from_target.transpose();
  surfaces->scatter = (back * surfaces->scatter * back.transpose()).eval();
}

void TakeBack(const LevelFrames& frames, Verdict* verdict) {
  if (verdict->rival) TakeBack(frames, &verdict->rival->target_from_source);
  if (!verdict->geometry) return;
  GeometricEvidence& geometry = *verdict->geometry;
  TakeBack(frames, &geometry.weakest_direction);
  TakeBack(frames, &geometry.rival.shift);
  TakeBack(frames, &geometry.rival.rival_target_from_source);
}

}  // namespace

Points Leveled(const Eigen::Matrix3d& level_from_cloud,
               const PointsRef& points) {
  Points leveled(3, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    leveled.col(i) = level_from_cloud * Eigen::Vector3d(points.col(i));
  }
  return leveled;
}

DescribedCloud Leveled(const Eigen::Matrix3d& level_from_cloud,
                       const DescribedCloud& cloud) {
  DescribedCloud leveled;
  leveled.tree =
      std::make_shared<const KdTree>(Leveled(level_from_cloud, cloud.points()));
  leveled.normals = Leveled(level_from_cloud, cloud.normals);
  leveled.descriptors = cloud.descriptors;
  leveled.sensor = level_from_cloud * cloud.sensor;
  leveled.is_scan = cloud.is_scan;
  return leveled;
}

PoseBounds Leveled(const LevelFrames& frames,
                   const InsOptions& ins,
                   const PoseBounds& bounds) {
  PoseBounds leveled = bounds;
  leveled.up = Eigen::Vector3d::UnitZ();
  if (frames.AreIdentity()) return leveled;
  leveled.guess.rotation = frames.level_from_target * bounds.guess.rotation *
                           frames.level_from_source.transpose();
  leveled.guess.translation =
      frames.level_from_target * bounds.guess.translation;
  if (ins.mode != InsMode::kNone) {
    leveled.guess.rotation =
        RotationZ(Decompose(leveled.guess.rotation, leveled.up).yaw);
  }
  return leveled;
}

void TakeBack(const LevelFrames& frames, RegistrationSummary* summary) {
  if (frames.AreIdentity()) return;
  PoseSummary& solution = summary->solution;
  TakeBack(frames, &solution.target_from_source);
  TakeBack(frames, &solution.unpolished_target_from_source);
  if (solution.vertical) TakeBack(frames, &*solution.vertical);
  if (solution.covariance) TakeBack(frames, &*solution.covariance);
  if (summary->refinement) TakeBack(frames, &*summary->refinement);
  if (summary->surface_observability) {
    TakeBack(frames, &*summary->surface_observability);
  }
  TakeBack(frames, &summary->verdict);
  for (PoseCandidate& candidate : summary->candidates) {
    TakeBack(frames, &candidate.target_from_source);
  }
}

}  // namespace quatro
