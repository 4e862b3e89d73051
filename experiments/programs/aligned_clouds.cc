// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/aligned_clouds.h"

#include "features/io/cloud_io.h"

namespace quatro {
namespace {

PointCloud MoveCloud(const PointCloud& source,
                     const Rigid3& target_from_source) {
  PointCloud moved;
  moved.points = target_from_source.Apply(source.points);
  moved.intensity = source.intensity;
  return moved;
}

PointCloud JoinClouds(const PointCloud& source,
                      const PointCloud& target,
                      const Rigid3& target_from_source) {
  const Eigen::Index num_source = source.points.cols();
  const Eigen::Index num_target = target.points.cols();
  PointCloud joined;
  joined.points.resize(3, num_source + num_target);
  joined.points << target_from_source.Apply(source.points), target.points;
  joined.intensity.resize(num_source + num_target);
  joined.intensity << Eigen::VectorXf::Zero(num_source),
      Eigen::VectorXf::Ones(num_target);
  return joined;
}

}  // namespace

bool AlignedOutput::IsValid(std::string* error) const {
  if (clouds != "source" && clouds != "both") {
    *error = "--output_clouds=" + clouds + ", must be source or both";
    return false;
  }
  if (path.empty()) {
    if (clouds == "source") return true;
    *error = "--output_clouds=both has no effect without --output";
    return false;
  }
  if (path == "-") {
    *error =
        "--output=-: a cloud cannot go to standard output, because the ending "
        "of its name says the format; name a .bin, .ply or .pcd file";
    return false;
  }
  // The cloud only serves to check whether the ending is known.
  PointCloud any;
  any.points.setZero(3, 1);
  if (FormatCloud(any, path, error)) return true;
  *error = "--output=" + *error;
  return false;
}

std::optional<std::string> AlignedOutput::Format(
    const PointCloud& source,
    const PointCloud& target,
    const Rigid3& target_from_source,
    std::string* error) const {
  return FormatCloud(clouds == "both"
                         ? JoinClouds(source, target, target_from_source)
                         : MoveCloud(source, target_from_source),
                     path,
                     error);
}

}  // namespace quatro
