// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "experiments/protocols/added_yaw.h"
#include "experiments/protocols/draw_evenly.h"
#include "experiments/protocols/interval_pairs.h"
#include "experiments/protocols/loop_pairs.h"
#include "experiments/protocols/problem_families.h"
#include "experiments/protocols/tilt.h"
#include "features/base/degree.h"
#include "tests/support/matchers.h"
#include "tests/support/random_problems.h"

namespace quatro::protocols_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string ScanOf(int frame) { return std::to_string(frame) + ".bin"; }

void Add(int frame, const Rigid3& pose, SequenceData* data) {
  data->scans[frame] = ScanOf(frame);
  data->world_from_sensor[frame] = pose;
}

// Rounds on a circle, with a fixed arc length per frame [m]; each round is 0.5
// m farther out than the previous one.
SequenceData Rounds(int num_frames, double radius, double step) {
  SequenceData data;
  data.name = "06";
  for (int i = 0; i < num_frames; ++i) {
    const double angle = i * step / radius;
    const double r = radius + 0.5 * std::floor(angle / (2.0 * M_PI));
    Add(i,
        {RotationZ(angle + M_PI / 2),
         {r * std::cos(angle), r * std::sin(angle), 0.0}},
        &data);
  }
  return data;
}

std::pair<int, int> FramesOf(const PairTask& task) {
  int source = 0, target = 0;
  EXPECT_EQ(std::sscanf(task.name.substr(task.name.find('/')).c_str(),
                        "/%d-%d",
                        &source,
                        &target),
            2)
      << task.name;
  return {source, target};
}

std::vector<std::string> NamesOf(const std::vector<PairTask>& tasks) {
  std::vector<std::string> names;
  for (const PairTask& task : tasks) names.push_back(task.name);
  return names;
}

PairSelection Select(const SequenceData& data, const LoopPairOptions& options) {
  std::string error;
  const auto selection = SelectLoopPairs(data, options, &error);
  EXPECT_TRUE(selection) << error;
  return selection.value_or(PairSelection());
}

TEST(DistanceBinTest, IsHalfOpenAndHasAName) {
  const DistanceBin bin = {8.0, 10.0};
  EXPECT_TRUE(bin.Contains(8.0));
  EXPECT_FALSE(bin.Contains(10.0));
  EXPECT_FALSE(bin.Contains(std::nan("")));
  EXPECT_EQ(bin.Name(), "8-10 m");
  EXPECT_EQ((DistanceBin{0.5, 2.0}.Name()), "0.5-2 m");
  std::string error;
  EXPECT_FALSE((DistanceBin{2.0, 2.0}.IsValid(&error)));
  EXPECT_THAT(error, HasSubstr("bin 2-2 m, must have 0 <= min < max"));
  EXPECT_FALSE((DistanceBin{-1.0, 2.0}.IsValid(&error)));
  EXPECT_FALSE((DistanceBin{0.0, INFINITY}.IsValid(&error)));
}

