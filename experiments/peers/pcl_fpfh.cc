// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/peers/pcl_fpfh.h"

#include <glog/logging.h>
#include <pcl/features/fpfh.h>
#include <pcl/search/kdtree.h>

#include <cstddef>

#include "experiments/peers/pcl_cloud.h"

namespace quatro {

Fpfh ComputeFpfhByPcl(const Points& points,
                      const Points& normals,
                      double radius) {
  CHECK_EQ(points.cols(), normals.cols());
  if (points.cols() == 0) return {};
  pcl::PointCloud<pcl::Normal>::Ptr cloud_normals(
      new pcl::PointCloud<pcl::Normal>);
  for (const auto normal : normals.colwise()) {
    const Eigen::Vector3f n = normal.cast<float>();
    cloud_normals->push_back({n.x(), n.y(), n.z()});
  }
  pcl::FPFHEstimation<pcl::PointXYZ, pcl::Normal, pcl::FPFHSignature33>
      estimation;
  estimation.setInputCloud(ToPclCloud(points, points.rowwise().mean()));
  estimation.setInputNormals(cloud_normals);
  estimation.setSearchMethod(pcl::search::KdTree<pcl::PointXYZ>::Ptr(
      new pcl::search::KdTree<pcl::PointXYZ>));
  estimation.setRadiusSearch(radius);
  pcl::PointCloud<pcl::FPFHSignature33> signatures;
  estimation.compute(signatures);
  Fpfh fpfh = Fpfh::Zero(kFpfhSize, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Map<const Eigen::Vector<float, kFpfhSize>> bins(
        signatures[static_cast<std::size_t>(i)].histogram);
    if (bins.allFinite() && !normals.col(i).isZero(0.0)) fpfh.col(i) = bins;
  }
  return fpfh;
}

}  // namespace quatro
