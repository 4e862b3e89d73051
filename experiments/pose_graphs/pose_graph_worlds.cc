// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/pose_graphs/pose_graph_worlds.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <utility>

#include "features/base/random.h"

namespace quatro {
namespace {

using Pair = std::pair<std::size_t, std::size_t>;

constexpr double kStep = 1.0;          // [m]
constexpr double kStreet = 5.0;        // [m], between crossings.
constexpr double kMinWrong = 0.4;      // [m], from the true position.
constexpr double kLoopRange = 1.5;     // [m]
constexpr std::size_t kMinApart = 20;  // Steps between the ends of a loop.

Eigen::Vector3d NormalVector(Random* random) {
  Eigen::Vector3d v;
  for (int i = 0; i < 3; ++i) v[i] = random->Normal();
  return v;
}

Eigen::Matrix3d Exp(const Eigen::Vector3d& rotation) {
  const double angle = rotation.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix();
}

// Goes straight, left or right at each crossing, without leaving a square, and
// turns back only if there is no other way. The square is small enough for
// revisits.
std::vector<Rigid3> WalkManhattan(int num_poses, Random* random) {
  const double half =
      kStreet * std::max(1.0, std::round(std::sqrt(num_poses) / 8.0));
  std::vector<Rigid3> poses;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  int quarter = 0;
  const auto ahead = [&](int turn) -> Eigen::Vector3d {
    return position +
           kStreet * (RotationZ(M_PI_2 * turn) * Eigen::Vector3d::UnitX());
  };
  const int per_street = static_cast<int>(kStreet / kStep);
  for (int i = 0; i < num_poses; ++i) {
    if (i % per_street == 0) {
      position = position.array().round();
      const int turns[] = {0, 1, 3, 2};
      int wanted = turns[random->Below(3)];
      for (int k = 0;
           ahead(quarter + wanted).cwiseAbs().maxCoeff() > half + 0.1;
           ++k) {
        wanted = turns[k];
      }
      quarter += wanted;
    }
    poses.push_back({RotationZ(M_PI_2 * quarter), position});
    position +=
        kStep * (RotationZ(M_PI_2 * quarter) * Eigen::Vector3d::UnitX());
  }
  return poses;
}

int PosesPerTurn(int num_poses) {
  return std::max(8, static_cast<int>(std::round(std::sqrt(num_poses))));
}

// A spiral from near one pole to near the other, with x ahead and z outward.
std::vector<Rigid3> WalkSphere(int num_poses) {
  const int per_turn = PosesPerTurn(num_poses);
  const double radius = kStep * per_turn / (2.0 * M_PI);
  const auto at = [&](double i) -> Eigen::Vector3d {
    const double polar = M_PI * (0.15 + 0.7 * i / num_poses);
    const double azimuth = 2.0 * M_PI * i / per_turn;
    return radius * Eigen::Vector3d(std::sin(polar) * std::cos(azimuth),
                                    std::sin(polar) * std::sin(azimuth),
                                    std::cos(polar));
  };
  std::vector<Rigid3> poses;
  for (int i = 0; i < num_poses; ++i) {
    const Eigen::Vector3d out = at(i).normalized();
    const Eigen::Vector3d step = at(i + 0.5) - at(i - 0.5);
    const Eigen::Vector3d ahead = (step - out * out.dot(step)).normalized();
    Eigen::Matrix3d rotation;
    rotation << ahead, out.cross(ahead), out;
    poses.push_back({rotation, at(i)});
  }
  return poses;
}

std::vector<Pair> PairsNearby(const std::vector<Rigid3>& poses) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t j = i + kMinApart; j < poses.size(); ++j) {
      if ((poses[i].translation - poses[j].translation).squaredNorm() <=
          kLoopRange * kLoopRange) {
        pairs.emplace_back(i, j);
      }
    }
  }
  return pairs;
}

std::vector<Pair> PairsOnTurns(int num_poses) {
  std::vector<Pair> pairs;
  const int per_turn = PosesPerTurn(num_poses);
  for (int i = 0; i + per_turn < num_poses; ++i) {
    for (int j = i + per_turn - 1; j <= i + per_turn + 1; ++j) {
      if (j >= num_poses) continue;
      pairs.emplace_back(static_cast<std::size_t>(i),
                         static_cast<std::size_t>(j));
    }
  }
  return pairs;
}

// Keeps the first `count` pairs of a random order.
void Draw(std::size_t count, Random* random, std::vector<Pair>* pairs) {
  for (std::size_t i = 0; i < count; ++i) {
    std::swap((*pairs)[i], (*pairs)[i + random->Below(pairs->size() - i)]);
  }
  pairs->resize(count);
}

// Adds edges to a world with known true poses.
class EdgeMaker {
 public:
  EdgeMaker(const GraphWorldOptions& options, GraphWorld* world, Random* random)
      : options_(options), world_(*world), random_(*random) {}

  void AddRight(const Pair& pair) {
    const auto [t, r] = Noise();
    const Rigid3 truth = True(pair);
    Add(pair, {truth.rotation * Exp(r), truth.translation + t}, false);
  }

