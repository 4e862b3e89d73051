// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/peers/pcl_ransac.h"

#include <pcl/console/print.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_registration.h>

#include <stdexcept>

#include "experiments/peers/pcl_cloud.h"
#include "experiments/peers/peer_summary.h"

namespace quatro {
namespace {

// Sets a seed, because PCL's own seed is always the same.
struct Model : pcl::SampleConsensusModelRegistration<pcl::PointXYZ> {
  Model(const PclCloud::ConstPtr& source,
        const PclCloud::ConstPtr& target,
        std::uint64_t seed)
      : pcl::SampleConsensusModelRegistration<pcl::PointXYZ>(source) {
    setInputTarget(target);
    rng_alg_.seed(static_cast<unsigned>(seed));
  }
};

Rigid3 Solve(const PointsRef& source,
             const PointsRef& target,
             double noise_bound,
             const PclRansacOptions& options) {
  // Relative to the mean of the target, a large common offset costs no digits.
  const Eigen::Vector3d origin = target.rowwise().mean();
  const pcl::shared_ptr<Model> model(new Model(
      ToPclCloud(source, origin), ToPclCloud(target, origin), options.seed));
  pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, noise_bound);
  ransac.setMaxIterations(options.max_iterations);
  ransac.setProbability(options.confidence);
  if (!ransac.computeModel()) throw std::runtime_error("no sample has a model");
  pcl::Indices inliers;
  ransac.getInliers(inliers);
  Eigen::VectorXf coefficients;
  ransac.getModelCoefficients(coefficients);
  Eigen::VectorXf refined = coefficients;
  model->optimizeModelCoefficients(inliers, coefficients, refined);
  return FromPclMatrix(
      Eigen::Map<const Eigen::Matrix<float, 4, 4, Eigen::RowMajor>>(
          refined.data()),
      origin);
}

}  // namespace

PoseSummary SolveByPclRansac(const PointsRef& source,
                             const PointsRef& target,
                             double noise_bound,
                             const PclRansacOptions& options) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  return SolveByPeer(source, target, noise_bound, "PCL", "pcl_ransac", [&] {
    return Solve(source, target, noise_bound, options);
  });
}

}  // namespace quatro