TEST(DrawEvenlyTest, IsSpreadAndHitsEachAsOften) {
  Random random(1);
  EXPECT_THAT(DrawEvenly(4, 0, random), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(DrawEvenly(4, 9, random), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(DrawEvenly(0, 9, random), IsEmpty());
  std::vector<int> hits(10);
  for (int i = 0; i < 3000; ++i) {
    const auto drawn = DrawEvenly(10, 3, random);
    ASSERT_EQ(drawn.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
      ++hits[drawn[k]];
      if (k == 0) continue;
      EXPECT_THAT(drawn[k] - drawn[k - 1], testing::AnyOf(3, 4));
    }
  }
  for (const int n : hits) EXPECT_NEAR(n, 900, 100);
}

// All pairs, from the definition.
TEST(FindLoopsTest, AreThoseOfTheDefinition) {
  SequenceData data = Rounds(400, 15.0, 0.6);
  for (const int frame : {17, 18, 200}) data.world_from_sensor.erase(frame);
  for (const auto& [gap, path] : {std::pair(100, 50.0),
                                  std::pair(10, 90.0),
                                  std::pair(152, 0.0),
                                  std::pair(0, 0.0)}) {
    const DistanceBin bin = {2.0, 5.0};
    LoopOptions options;
    options.min_frame_gap = gap;
    options.min_path = path;
    std::set<std::pair<int, int>> expected;
    std::map<int, double> s;
    const Eigen::Vector3d* last = nullptr;
    double length = 0.0;
    for (const auto& [i, pose] : data.world_from_sensor) {
      if (last != nullptr) length += (pose.translation - *last).norm();
      last = &pose.translation;
      s[i] = length;
      for (const auto& [j, other] : data.world_from_sensor) {
        const double distance = (pose.translation - other.translation).norm();
        if (i - j > gap && s[i] - (s.contains(j) ? s[j] : 1e9) >= path &&
            distance >= 2.0 && distance < 5.0) {
          expected.insert({i, j});
        }
      }
    }
    std::set<std::pair<int, int>> found;
    for (const Loop& loop : FindLoops(data, bin, options)) {
      EXPECT_TRUE(found.insert({loop.source, loop.target}).second);
      EXPECT_NEAR(loop.distance,
                  (data.world_from_sensor.at(loop.source).translation -
                   data.world_from_sensor.at(loop.target).translation)
                      .norm(),
                  1e-12);
    }
    EXPECT_EQ(found, expected) << gap << " " << path;
    EXPECT_GT(found.size(), 100u) << gap << " " << path;
  }
}

// A minute at a red light is not a loop.
TEST(FindLoopsTest, StandingStillIsNone) {
  SequenceData data;
  for (int i = 0; i < 600; ++i) {
    Add(i, {Eigen::Matrix3d::Identity(), {1e-3 * (i % 2), 0.0, 0.0}}, &data);
  }
  LoopOptions options;
  EXPECT_THAT(FindLoops(data, {0.0, 2.0}, options), IsEmpty());
  options.min_path = 0.0;
  EXPECT_GT(FindLoops(data, {0.0, 2.0}, options).size(), 100000u);
}

// Used frames are the first one and each at least the spacing after the last
// used one; the loops are all those between used frames.
TEST(FindLoopsTest, SpacingSkipsFrames) {
  const SequenceData data = Rounds(400, 15.0, 0.6);
  const DistanceBin bin = {2.0, 5.0};
  LoopOptions options;
  const std::vector<Loop> all = FindLoops(data, bin, options);
  options.min_pair_spacing = 2.0;
  std::set<int> used;
  double path = 0.0;
  double last_used = -1e9;
  const Eigen::Vector3d* last = nullptr;
  for (const auto& [frame, pose] : data.world_from_sensor) {
    if (last != nullptr) path += (pose.translation - *last).norm();
    last = &pose.translation;
    if (path - last_used < options.min_pair_spacing) continue;
    last_used = path;
    used.insert(frame);
  }
  EXPECT_NEAR(static_cast<double>(used.size()), 100.0, 2.0);  // Every fourth.
  std::set<std::pair<int, int>> expected;
  for (const Loop& loop : all) {
    if (used.contains(loop.source) && used.contains(loop.target)) {
      expected.insert({loop.source, loop.target});
    }
  }
  std::set<std::pair<int, int>> found;
  for (const Loop& loop : FindLoops(data, bin, options)) {
    found.insert({loop.source, loop.target});
  }
  EXPECT_EQ(found, expected);
  EXPECT_GT(found.size(), 20u);
  EXPECT_LT(found.size(), all.size() / 10);
}

TEST(SelectLoopPairsTest, KeepsToBinsGapAndNumber) {
  const SequenceData data = Rounds(900, 40.0, 0.8);
  LoopPairOptions options;
  options.max_pairs_per_bin = 40;
  const PairSelection selection = Select(data, options);
  ASSERT_EQ(selection.tasks.size(), 120u);
  EXPECT_THAT(selection.notes, IsEmpty());
  std::map<std::string, std::vector<int>> sources;
  for (const PairTask& task : selection.tasks) {
    const auto [source, target] = FramesOf(task);
    EXPECT_GT(source - target, 100);
    const double distance = task.true_target_from_source->translation.norm();
    EXPECT_TRUE((task.bin == "0-2 m" && distance < 2.0) ||
                (task.bin == "4-6 m" && distance >= 4.0 && distance < 6.0) ||
                (task.bin == "8-10 m" && distance >= 8.0 && distance < 10.0))
        << task.bin << " " << distance;
    sources[task.bin].push_back(source);
    EXPECT_EQ(task.source, ScanOf(source));
    EXPECT_EQ(task.target, ScanOf(target));
    EXPECT_EQ(task.set, "06");
    EXPECT_LT((task.true_target_from_source->ToMatrix() -
               (Inverse(data.world_from_sensor.at(target)) *
                data.world_from_sensor.at(source))
                   .ToMatrix())
                  .norm(),
              1e-12);
  }
  // In order, each once, and at most two of 40 in any twentieth of the path.
  // The first round of 314 frames has no loop.
  for (const auto& [bin, frames] : sources) {
    ASSERT_EQ(frames.size(), 40u) << bin;
    int largest_step = 0;
    for (std::size_t i = 1; i < frames.size(); ++i) {
      EXPECT_GT(frames[i], frames[i - 1]) << bin;
      largest_step = std::max(largest_step, frames[i] - frames[i - 1]);
    }
    EXPECT_LE(largest_step, 2 * (900 - 314) / 40) << bin;
  }
}

TEST(SelectLoopPairsTest, SeedDecidesAndOtherBinsDoNot) {
  const SequenceData data = Rounds(900, 40.0, 0.8);
  LoopPairOptions options;
  options.max_pairs_per_bin = 30;
  const auto names = NamesOf(Select(data, options).tasks);
  EXPECT_EQ(NamesOf(Select(data, options).tasks), names);
  options.seed = 2;
  EXPECT_NE(NamesOf(Select(data, options).tasks), names);
  options.seed = 1;
  options.bins = {{8.0, 10.0}};
  EXPECT_EQ(NamesOf(Select(data, options).tasks),
            std::vector<std::string>(names.begin() + 60, names.end()));
  options.bins = {{7.9999, 10.0}};
  EXPECT_NE(NamesOf(Select(data, options).tasks),
            std::vector<std::string>(names.begin() + 60, names.end()));
  options.bins = {{8.0, 10.0}};
  // Targets are drawn and not always the first or the last of a source.
  options.max_pairs_per_bin = 0;
  std::map<int, std::vector<int>> targets;
  for (const Loop& loop : FindLoops(data, options.bins[0], options.loop)) {
    targets[loop.source].push_back(loop.target);
  }
  int num_first = 0, num_last = 0, num = 0;
  for (const PairTask& task : Select(data, options).tasks) {
    const auto [source, target] = FramesOf(task);
    ++num;
    num_first += target == targets[source].front();
    num_last += target == targets[source].back();
  }
  EXPECT_EQ(num, static_cast<int>(targets.size()));
  EXPECT_GT(num_first, num / 20);
  EXPECT_LT(num_first, num / 2);
  EXPECT_GT(num_last, num / 20);
  EXPECT_LT(num_last, num / 2);
}

TEST(SelectLoopPairsTest, SeveralOfASourceAreSpread) {
  const SequenceData data = Rounds(900, 40.0, 0.8);
  LoopPairOptions options;
  options.bins = {{0.0, 12.0}};
  options.max_pairs_per_bin = 0;
  const std::size_t num_loops =
      FindLoops(data, options.bins[0], options.loop).size();
  const std::size_t num_sources = Select(data, options).tasks.size();
  options.max_pairs_per_source = 3;
  const PairSelection three = Select(data, options);
  EXPECT_GT(three.tasks.size(), 2 * num_sources);
  EXPECT_LE(three.tasks.size(), 3 * num_sources);
  std::map<int, std::vector<int>> targets;
  for (const PairTask& task : three.tasks) {
    const auto [source, target] = FramesOf(task);
    targets[source].push_back(target);
  }
  EXPECT_EQ(targets.size(), num_sources);
  for (const auto& [source, drawn] : targets) {
    ASSERT_LE(drawn.size(), 3u);
    for (std::size_t i = 1; i < drawn.size(); ++i) {
      EXPECT_GT(drawn[i], drawn[i - 1]) << source;
    }
    if (source > 500 && source < 600) {
      EXPECT_GT(drawn[2] - drawn[0], 10);
    }
  }
  options.max_pairs_per_source = 0;
  EXPECT_EQ(Select(data, options).tasks.size(), num_loops);
}

// The location of the world's origin does not change the pairs.
TEST(SelectLoopPairsTest, WorldDoesNotMatter) {
  const SequenceData data = Rounds(700, 30.0, 0.7);
  SequenceData moved = data;
  const Rigid3 other = {RandomRotation(3), {100.0, -50.0, 20.0}};
  for (auto& [frame, pose] : moved.world_from_sensor) pose = other * pose;
  LoopPairOptions options;
  options.bins = {{3.1, 7.3}};
  const auto a = Select(data, options).tasks, b = Select(moved, options).tasks;
  ASSERT_EQ(NamesOf(a), NamesOf(b));
  ASSERT_GT(a.size(), 50u);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_LT((a[i].true_target_from_source->ToMatrix() -
               b[i].true_target_from_source->ToMatrix())
                  .norm(),
              1e-10);
  }
}

TEST(SelectLoopPairsTest, TooFewAreNotedAndNoneIsNoError) {
  const SequenceData data = Rounds(900, 40.0, 0.8);
  LoopPairOptions options;
  options.bins = {{0.0, 2.0}, {300.0, 400.0}};
  options.max_pairs_per_bin = 10000;
  PairSelection selection = Select(data, options);
  EXPECT_GT(selection.tasks.size(), 300u);
  EXPECT_THAT(selection.notes, Contains("06: 0 pairs of 300-400 m, not 10000"));
  EXPECT_EQ(selection.notes.size(), 2u);
  EXPECT_THAT(Select(SequenceData(), options).tasks, IsEmpty());
}

TEST(SelectLoopPairsTest, InvalidOptionsAreNamed) {
  std::string error;
  LoopPairOptions options;
  options.bins = {};
  EXPECT_FALSE(SelectLoopPairs({}, options, &error));
  EXPECT_THAT(error, HasSubstr("bins is empty"));
  options = {};
  options.bins = {{5.0, 4.0}};
  EXPECT_FALSE(SelectLoopPairs({}, options, &error));
  EXPECT_THAT(error, HasSubstr("bin 5-4 m"));
  options = {};
  options.max_pairs_per_bin = -1;
  EXPECT_FALSE(SelectLoopPairs({}, options, &error));
  EXPECT_THAT(error, HasSubstr("max_pairs_per_bin = -1"));
  options = {};
  options.max_pairs_per_source = -1;
  EXPECT_FALSE(SelectLoopPairs({}, options, &error));
  EXPECT_THAT(error, HasSubstr("max_pairs_per_source = -1"));
  options = {};
  options.loop.min_frame_gap = -1;
  EXPECT_FALSE(SelectLoopPairs({}, options, &error));
  EXPECT_THAT(error, HasSubstr("min_frame_gap = -1"));
  options = {};
  options.loop.min_path = std::nan("");
  EXPECT_FALSE(SelectLoopPairs({}, options, &error));
  EXPECT_THAT(error, HasSubstr("min_path = nan"));
  options = {};
  options.loop.min_pair_spacing = -1.0;
  EXPECT_FALSE(SelectLoopPairs({}, options, &error));
  EXPECT_THAT(error, HasSubstr("min_pair_spacing = -1"));
}

TEST(SelectIntervalPairsTest, AreLaterFramesOntoEarlierOnes) {
  SequenceData data = Rounds(10, 15.0, 0.6);
  data.world_from_sensor.erase(4);
  IntervalPairOptions options;
  options.intervals = {5, 3};
  std::string error;
  auto selection = SelectIntervalPairs(data, options, &error);
  ASSERT_TRUE(selection) << error;
  std::vector<std::string> names = {"06/000005-000000",
                                    "06/000006-000001",
                                    "06/000007-000002",
                                    "06/000008-000003",
                                    "06/000003-000000",
                                    "06/000005-000002",
                                    "06/000006-000003",
                                    "06/000008-000005",
                                    "06/000009-000006"};
  EXPECT_EQ(NamesOf(selection->tasks), names);
  EXPECT_EQ(selection->tasks[3].bin, "interval 5");
  EXPECT_EQ(selection->tasks[4].bin, "interval 3");
  EXPECT_EQ(selection->num_without_pose, 3);
  EXPECT_THAT(selection->notes,
              ElementsAre("06: 1 pairs of interval 5 lack a pose",
                          "06: 2 pairs of interval 3 lack a pose"));
  options.is_chain = true;
  options.first_frame = 2;
  options.last_frame = 8;
  selection = SelectIntervalPairs(data, options, &error);
  ASSERT_TRUE(selection) << error;
  EXPECT_THAT(
      NamesOf(selection->tasks),
      ElementsAre("06/000007-000002", "06/000005-000002", "06/000008-000005"));
}

TEST(SelectIntervalPairsTest, SomeAreDrawnEvenly) {
  const SequenceData data = Rounds(300, 15.0, 0.6);
  IntervalPairOptions options;
  options.intervals = {1};
  options.max_pairs = 30;
  std::string error;
  const auto selection = SelectIntervalPairs(data, options, &error);
  ASSERT_TRUE(selection) << error;
  ASSERT_EQ(selection->tasks.size(), 30u);
  for (std::size_t i = 1; i < 30; ++i) {
    const int step = FramesOf(selection->tasks[i]).first -
                     FramesOf(selection->tasks[i - 1]).first;
    EXPECT_TRUE(step == 9 || step == 10) << step;
  }
  options.intervals = {0};
  EXPECT_FALSE(SelectIntervalPairs(data, options, &error));
  EXPECT_THAT(error, HasSubstr("interval = 0, must be >= 1"));
  options.intervals = {};
  EXPECT_FALSE(SelectIntervalPairs(data, options, &error));
  options = {};
  options.first_frame = 5;
  options.last_frame = 4;
  EXPECT_FALSE(SelectIntervalPairs(data, options, &error));
  EXPECT_THAT(error, HasSubstr("last_frame = 4, must be -1 or >="));
  options = {};
  EXPECT_THAT(SelectIntervalPairs({}, options, &error)->tasks, IsEmpty());
}

PairTask RandomTask(std::uint64_t seed) {
  PairTask task;
  task.name = "00/" + std::to_string(seed);
  task.bin = "interval 5";
  task.true_target_from_source =
      Rigid3{RandomRotation(seed), 9.0 * RandomDirection(seed)};
  task.ins = PairIns{AttitudeOf(RandomRotation(seed + 30)),
                     AttitudeOf(RandomRotation(seed + 60)),
                     0.01};
  return task;
}

// The motion of a rotated scan, and the attitude that an INS on it would
// measure.
TEST(AddYawTest, TurnedPointsGoWhereTheOthersWent) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const PairTask task = RandomTask(seed);
    const double yaw = 0.5 * static_cast<double>(seed) - 2.0;
    const PairTask turned = AddYaw(task, yaw);
    EXPECT_EQ(turned.added_yaw, yaw);
    const Points points = RandomPoints(20, 30.0, seed);
    const Points turned_points = RotationZ(yaw) * points;
    EXPECT_LT((turned.true_target_from_source->Apply(turned_points) -
               task.true_target_from_source->Apply(points))
                  .norm(),
              1e-10);
    EXPECT_LT((WorldFromBody(turned.ins->source) * turned_points -
               WorldFromBody(task.ins->source) * points)
                  .norm(),
              1e-10);
    EXPECT_LT(AngleBetween(WorldFromBody(turned.ins->target),
                           WorldFromBody(task.ins->target)),
              1e-12);
    EXPECT_EQ(turned.ins->std, 0.01);
    const PairTask back = AddYaw(turned, -yaw);
    EXPECT_NEAR(back.added_yaw, 0.0, 1e-15);
    EXPECT_LT((back.true_target_from_source->ToMatrix() -
               task.true_target_from_source->ToMatrix())
                  .norm(),
              1e-12);
  }
}

