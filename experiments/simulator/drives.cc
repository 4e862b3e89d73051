// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/drives.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <utility>

#include "experiments/runner/stop_signal.h"
#include "experiments/simulator/building.h"
#include "experiments/simulator/city.h"
#include "experiments/simulator/kitti_layout.h"
#include "experiments/simulator/lidar.h"
#include "experiments/simulator/naver_layout.h"
#include "experiments/simulator/road.h"
#include "experiments/simulator/sensors.h"
#include "experiments/simulator/street_objects.h"
#include "features/base/random.h"

namespace quatro {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kCartHeight = 0.9;  // [m]

struct Plan {
  const char* name;
  int num_streets_u, num_streets_v;
  double block, max_grade, terrace;  // [m], [rad], 0 .. 1.
  const char* route;                 // Crossings: two digits, u and v.
};

constexpr Plan kPlans[] = {
    {"00",
     4,
     3,
     90.0,
     0.04,
     0.3,
     "00 10 20 21 11 01 00 10 11 12 22 21 20 10 00 01 02 12 11 21 31 30 20 10"},
    {"02",
     5,
     4,
     140.0,
     0.14,
     0.1,
     "00 10 20 30 31 21 22 32 42 43 33 23 13 12 02 01 11 12 22 21"},
    {"05",
     3,
     3,
     95.0,
     0.05,
     0.3,
     "00 10 20 21 22 12 11 10 00 01 11 21 20 10 11 12 02 01 00 10"},
    {"06", 2, 2, 190.0, 0.03, 0.2, "00 10 11 01 00 10 11"},
    {"07", 2, 2, 100.0, 0.03, 0.5, "00 10 11 01 00 10"},
    {"08", 3, 2, 110.0, 0.06, 0.3, "11 01 00 10 11 21 20 10 00 01 11"},
    {"hd_b1",
     4,
     3,
     0.0,
     0.0,
     0.0,
     "00 10 20 21 11 01 00 10 11 12 22 21 20 30 31 21 20 10 00"}};

const Plan* PlanOf(const std::string& name) {
  for (const Plan& plan : kPlans) {
    if (name == plan.name) return &plan;
  }
  return nullptr;
}

std::vector<Crossing> Route(const Plan& plan) {
  std::vector<Crossing> route;
  std::istringstream words(plan.route);
  for (std::string word; words >> word;) {
    route.emplace_back(word[0] - '0', word[1] - '0');
  }
  return route;
}

// Roll and pitch of a vehicle on its suspension, s meters from the start.
class Springs {
 public:
  Springs(double sigma, Random& random) {
    for (auto* waves : {&roll_, &pitch_}) {
      for (int i = 0; i < kNumWaves; ++i) {
        waves->push_back({sigma * std::sqrt(2.0 / kNumWaves),
                          2.0 * M_PI / Uniform(random, 6.0, 25.0),
                          Uniform(random, 0.0, 2.0 * M_PI)});
      }
    }
  }

  Rigid3 At(double s) const {
    return {LevelFromBody(Sum(roll_, s), Sum(pitch_, s)), Vector3d::Zero()};
  }

 private:
  static constexpr int kNumWaves = 3;
  struct Wave {
    double amplitude, frequency, phase;
  };

  static double Sum(const std::vector<Wave>& waves, double s) {
    double sum = 0.0;
    for (const Wave& wave : waves) {
      sum += wave.amplitude * std::sin(wave.frequency * s + wave.phase);
    }
    return sum;
  }

