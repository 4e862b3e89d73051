// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Conversions to and from PCL, which uses single precision. Points are
// therefore stored relative to a nearby origin.

#ifndef QUATRO_EXPERIMENTS_PEERS_PCL_CLOUD_H_
#define QUATRO_EXPERIMENTS_PEERS_PCL_CLOUD_H_

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Geometry>

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

inline PclCloud::Ptr ToPclCloud(const PointsRef& points,
                                const Eigen::Vector3d& origin) {
  PclCloud::Ptr cloud(new PclCloud);
  for (const auto point : points.colwise()) {
    const Eigen::Vector3f p = (point - origin).cast<float>();
    cloud->push_back({p.x(), p.y(), p.z()});
  }
  return cloud;
}

// Converts a matrix between points relative to `origin` to a motion of the
// points themselves.
inline Rigid3 FromPclMatrix(const Eigen::Matrix4f& matrix,
                            const Eigen::Vector3d& origin) {
  const Eigen::Matrix3d block = matrix.topLeftCorner<3, 3>().cast<double>();
  Rigid3 pose{Eigen::Quaterniond(block).normalized().toRotationMatrix(),
              matrix.topRightCorner<3, 1>().cast<double>()};
  pose.translation += origin - pose.rotation * origin;
  return pose;
}

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PEERS_PCL_CLOUD_H_