  void AddWrong() {
    const std::size_t n = world_.true_world_from_pose.size();
    const std::size_t reach =
        options_.max_wrong_steps == 0
            ? n
            : std::min(n, static_cast<std::size_t>(options_.max_wrong_steps));
    while (true) {
      const std::size_t i = random_.Below(n);
      const std::size_t j = i + kMinApart + random_.Below(reach);
      if (j >= n) continue;
      Eigen::Vector3d t, r;
      for (int k = 0; k < 3; ++k) {
        t[k] = 2.0 * random_.Uniform() - 1.0;
        r[k] = M_PI * (2.0 * random_.Uniform() - 1.0);
      }
      Flatten(&t, &r);
      const Rigid3 claim{Exp(r), t};
      const double error =
          (claim.translation - True({i, j}).translation).norm();
      if (error <= kMinWrong) continue;
      Add({i, j}, claim, true);
      return;
    }
  }

 private:
  Rigid3 True(const Pair& pair) const {
    return Inverse(world_.true_world_from_pose[pair.first]) *
           world_.true_world_from_pose[pair.second];
  }

  void Flatten(Eigen::Vector3d* t, Eigen::Vector3d* r) const {
    if (world_.graph.dimension == 3) return;
    t->z() = 0.0;
    r->head<2>().setZero();
  }

  std::pair<Eigen::Vector3d, Eigen::Vector3d> Noise() {
    Eigen::Vector3d t = options_.translation_sigma * NormalVector(&random_);
    Eigen::Vector3d r = options_.rotation_sigma * NormalVector(&random_);
    Flatten(&t, &r);
    return {t, r};
  }

  void Add(const Pair& pair, const Rigid3& measured, bool is_wrong) {
    const int n = world_.graph.dimension;
    const double t = 1.0 / options_.translation_sigma;
    const double r = 1.0 / options_.rotation_sigma;
    const int num_freedoms = n == 2 ? 3 : 6;
    Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(num_freedoms, r * r);
    diagonal.head(n).setConstant(t * t);
    PoseEdge edge;
    edge.from = pair.first;
    edge.to = pair.second;
    edge.from_from_to = measured;
    edge.information = diagonal.asDiagonal();
    world_.graph.edges.push_back(std::move(edge));
    world_.is_wrong.push_back(is_wrong);
  }

  const GraphWorldOptions& options_;
  GraphWorld& world_;
  Random& random_;
};

}  // namespace

bool GraphWorldOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  const double sigma_deg = rotation_sigma * 180.0 / M_PI;
  if (world != "manhattan" && world != "sphere") {
    problem << "world = " << world << ", must be manhattan or sphere";
  } else if (num_poses < 50 || num_poses > 1000000) {
    problem << "poses = " << num_poses << ", must be 50 to 1000000";
  } else if (num_loops < 0 || num_loops > 1000000) {
    problem << "loops = " << num_loops << ", must be 0 to 1000000";
  } else if (!(wrong_share >= 0.0 && wrong_share <= 1.0)) {
    problem << "wrong_share = " << wrong_share << ", must be 0 to 1";
  } else if (max_wrong_steps < 0) {
    problem << "max_wrong_steps = " << max_wrong_steps << ", must be >= 0";
  } else if (!(translation_sigma >= kMinSigma &&
               translation_sigma <= kMaxSigmaM)) {
    problem << "sigma_m = " << translation_sigma << ", must be " << kMinSigma
            << " to " << kMaxSigmaM;
  } else if (!(sigma_deg >= kMinSigma && sigma_deg <= kMaxSigmaDeg)) {
    problem << "sigma_deg = " << sigma_deg << ", must be " << kMinSigma
            << " to " << kMaxSigmaDeg;
  }
  *error = problem.str();
  return error->empty();
}

std::optional<GraphWorld> MakeGraphWorld(const GraphWorldOptions& options,
                                         std::string* error) {
  if (!options.IsValid(error)) return std::nullopt;
  const bool is_planar = options.world == "manhattan";
  Random random(options.seed);
  GraphWorld world;
  world.graph.dimension = is_planar ? 2 : 3;
  world.true_world_from_pose = is_planar
                                   ? WalkManhattan(options.num_poses, &random)
                                   : WalkSphere(options.num_poses);
  const std::size_t n = world.true_world_from_pose.size();
  auto pairs = is_planar ? PairsNearby(world.true_world_from_pose)
                         : PairsOnTurns(options.num_poses);
  const int num_wrong =
      static_cast<int>(std::lround(options.wrong_share * options.num_loops));
  const auto num_right =
      static_cast<std::size_t>(options.num_loops - num_wrong);
  if (pairs.size() < num_right) {
    *error = "loops = " + std::to_string(options.num_loops) +
             ", but the walk has " + std::to_string(pairs.size()) +
             " pairs of poses for inlier loops";
    return std::nullopt;
  }
  Draw(num_right, &random, &pairs);

  EdgeMaker edges(options, &world, &random);
  for (std::size_t i = 0; i + 1 < n; ++i) edges.AddRight({i, i + 1});
  for (const Pair& pair : pairs) edges.AddRight(pair);
  for (int i = 0; i < num_wrong; ++i) edges.AddWrong();

  world.graph.ids.resize(n);
  std::iota(world.graph.ids.begin(), world.graph.ids.end(), 0);
  world.graph.fixed = {0};
  world.graph.world_from_pose = world.true_world_from_pose;
  ChainOdometry(&world.graph);
  return world;
}

PoseGraph WithoutWrongLoops(const GraphWorld& world) {
  PoseGraph graph = world.graph;
  graph.edges.clear();
  for (std::size_t i = 0; i < world.graph.edges.size(); ++i) {
    if (!world.is_wrong[i]) graph.edges.push_back(world.graph.edges[i]);
  }
  return graph;
}

}  // namespace quatro