  std::vector<Wave> roll_, pitch_;
};

Rigid3 Up(double height) {
  return {Eigen::Matrix3d::Identity(), Vector3d(0.0, 0.0, height)};
}

// The direction of the path at its i-th point.
Vector2d Along(const std::vector<Vector2d>& way, size_t i) {
  const size_t before = i == 0 ? 0 : i - 1;
  return way[std::min(i + 1, way.size() - 1)] - way[before];
}

void KeepFrames(const DriveOptions& options, std::vector<Vector2d>* way) {
  if (options.num_frames > 0 &&
      static_cast<size_t>(options.num_frames) < way->size()) {
    way->resize(static_cast<size_t>(options.num_frames));
  }
}

// Cars that drive along their street and start again at its end.
struct Traffic {
  struct Car {
    std::vector<Vector2d> way;  // One point per frame.
    size_t start;
    Scene scene;  // In the car's frame.
  };
  std::vector<Car> cars;
};

Traffic MakeTraffic(const City& city, int num_cars, Random& random) {
  Traffic traffic;
  const CityOptions& options = city.options();
  for (int i = 0; i < num_cars; ++i) {
    const bool is_along_u = random.Uniform() < 0.5;
    const int last =
        is_along_u ? options.num_streets_u - 1 : options.num_streets_v - 1;
    const auto line = static_cast<int>(random.Below(static_cast<uint64_t>(
        is_along_u ? options.num_streets_v : options.num_streets_u)));
    Crossing from = is_along_u ? Crossing(0, line) : Crossing(line, 0);
    Crossing to = is_along_u ? Crossing(last, line) : Crossing(line, last);
    if (random.Uniform() < 0.5) std::swap(from, to);
    if (from == to) continue;
    const double speed = Uniform(random, 4.0, 12.0);  // [m/s]
    Traffic::Car car;
    car.way = PlanDrive(city, {from, to}, speed * kFramePeriod);
    car.start = random.Below(car.way.size());
    AddCar(Rigid3(), Uniform(random, 3.8, 4.8), random, car.scene);
    traffic.cars.push_back(std::move(car));
  }
  return traffic;
}

Drive MakeCityDrive(const DriveOptions& options, const Plan& plan) {
  CityOptions city_options;
  city_options.seed = options.seed + Mix(static_cast<uint64_t>(&plan - kPlans));
  city_options.num_streets_u = plan.num_streets_u;
  city_options.num_streets_v = plan.num_streets_v;
  city_options.block = plan.block;
  city_options.max_grade = plan.max_grade;
  city_options.terrace = plan.terrace;
  const auto city = std::make_shared<const City>(city_options);
  Random random(Mix(city_options.seed) ^ 11);
  const Springs springs(options.tilt_sigma, random);
  Drive drive;
  drive.scene = city->MakeScene();
  drive.sensor = "hdl64e";
  std::vector<Vector2d> way =
      PlanDrive(*city, Route(plan), options.frame_spacing);
  const Vector2d first_step = Along(way, 0);
  KeepFrames(options, &way);
  for (size_t i = 0; i < way.size(); ++i) {
    const Vector2d along = way.size() > 1 ? Along(way, i) : first_step;
    drive.world_from_sensor.push_back(
        city->WorldFromCar(way[i], along) *
        springs.At(static_cast<double>(i) * options.frame_spacing) *
        Up(Road::kSensorHeight));
  }
  const auto traffic = std::make_shared<const Traffic>(
      MakeTraffic(*city, options.num_moving_cars, random));
  drive.moving = [city, traffic, way](int frame) {
    constexpr double kTooClose = 7.0;  // To the car with the sensor [m].
    Scene scene;
    for (const Traffic::Car& car : traffic->cars) {
      const size_t i =
          (car.start + static_cast<size_t>(frame)) % car.way.size();
      if ((car.way[i] - way[static_cast<size_t>(frame)]).norm() < kTooClose) {
        continue;
      }
      scene.Append(car.scene,
                   city->WorldFromCar(car.way[i], Along(car.way, i)));
    }
    return scene;
  };
  return drive;
}

Drive MakeBuildingDrive(const DriveOptions& options, const Plan& plan) {
  constexpr double kFine = 0.05;  // [m]
  const Building building(options.seed, plan.num_streets_u, plan.num_streets_v);
  Random random(Mix(options.seed) ^ 12);
  const Springs springs(options.tilt_sigma, random);
  Drive drive;
  drive.scene = building.MakeScene();
  drive.sensor = "vlp16";
  drive.moving = [](int) { return Scene(); };
  const std::vector<Crossing> route = Route(plan);
  std::vector<Vector2d> fine;
  for (size_t i = 0; i + 1 < route.size(); ++i) {
    const Vector2d from = building.Crossing(route[i].x(), route[i].y());
    const Vector2d to = building.Crossing(route[i + 1].x(), route[i + 1].y());
    const double length = (to - from).norm();
    for (double t = 0.0; t < length; t += kFine) {
      fine.emplace_back(from + t / length * (to - from));
    }
  }
  // Rounds off the corners.
  constexpr size_t kWindow = 30;
  std::vector<Vector2d> way;
  const auto step =
      std::max<size_t>(1, static_cast<size_t>(options.frame_spacing / kFine));
  for (size_t i = kWindow; i + kWindow < fine.size(); i += step) {
    Vector2d sum = Vector2d::Zero();
    for (size_t j = i - kWindow; j <= i + kWindow; ++j) sum += fine[j];
    way.emplace_back(sum / (2.0 * kWindow + 1.0));
  }
  const Vector2d first_step = Along(way, 0);
  KeepFrames(options, &way);
  for (size_t i = 0; i < way.size(); ++i) {
    const Vector2d along = way.size() > 1 ? Along(way, i) : first_step;
    const Rigid3 on_floor = {RotationZ(std::atan2(along.y(), along.x())),
                             Vector3d(way[i].x(), way[i].y(), 0.0)};
    drive.world_from_sensor.push_back(
        on_floor * springs.At(static_cast<double>(i) * options.frame_spacing) *
        Up(kCartHeight));
  }
  return drive;
}

// Rates from differences between the previous and the next frame.
InsReading RatesAt(const std::vector<Rigid3>& poses, size_t i) {
  const size_t before = i == 0 ? 0 : i - 1;
  const size_t after = std::min(i + 1, poses.size() - 1);
  InsReading reading;
  reading.position = poses[i].translation;
  if (before == after) return reading;
  const double period = kFramePeriod * static_cast<double>(after - before);
  reading.velocity =
      (poses[after].translation - poses[before].translation) / period;
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(
      poses[before].rotation.transpose() * poses[after].rotation));
  reading.turn_rate = turn.angle() / period * turn.axis();
  if (before + 1 == i && i + 1 == after) {
    reading.acceleration =
        (poses[after].translation - 2.0 * poses[i].translation +
         poses[before].translation) /
        (kFramePeriod * kFramePeriod);
  }
  return reading;
}

