// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/local/vgicp.h"

#include <glog/logging.h>

#include <Eigen/LU>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <vector>

#include "features/base/key_numbers.h"
#include "features/base/stopwatch.h"

namespace quatro {
namespace {

constexpr int kBitsPerAxis = 21;
constexpr double kMaxCells = 1 << kBitsPerAxis;

struct Voxel {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();  // (I + mean C)^-1.
  double count = 0.0;
};

class VoxelMap {
 public:
  VoxelMap(const DescribedCloud& cloud, double voxel_size, double epsilon)
      : voxel_size_(voxel_size) {
    const Points& points = cloud.points();
    if (points.cols() == 0) return;
    first_cell_ = Cell(points.rowwise().minCoeff());
    last_cell_ = Cell(points.rowwise().maxCoeff());
    CHECK((last_cell_ - first_cell_).maxCoeff() < kMaxCells);
    // The mean is updated, not summed, so that large coordinates keep their
    // digits.
    for (Eigen::Index j = 0; j < points.cols(); ++j) {
      const Eigen::Vector3d point = points.col(j);
      const std::size_t number = numbers_.Add(Key(Cell(point)));
      if (number == voxels_.size()) voxels_.emplace_back();
      Voxel& voxel = voxels_[number];
      voxel.count += 1.0;
      voxel.mean += (point - voxel.mean) / voxel.count;
      voxel.inverse += SurfaceCovariance(cloud.normals.col(j), epsilon);
    }
    for (Voxel& voxel : voxels_) {
      const Eigen::Matrix3d covariance = voxel.inverse / voxel.count;
      voxel.inverse = (Eigen::Matrix3d::Identity() + covariance).inverse();
    }
  }

  const Voxel* Find(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d cell = Cell(x);
    if (!((cell - first_cell_).array() >= 0.0).all() ||
        !((last_cell_ - cell).array() >= 0.0).all()) {
      return nullptr;
    }
    const std::size_t number = numbers_.Find(Key(cell));
    return number == voxels_.size() ? nullptr : &voxels_[number];
  }

 private:
  Eigen::Vector3d Cell(const Eigen::Vector3d& x) const {
    return (x / voxel_size_).array().floor();
  }
  std::uint64_t Key(const Eigen::Vector3d& cell) const {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      key = key << kBitsPerAxis |
            static_cast<std::uint64_t>(cell[axis] - first_cell_[axis]);
    }
    return key;
  }

  double voxel_size_;
  Eigen::Vector3d first_cell_ = Eigen::Vector3d::Constant(1.0);
  Eigen::Vector3d last_cell_ = Eigen::Vector3d::Constant(-1.0);
  KeyNumbers numbers_;
  std::vector<Voxel> voxels_;
};

class VgicpTerms final : public AlignmentTerms {
 public:
  VgicpTerms(const DescribedCloud& source,
             const DescribedCloud& target,
             const VgicpOptions& options)
      : source_(source),
        epsilon_(options.epsilon),
        max_distance_(options.alignment.max_correspondence_distance),
        voxels_(target, options.voxel_size, options.epsilon) {}

  const Points& source() const override { return source_.points(); }

  bool Find(Eigen::Index i, const Rigid3& pose, AlignmentTerm* term) override {
    const Eigen::Vector3d moved = pose * Eigen::Vector3d(source().col(i));
    const Voxel* const voxel = voxels_.Find(moved);
    if (voxel == nullptr || (voxel->mean - moved).norm() > max_distance_) {
      return false;
    }
    term->target = voxel->mean;
    // B = I - k n n^T changes I + mean C by a matrix of rank one, so the
    // inverse follows by the formula of Sherman and Morrison.
    const double k = 1.0 - epsilon_;
    const Eigen::Vector3d normal = pose.rotation * source_.normals.col(i);
    const Eigen::Vector3d turned = voxel->inverse * normal;
    const double scale = k / (1.0 - k * normal.dot(turned));
    term->information = voxel->count * voxel->inverse +
                        (voxel->count * scale * turned) * turned.transpose();
    return true;
  }

 private:
  const DescribedCloud& source_;
  double epsilon_;
  double max_distance_;
  VoxelMap voxels_;
};

// Whether the indices of the voxels fit into a key.
bool Fits(const Points& points, double voxel_size) {
  if (points.cols() == 0) return true;
  const Eigen::Vector3d width =
      points.rowwise().maxCoeff() - points.rowwise().minCoeff();
  return (width.array() / voxel_size < kMaxCells - 2.0).all();
}

}  // namespace

bool VgicpOptions::IsValid(std::string* error) const {
  if (!(voxel_size > 0.0 && std::isfinite(voxel_size))) {
    std::ostringstream problem;
    problem << "voxel_size = " << voxel_size << ", must be > 0 and finite";
    *error = problem.str();
    return false;
  }
  return PlaneAlignmentOptions::IsValid(error);
}

std::unique_ptr<AlignmentTerms> MakeVgicpTerms(const DescribedCloud& source,
                                               const DescribedCloud& target,
                                               const VgicpOptions& options) {
  CHECK_EQ(source.points().cols(), source.normals.cols());
  CHECK_EQ(target.points().cols(), target.normals.cols());
  return std::make_unique<VgicpTerms>(source, target, options);
}

AlignmentSummary SolveVgicp(const DescribedCloud& source,
                            const DescribedCloud& target,
                            const Rigid3& initial_target_from_source,
                            const VgicpOptions& options) {
  AlignmentSummary summary;
  if (!options.IsValid(&summary.message)) return summary;
  if (!Fits(target.points(), options.voxel_size)) {
    summary.message =
        "the target is more than 2^21 voxels wide; remove stray points or "
        "enlarge voxel_size";
    return summary;
  }
  Stopwatch stopwatch;
  const auto terms = MakeVgicpTerms(source, target, options);
  const double voxel_seconds = stopwatch.Lap();
  summary =
      AlignLocally(initial_target_from_source, options.alignment, terms.get());
  summary.stage_times.push_back({"voxels", voxel_seconds});
  summary.stage_times.push_back({"alignment", stopwatch.Lap()});
  return summary;
}

AlignmentSummary SolveVgicp(const Points& source,
                            const Points& target,
                            const Rigid3& initial_target_from_source,
                            const VgicpOptions& options) {
  AlignmentSummary summary;
  if (!options.IsValid(&summary.message)) return summary;
  return SolveWithNormals(
      source,
      target,
      options,
      [&](const DescribedCloud& from, const DescribedCloud& onto) {
        return SolveVgicp(from, onto, initial_target_from_source, options);
      });
}

}  // namespace quatro
