// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/lidar.h"

#if QUATRO_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <utility>

#include "features/base/degree.h"
#include "features/base/parallel.h"
#include "features/base/random.h"

namespace quatro {
namespace {

using Eigen::Vector3d;

// Counter-based random numbers: the values of one ray do not depend on previous
// rays.
class RayNoise {
 public:
  RayNoise(const ScanId& id, uint64_t ray)
      : key_(Mix(Mix(Mix(id.seed) ^ id.frame) ^ ray)) {}

  // Uniform in (0, 1).
  double Uniform(uint64_t stream) const {
    return (static_cast<double>(Mix(key_ ^ stream) >> 12) + 0.5) * 0x1p-52;
  }

  // Box-Muller, from streams `stream` and `stream + 1`.
  double Normal(uint64_t stream) const {
    return std::sqrt(-2.0 * std::log(Uniform(stream))) *
           std::cos(2.0 * M_PI * Uniform(stream + 1));
  }

 private:
  uint64_t key_;
};

enum Stream : uint64_t { kPhase, kDropout, kRange, kIntensity = 4 };

constexpr uint64_t kNoRay = ~uint64_t{0};

// Equation (2).
double MissProbability(const LidarOptions& options,
                       double range,
                       double cos_incidence,
                       double reflectance) {
  const double faint_range =
      options.max_range *
      std::sqrt(reflectance / 0.8 * std::sqrt(cos_incidence));
  const double ratio = range / std::max(faint_range, 1e-3);
  return 1.0 - (1.0 - options.dropout_rate) / (1.0 + std::pow(ratio, 8));
}

void Intersect(RTCScene scene, RTCRayHit* hit) {
#if QUATRO_EMBREE_MAJOR >= 4
  rtcIntersect1(scene, hit);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, hit);
#endif
}

struct Echo {
  Vector3d point;
  float intensity = -1.0f;  // Negative: no echo.
};

// The pose of the sensor after this fraction of a frame.
Rigid3 PoseAt(const Rigid3& world_from_sensor,
              const Sweep& sweep,
              double fraction) {
  if (sweep.IsStill()) return world_from_sensor;
  const Vector3d turn = (fraction - 0.5) * sweep.turn;  // Equation (3).
  const Eigen::AngleAxisd rotation(turn.norm(), turn.stableNormalized());
  return {world_from_sensor.rotation * rotation.toRotationMatrix(),
          world_from_sensor.translation + (fraction - 0.5) * sweep.velocity};
}

RTCRayHit MakeRay(const Vector3d& from,
                  const Vector3d& direction,
                  double max_range) {
  const Eigen::Vector3f origin = from.cast<float>();
  RTCRayHit hit = {};
  hit.ray.org_x = origin.x();
  hit.ray.org_y = origin.y();
  hit.ray.org_z = origin.z();
  hit.ray.dir_x = static_cast<float>(direction.x());
  hit.ray.dir_y = static_cast<float>(direction.y());
  hit.ray.dir_z = static_cast<float>(direction.z());
  hit.ray.tnear = 0.0f;
  hit.ray.tfar = static_cast<float>(max_range);
  hit.ray.mask = ~0u;
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return hit;
}

// The points of the rays with an echo.
PointCloud MakeCloud(std::vector<Echo> echoes) {
  std::erase_if(echoes, [](const Echo& echo) { return echo.intensity < 0.0f; });
  PointCloud cloud;
  cloud.points.resize(3, static_cast<Eigen::Index>(echoes.size()));
  cloud.intensity.resize(cloud.points.cols());
  for (Eigen::Index i = 0; i < cloud.points.cols(); ++i) {
    const Echo& echo = echoes[static_cast<size_t>(i)];
    cloud.points.col(i) = echo.point;
    cloud.intensity[i] = echo.intensity;
  }
  return cloud;
}

}  // namespace

std::vector<double> Hdl64Elevations() {
  std::vector<double> elevations;
  elevations.reserve(64);
  for (int i = 0; i < 32; ++i) {
    elevations.push_back((2.0 - i / 3.0) * kDegree);
  }
  for (int i = 0; i < 32; ++i) {
    elevations.push_back((-8.0 - 5.0 / 6.0 - i / 2.0) * kDegree);
  }
  return elevations;
}

bool LidarOptions::IsValid(std::string* error) const {
  if (!RayPattern::IsValid(error)) return false;
  std::ostringstream problem;
  if (!(min_range >= 0.0)) {
    problem << "min_range = " << min_range << ", must be >= 0";
  } else if (!(max_range > min_range) || !std::isfinite(max_range)) {
    problem << "max_range = " << max_range
            << ", must be finite and > min_range = " << min_range;
  } else if (!(range_sigma >= 0.0) || !std::isfinite(range_sigma)) {
    problem << "range_sigma = " << range_sigma << ", must be finite and >= 0";
  } else if (!(range_sigma_growth >= 0.0) ||
             !std::isfinite(range_sigma_growth)) {
    problem << "range_sigma_growth = " << range_sigma_growth
            << ", must be finite and >= 0";
  } else if (!(dropout_rate >= 0.0 && dropout_rate <= 1.0)) {
    problem << "dropout_rate = " << dropout_rate << ", must be in [0, 1]";
  }
  *error = problem.str();
  return error->empty();
}