bool WriteFrames(const DriveOptions& options,
                 const std::function<void(int, int)>& progress,
                 SequenceWriter& writer,
                 std::string* error) {
  const Drive drive = MakeDrive(options);
  const auto lidar = MakeSensor(
      options.sensor == "auto" ? drive.sensor : options.sensor, error);
  if (!lidar) return false;
  const auto scene = LidarScene::Create(drive.scene, error);
  if (scene == nullptr) return false;
  const std::vector<InsReading> readings = MeasureDrive(drive, options);
  const auto num_frames = static_cast<int>(drive.world_from_sensor.size());
  for (int i = 0; i < num_frames; ++i) {
    if (WasAskedToStop()) {
      *error = "stopped";
      return false;
    }
    const auto frame = static_cast<size_t>(i);
    const Scene moving = drive.moving(i);
    std::unique_ptr<LidarScene> others;
    if (!moving.triangles.empty()) {
      others = LidarScene::Create(moving, error);
      if (others == nullptr) return false;
    }
    Sweep sweep;
    if (options.has_sweep_motion) {
      sweep.velocity = readings[frame].velocity * kFramePeriod;
      sweep.turn = readings[frame].turn_rate * kFramePeriod;
    }
    const PointCloud cloud = scene->Scan(drive.world_from_sensor[frame],
                                         *lidar,
                                         {options.seed, frame},
                                         options.num_threads,
                                         sweep,
                                         others.get());
    if (!writer.Add(cloud,
                    drive.world_from_sensor[frame],
                    i * kFramePeriod,
                    &readings[frame],
                    error)) {
      return false;
    }
    if (progress) progress(i + 1, num_frames);
  }
  return true;
}

}  // namespace