TEST(AddYawsTest, EveryTaskAgainForEachYaw) {
  PairTask negative;
  negative.name = "00/9";
  const std::vector<double> yaws = YawSteps();
  ASSERT_EQ(yaws.size(), 7u);
  EXPECT_NEAR(yaws[6], M_PI, 1e-12);
  const auto tasks = AddYaws({RandomTask(1), negative}, yaws);
  ASSERT_EQ(tasks.size(), 14u);
  EXPECT_EQ(tasks[0].bin, "yaw 0 deg");
  EXPECT_EQ(tasks[6].bin, "yaw 90 deg");
  EXPECT_EQ(tasks[6].name, "00/1 yaw 90 deg");
  EXPECT_EQ(tasks[7].name, "00/9 yaw 90 deg");
  EXPECT_FALSE(tasks[7].true_target_from_source);
  EXPECT_FALSE(tasks[7].ins);
  EXPECT_NEAR(tasks[13].added_yaw, M_PI, 1e-12);
  EXPECT_EQ(YawSteps(0.0).size(), 1u);
  EXPECT_EQ(YawSteps(-5.0).size(), 1u);
  EXPECT_EQ(YawSteps(100.0).size(), 2u);
}

TEST(MeasureTiltsTest, SplitsARotationIntoYawAndTheRest) {
  SequenceData data;
  data.name = "00";
  const double yaw = -170.0 * kDegree, pitch = 3.0 * kDegree;
  const double roll = -4.0 * kDegree;
  const Rigid3 first = {RandomRotation(1), {5.0, 0.0, 0.0}};
  Add(3, first, &data);
  Add(200, {Eigen::Matrix3d::Identity(), {200.0, 0.0, 0.0}}, &data);
  Add(400,
      first * Rigid3{WorldFromBody({roll, pitch, yaw}), {3.0, 0.0, 4.0}},
      &data);
  const auto tilts = MeasureTilts(data, {0.0, 10.0}, {});
  ASSERT_EQ(tilts.size(), 1u);
  EXPECT_THAT(tilts[0].yaw, IsAngleNear(yaw, 1e-12));
  EXPECT_NEAR(tilts[0].pitch, pitch, 1e-12);
  EXPECT_NEAR(tilts[0].roll, roll, 1e-12);
  // The rotation of two small rotations about perpendicular axes; exact, with
  // quaternions.
  EXPECT_NEAR(tilts[0].tilt,
              2.0 * std::acos(std::cos(pitch / 2) * std::cos(roll / 2)),
              1e-9);
  EXPECT_EQ(FormatTilts(tilts),
            "set,source,target,distance_m,yaw_deg,rollpitch_deg,roll_deg,"
            "pitch_deg\n"
            "00,400,3,5.0000,-170.00000,4.99963,-4.00000,3.00000\n");
}

