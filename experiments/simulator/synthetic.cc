// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/synthetic.h"

#include <Eigen/Geometry>
#include <cmath>

#include "features/base/random.h"

namespace quatro {
namespace {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  double Between(double low, double high) {
    return low + (high - low) * random_.Uniform();
  }

  Eigen::Vector3d Noise(double sigma) {
    const double x = random_.Normal();
    const double y = random_.Normal();
    return sigma * Eigen::Vector3d(x, y, random_.Normal());
  }

  Eigen::Vector3d Point() {
    const double x = Between(-50.0, 50.0);
    const double y = Between(-50.0, 50.0);
    return {x, y, Between(-4.0, 4.0)};
  }

  // The attitude measured with an error of standard deviation `sigma` per
  // angle.
  Attitude Seen(const Attitude& attitude, double sigma) {
    const Eigen::Vector3d error = Noise(sigma);
    return {attitude.roll + error.x(),
            attitude.pitch + error.y(),
            attitude.yaw + error.z()};
  }

  Rigid3 Motion() {
    Rigid3 motion;
    motion.rotation = RotationZ(Between(-M_PI, M_PI));
    motion.translation.x() = Between(-20.0, 20.0);
    motion.translation.y() = Between(-20.0, 20.0);
    motion.translation.z() = Between(-1.0, 1.0);
    return motion;
  }

 private:
  Random random_;
};

MatchedProblem WithRandomTargets(Eigen::Index num_matches, Draw* draw) {
  MatchedProblem problem;
  problem.true_target_from_source = draw->Motion();
  problem.source.resize(3, num_matches);
  problem.target.resize(3, num_matches);
  for (Eigen::Index i = 0; i < num_matches; ++i) {
    problem.source.col(i) = draw->Point();
    problem.target.col(i) = draw->Point();
  }
  return problem;
}

void MakeTrue(Eigen::Index i,
              double noise_sigma,
              Draw* draw,
              MatchedProblem* problem) {
  problem->target.col(i) = problem->true_target_from_source *
                               Eigen::Vector3d(problem->source.col(i)) +
                           draw->Noise(noise_sigma);
}

}  // namespace

MatchedProblem MakeOutlierProblem(Eigen::Index num_matches,
                                  double outlier_ratio,
                                  double noise_sigma,
                                  std::uint64_t seed) {
  Draw draw(seed);
  MatchedProblem problem = WithRandomTargets(num_matches, &draw);
  const auto num_outliers = static_cast<Eigen::Index>(
      std::llround(outlier_ratio * static_cast<double>(num_matches)));
  for (Eigen::Index i = num_outliers; i < num_matches; ++i) {
    MakeTrue(i, noise_sigma, &draw, &problem);
  }
  return problem;
}

MatchedProblem MakeDegenerateProblem(Eigen::Index num_matches,
                                     Eigen::Index num_true,
                                     double noise_sigma,
                                     double consistency_bound,
                                     std::uint64_t seed) {
  Draw draw(seed);
  MatchedProblem problem = WithRandomTargets(num_matches, &draw);
  for (Eigen::Index i = 0; i < num_true; ++i) {
    MakeTrue(i, noise_sigma, &draw, &problem);
  }
  const auto is_consistent_with_one_before = [&](Eigen::Index i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double a = (problem.source.col(i) - problem.source.col(j)).norm();
      const double b = (problem.target.col(i) - problem.target.col(j)).norm();
      if (std::abs(a - b) <= consistency_bound) return true;
    }
    return false;
  };
  for (Eigen::Index i = num_true; i < num_matches; ++i) {
    while (is_consistent_with_one_before(i)) {
      problem.source.col(i) = draw.Point();
      problem.target.col(i) = draw.Point();
    }
  }
  return problem;
}

MatchedProblem MakeQuasiInlierProblem(Eigen::Index num_matches,
                                      Eigen::Index num_true,
                                      Eigen::Index num_quasi,
                                      double noise_sigma,
                                      std::uint64_t seed) {
  Draw draw(seed);
  MatchedProblem problem = WithRandomTargets(num_matches, &draw);
  for (Eigen::Index i = 0; i < num_true + num_quasi; ++i) {
    MakeTrue(i, noise_sigma, &draw, &problem);
    if (i < num_true) continue;
    const double size = draw.Between(0.5, 3.0);
    problem.target(2, i) += draw.Between(-1.0, 1.0) < 0.0 ? -size : size;
  }
  return problem;
}

MatchedProblem MakeTimProblem(Eigen::Index num_tims,
                              double outlier_ratio,
                              double noise_sigma,
                              std::uint64_t seed) {
  Draw draw(seed);
  MatchedProblem problem;
  problem.true_target_from_source.rotation =
      RotationZ(draw.Between(-M_PI, M_PI));
  problem.source.resize(3, num_tims);
  problem.target.resize(3, num_tims);
  const auto num_outliers = static_cast<Eigen::Index>(
      std::llround(outlier_ratio * static_cast<double>(num_tims)));
  for (Eigen::Index k = 0; k < num_tims; ++k) {
    problem.source.col(k) = draw.Point() - draw.Point();
    MakeTrue(k, noise_sigma, &draw, &problem);
    if (k < num_outliers) {
      const Eigen::Vector3d turned =
          RotationZ(draw.Between(-M_PI, M_PI)) * problem.target.col(k);
      problem.target.col(k) = turned;
    }
  }
  return problem;
}

SlopeProblem MakeSlopeProblem(Eigen::Index num_matches,
                              double outlier_ratio,
                              double noise_sigma,
                              double tilt,
                              double attitude_std,
                              std::uint64_t seed) {
  Draw draw(seed);
  SlopeProblem problem;
  MatchedProblem& matches = problem.matches;
  matches = WithRandomTargets(num_matches, &draw);
  const double heading = draw.Between(-M_PI, M_PI);
  const Eigen::Vector3d axis(std::cos(heading), std::sin(heading), 0.0);
  Eigen::Matrix3d& rotation = matches.true_target_from_source.rotation;
  rotation = (Eigen::AngleAxisd(tilt, axis) * rotation).eval();
  const auto num_outliers = static_cast<Eigen::Index>(
      std::llround(outlier_ratio * static_cast<double>(num_matches)));
  for (Eigen::Index i = num_outliers; i < num_matches; ++i) {
    MakeTrue(i, noise_sigma, &draw, &matches);
  }
  Attitude target;
  target.roll = draw.Between(-0.1, 0.1);
  target.pitch = draw.Between(-0.1, 0.1);
  target.yaw = draw.Between(-M_PI, M_PI);
  const Attitude source = AttitudeOf(WorldFromBody(target) * rotation);
  problem.target_attitude = draw.Seen(target, attitude_std);
  problem.source_attitude = draw.Seen(source, attitude_std);
  return problem;
}

}  // namespace quatro