std::vector<std::string> DriveNames() {
  std::vector<std::string> names;
  for (const Plan& plan : kPlans) names.emplace_back(plan.name);
  return names;
}

bool DriveOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  std::string lower;
  const auto is_angle = [](double sigma) {
    return sigma >= 0.0 && sigma <= 0.2;
  };
  if (PlanOf(name) == nullptr) {
    problem << "name = '" << name << "', must be one of";
    for (const std::string& known : DriveNames()) problem << " " << known;
  } else if (num_frames < 0) {
    problem << "num_frames = " << num_frames << ", must be >= 0";
  } else if (!(frame_spacing >= 0.1 && frame_spacing <= 50.0)) {
    problem << "frame_spacing = " << frame_spacing << ", must be in [0.1, 50]";
  } else if (sensor != "auto" && !MakeSensor(sensor, &lower)) {
    problem << "sensor = " << lower << " auto";
  } else if (num_moving_cars < 0 || num_moving_cars > 1000) {
    problem << "num_moving_cars = " << num_moving_cars
            << ", must be in [0, 1000]";
  } else if (!is_angle(tilt_sigma)) {
    problem << "tilt_sigma = " << tilt_sigma << ", must be in [0, 0.2]";
  } else if (!is_angle(ins_sigma)) {
    problem << "ins_sigma = " << ins_sigma << ", must be in [0, 0.2]";
  } else if (!is_angle(ins_bias_sigma)) {
    problem << "ins_bias_sigma = " << ins_bias_sigma << ", must be in [0, 0.2]";
  } else if (layout != "kitti" && layout != "naver") {
    problem << "layout = '" << layout << "', must be kitti or naver";
  } else if (num_threads < 0) {
    problem << "num_threads = " << num_threads << ", must be >= 0";
  }
  *error = problem.str();
  return error->empty();
}

Drive MakeDrive(const DriveOptions& options) {
  const Plan& plan = *PlanOf(options.name);
  return options.name == "hd_b1" ? MakeBuildingDrive(options, plan)
                                 : MakeCityDrive(options, plan);
}

std::vector<InsReading> MeasureDrive(const Drive& drive,
                                     const DriveOptions& options) {
  // Each drive has its own INS errors; the building's number is 0, so only the
  // seed determines them.
  const auto number = static_cast<uint64_t>(PlanOf(options.name) - kPlans + 1) %
                      std::size(kPlans);
  Random random(Mix(options.seed ^ number << 32) ^ 13);
  Attitude bias;
  for (double* angle : {&bias.roll, &bias.pitch, &bias.yaw}) {
    *angle = options.ins_bias_sigma * random.Normal();
  }
  std::vector<InsReading> readings;
  for (size_t i = 0; i < drive.world_from_sensor.size(); ++i) {
    const Eigen::Matrix3d& R = drive.world_from_sensor[i].rotation;
    InsReading reading = RatesAt(drive.world_from_sensor, i);
    const double noise[] = {options.ins_sigma * random.Normal(),
                            options.ins_sigma * random.Normal(),
                            options.ins_sigma * random.Normal()};
    reading.attitude.roll = std::atan2(R(2, 1), R(2, 2)) + bias.roll + noise[0];
    reading.attitude.pitch =
        std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2))) + bias.pitch +
        noise[1];
    reading.attitude.yaw = Yaw(R) + bias.yaw + noise[2];
    readings.push_back(reading);
  }
  return readings;
}

bool SimulateDrive(const DriveOptions& options,
                   const std::string& output_dir,
                   const std::function<void(int, int)>& progress,
                   std::string* error) {
  if (!options.IsValid(error)) return false;
  std::unique_ptr<SequenceWriter> writer;
  if (options.layout == "naver") {
    writer = MakeNaverWriter(output_dir, options.overwrite, error);
  } else {
    writer = MakeKittiWriter(output_dir, options.overwrite, error);
  }
  return writer != nullptr && WriteFrames(options, progress, *writer, error) &&
         writer->Finish(error);
}

}  // namespace quatro