TEST(ProblemFamiliesTest, ABinIsAStepAndHasSoManyProblems) {
  FamilyOptions options;
  options.num_problems = 2;
  options.noise_bound = 0.6;
  options.seed = 5;
  std::string error;
  const auto selection = SelectProblems(options, &error);
  ASSERT_TRUE(selection) << error;
  std::map<std::string, std::vector<std::string>> bins;
  std::set<std::string> names;
  for (const PairTask& task : selection->tasks) {
    bins[task.set].push_back(task.bin);
    EXPECT_TRUE(names.insert(task.name).second) << task.name;
    ASSERT_TRUE(task.make_problem && task.true_target_from_source);
    EXPECT_EQ(task.make_problem().true_target_from_source.ToMatrix(),
              task.true_target_from_source->ToMatrix());
  }
  ASSERT_EQ(bins.size(), FamilyNames().size());
  EXPECT_EQ(bins["outliers"].size(), 12u);
  // sigma = c / 12 ... 2 c / 3.
  EXPECT_THAT(bins["noise"],
              ElementsAre("0.05 m noise",
                          "0.05 m noise",
                          "0.1 m noise",
                          "0.1 m noise",
                          "0.2 m noise",
                          "0.2 m noise",
                          "0.4 m noise",
                          "0.4 m noise"));
  EXPECT_EQ(bins["quasi_inliers"].front(), "20 quasi-inliers");
}