std::unique_ptr<LidarScene> LidarScene::Create(const Scene& scene,
                                               std::string* error) {
  std::unique_ptr<LidarScene> result(new LidarScene);
  // A tree built by one thread is reproducible, which settles ties between
  // triangles that share an edge.
  result->device_ = rtcNewDevice("threads=1");
  if (result->device_ == nullptr) {
    *error = "Embree has no device";
    return nullptr;
  }
  const RTCDevice device = result->device_;
  const RTCGeometry geometry =
      rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry,
                                           RTC_BUFFER_TYPE_VERTEX,
                                           0,
                                           RTC_FORMAT_FLOAT3,
                                           sizeof(scene.vertices[0]),
                                           scene.vertices.size());
  void* triangles = rtcSetNewGeometryBuffer(geometry,
                                            RTC_BUFFER_TYPE_INDEX,
                                            0,
                                            RTC_FORMAT_UINT3,
                                            sizeof(scene.triangles[0]),
                                            scene.triangles.size());
  if (vertices != nullptr && triangles != nullptr) {
    using Vertex = decltype(scene.vertices)::value_type;
    using Triangle = decltype(scene.triangles)::value_type;
    std::uninitialized_copy(scene.vertices.begin(),
                            scene.vertices.end(),
                            static_cast<Vertex*>(vertices));
    std::uninitialized_copy(scene.triangles.begin(),
                            scene.triangles.end(),
                            static_cast<Triangle*>(triangles));
    rtcCommitGeometry(geometry);
    result->scene_ = rtcNewScene(device);
    rtcSetSceneFlags(result->scene_, RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometry(result->scene_, geometry);
    rtcCommitScene(result->scene_);
  }
  rtcReleaseGeometry(geometry);
  const RTCError code = rtcGetDeviceError(device);
  if (code != RTC_ERROR_NONE) {
    *error = "Embree error " + std::to_string(code) + " on a scene of " +
             std::to_string(scene.triangles.size()) + " triangles";
    return nullptr;
  }
  result->reflectances_ = scene.reflectances;
  return result;
}

LidarScene::~LidarScene() {
  if (scene_ != nullptr) rtcReleaseScene(scene_);
  if (device_ != nullptr) rtcReleaseDevice(device_);
}

PointCloud LidarScene::Scan(const Rigid3& world_from_sensor,
                            const LidarOptions& options,
                            const ScanId& id,
                            int num_threads,
                            const Sweep& sweep,
                            const LidarScene* others) const {
  const auto num_columns = static_cast<size_t>(options.num_columns);
  const double phase = RayNoise(id, kNoRay).Uniform(kPhase);
  const auto cast = [&](size_t beam, size_t column) -> Echo {
    const auto [direction, fraction] = RayOf(options, beam, column, phase);
    const Rigid3 pose = PoseAt(world_from_sensor, sweep, fraction);
    const Vector3d direction_in_world = pose.rotation * direction;

    RTCRayHit hit =
        MakeRay(pose.translation, direction_in_world, options.max_range);
    Intersect(scene_, &hit);
    const LidarScene* seen = this;
    if (others != nullptr) {
      const float behind = hit.ray.tfar;
      Intersect(others->scene_, &hit);
      if (hit.ray.tfar < behind) seen = others;
    }
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};

    const Vector3d normal(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z);
    const double cos_incidence =
        std::min(1.0,
                 std::abs(normal.dot(direction_in_world)) /
                     std::max(normal.norm(), 1e-12));
    const double reflectance = seen->reflectances_[hit.hit.primID];
    const double range = hit.ray.tfar;
    if (range < options.min_range) return {};
    const RayNoise noise(id, beam * num_columns + column);
    if (noise.Uniform(kDropout) <
        MissProbability(options, range, cos_incidence, reflectance)) {
      return {};
    }
    const double brightness = reflectance * (0.35 + 0.65 * cos_incidence) *
                              (1.0 + 0.08 * noise.Normal(kIntensity));
    Echo echo;
    const double sigma = options.range_sigma + options.range_sigma_growth *
                                                   range *
                                                   range;  // Equation (1).
    echo.point = direction * (range + sigma * noise.Normal(kRange));
    echo.intensity = static_cast<float>(std::clamp(brightness, 0.0, 1.0));
    return echo;
  };

  std::vector<Echo> echoes(options.elevations.size() * num_columns);
  ParallelFor(num_threads,
              static_cast<Eigen::Index>(echoes.size()),
              options.num_columns,
              [&](Eigen::Index begin, Eigen::Index end) {
                for (auto i = static_cast<size_t>(begin);
                     i < static_cast<size_t>(end);
                     ++i) {
                  echoes[i] = cast(i / num_columns, i % num_columns);
                }
              });

  return MakeCloud(std::move(echoes));
}

}  // namespace quatro
