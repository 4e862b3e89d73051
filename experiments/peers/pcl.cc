// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/peers/pcl.h"

#include <glog/logging.h>
#include <pcl/features/fpfh.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <cstddef>

namespace quatro {

Eigen::MatrixXf ComputeFpfhByPcl(const PointsRef& points,
                                 const PointsRef& normals,
                                 double radius) {
  CHECK_EQ(points.cols(), normals.cols());
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  pcl::PointCloud<pcl::Normal>::Ptr cloud_normals(
      new pcl::PointCloud<pcl::Normal>);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3f p = points.col(i).cast<float>();
    const Eigen::Vector3f n = normals.col(i).cast<float>();
    cloud->push_back({p.x(), p.y(), p.z()});
    cloud_normals->push_back({n.x(), n.y(), n.z()});
  }
  pcl::FPFHEstimation<pcl::PointXYZ, pcl::Normal, pcl::FPFHSignature33>
      estimation;
  estimation.setInputCloud(cloud);
  estimation.setInputNormals(cloud_normals);
  estimation.setSearchMethod(pcl::search::KdTree<pcl::PointXYZ>::Ptr(
      new pcl::search::KdTree<pcl::PointXYZ>));
  estimation.setRadiusSearch(radius);
  pcl::PointCloud<pcl::FPFHSignature33> signatures;
  estimation.compute(signatures);
  Eigen::MatrixXf fpfh(33, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const auto& signature = signatures[static_cast<std::size_t>(i)];
    fpfh.col(i) =
        Eigen::Map<const Eigen::Matrix<float, 33, 1>>(signature.histogram);
  }
  return fpfh;
}

}  // namespace quatro