TEST(ProblemFamiliesTest, ProblemsAreAsTheirBinSays) {
  FamilyOptions options;
  options.num_problems = 1;
  std::string error;
  const auto selection = SelectProblems(options, &error);
  ASSERT_TRUE(selection) << error;
  for (const PairTask& task : selection->tasks) {
    const MatchedProblem problem = task.make_problem();
    const Eigen::VectorXd errors =
        (problem.target - problem.true_target_from_source.Apply(problem.source))
            .colwise()
            .norm();
    // Only at the largest noise do four sigma exceed c.
    const auto num_true = static_cast<double>(
        (errors.array() < 1.6 * options.noise_bound).count());
    int number = 0;
    if (std::sscanf(task.bin.c_str(), "%d %% outliers", &number) == 1 &&
        task.set == "outliers") {
      EXPECT_EQ(problem.source.cols(), 1000);
      EXPECT_NEAR(num_true, 1000 - 10 * number, 2) << task.bin;
    } else if (task.set == "matches") {
      EXPECT_EQ(task.bin, std::to_string(problem.source.cols()) + " matches");
      EXPECT_NEAR(
          num_true, 0.05 * static_cast<double>(problem.source.cols()), 5);
    } else if (task.set == "degeneracy") {
      EXPECT_EQ(task.bin,
                std::to_string(std::lround(num_true)) + " of 50 true");
    } else if (task.set == "quasi_inliers") {
      EXPECT_EQ(problem.source.cols(), 500);
      const Eigen::VectorXd level =
          (problem.target -
           problem.true_target_from_source.Apply(problem.source))
              .topRows<2>()
              .colwise()
              .norm();
      std::sscanf(task.bin.c_str(), "%d", &number);
      const auto num_level = static_cast<double>(
          (level.array() < 1.6 * options.noise_bound).count());
      EXPECT_NEAR(num_level, 20 + number, 5);
    }
  }
}

