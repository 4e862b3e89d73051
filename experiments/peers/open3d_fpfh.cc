// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/peers/open3d_fpfh.h"

#include <glog/logging.h>
#include <open3d/geometry/KDTreeSearchParam.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/Feature.h>
#include <open3d/utility/Logging.h>

namespace quatro {

Fpfh ComputeFpfhByOpen3d(const Points& points,
                         const Points& normals,
                         double radius) {
  CHECK_EQ(points.cols(), normals.cols());
  if (points.cols() == 0) return {};  // Open3D would throw.
  open3d::utility::SetVerbosityLevel(open3d::utility::VerbosityLevel::Error);
  open3d::geometry::PointCloud cloud;
  for (const auto point : points.colwise()) cloud.points_.emplace_back(point);
  for (const auto normal : normals.colwise()) {
    cloud.normals_.emplace_back(normal);
  }
  const auto features = open3d::pipelines::registration::ComputeFPFHFeature(
      cloud, open3d::geometry::KDTreeSearchParamRadius(radius));
  Fpfh fpfh = features->data_.cast<float>();
  for (Eigen::Index i = 0; i < fpfh.cols(); ++i) {
    if (normals.col(i).isZero(0.0)) fpfh.col(i).setZero();
  }
  return fpfh;
}

}  // namespace quatro