TEST(ProblemFamiliesTest, SeedsMakeOtherProblemsAndBadOptionsAreTold) {
  FamilyOptions options;
  options.families = {"noise"};
  options.num_problems = 1;
  std::string error;
  const auto first = SelectProblems(options, &error);
  options.seed = 2;
  const auto second = SelectProblems(options, &error);
  ASSERT_TRUE(first && second) << error;
  EXPECT_NE(first->tasks[0].true_target_from_source->ToMatrix(),
            second->tasks[0].true_target_from_source->ToMatrix());

  const auto expect_refused = [&](const FamilyOptions& bad, const char* why) {
    EXPECT_FALSE(SelectProblems(bad, &error));
    EXPECT_THAT(error, HasSubstr(why));
  };
  FamilyOptions bad = options;
  bad.families = {"noise", "magic"};
  expect_refused(bad, "no family magic");
  bad.families = {"noise", "noise"};
  expect_refused(bad, "noise is listed twice");
  bad.families = {};
  expect_refused(bad, "there is no family");
  bad = options;
  bad.num_problems = 0;
  expect_refused(bad, "num_problems = 0");
  bad = options;
  bad.noise_bound = -0.1;
  expect_refused(bad, "noise_bound");
}

}  // namespace
}  // namespace quatro::protocols_test
