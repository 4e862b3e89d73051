// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The ladder on simulated scans 20 to 30 m apart, which the estimator alone
// does not register.

#include "robust/registration/ladder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "experiments/simulator/pair_sets.h"
#include "robust/registration/presets.h"
#include "robust/registration/registration.h"

namespace quatro::ladder_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const SetPair& FarPair() {
  static const SetPair pair = [] {
    PairSetOptions options;
    options.world = WorldKind::kCrossing;
    options.min_distance = 20.0;
    std::string error;
    // The first pair that quatro alone does not register.
    for (int index = 0; index < 10; ++index) {
      auto drawn = SimulateSetPair(options, index, &error);
      EXPECT_TRUE(drawn) << error;
      RegistrationOptions single;
      single.method = "quatro_single";
      if (!Register(drawn->source, drawn->target, single)
               .verdict.IsRegistered()) {
        return *drawn;
      }
    }
    ADD_FAILURE() << "too easy";
    return SetPair();
  }();
  return pair;
}

RegistrationSummary RegisterFar(const RegistrationOptions& options) {
  return Register(FarPair().source, FarPair().target, options);
}

void ExpectTrue(const std::optional<Rigid3>& pose) {
  ASSERT_TRUE(pose);
  const Rigid3& truth = *FarPair().true_target_from_source;
  EXPECT_LT((pose->translation - truth.translation).norm(), 2.0);
  EXPECT_LT(AngleBetween(pose->rotation, truth.rotation), 0.05);
}

TEST(Ladder, RegistersWhatTheEstimatorAloneDoesNot) {
  const RegistrationSummary summary = RegisterFar({});
  EXPECT_TRUE(summary.verdict.IsRegistered()) << summary.verdict.reason;
  EXPECT_GE(summary.rung, 1);
  ExpectTrue(summary.target_from_source());
  // The best candidate of the rung is the answer's.
  ASSERT_FALSE(summary.candidates.empty());
  for (const PoseCandidate& candidate : summary.candidates) {
    EXPECT_THAT(candidate.origin, HasSubstr("rung "));
  }
  // The matches are those of the rung.
  EXPECT_EQ(summary.matched_source.cols(), summary.matched_target.cols());
  EXPECT_EQ(summary.solution.num_matches, summary.matched_source.cols());
  EXPECT_FALSE(summary.solution.translation_inliers.empty());
  for (const Eigen::Index i : summary.solution.translation_inliers) {
    EXPECT_LT((*summary.target_from_source() *
                   Eigen::Vector3d(summary.matched_source.col(i)) -
               summary.matched_target.col(i))
                  .norm(),
              2.0);
  }
  // Each stage is named once.
  std::set<std::string> stages;
  for (const StageTime& time : summary.stage_times) {
    EXPECT_TRUE(stages.insert(time.stage).second) << time.stage;
  }
  EXPECT_TRUE(stages.contains("search"));
}

// The inliers of the clouds matched again near the pose are enough for a
// covariance, and their share is evidence.
TEST(Ladder, MatchesAgainNearASearchedPose) {
  RegistrationOptions options;
  const RegistrationSummary guided = RegisterFar(options);
  ASSERT_TRUE(guided.verdict.geometry);
  ASSERT_TRUE(guided.verdict.geometry->search);
  const SearchEvidence& search = *guided.verdict.geometry->search;
  EXPECT_GT(search.num_guided_inliers, guided.verdict.num_inliers);
  EXPECT_GT(search.num_guided_inliers, search.num_guided_matches / 20);
  EXPECT_EQ(search.is_first, guided.rung == 1);
  EXPECT_EQ(guided.verdict.features.back().name, "first_search");
  EXPECT_THAT(guided.verdict.reason,
              HasSubstr(std::to_string(search.num_guided_inliers) + " of " +
                        std::to_string(search.num_guided_matches) +
                        " guided matches are inliers"));
  options.search.guided_matching = false;
  const RegistrationSummary without = RegisterFar(options);
  ASSERT_TRUE(without.verdict.geometry);
  EXPECT_FALSE(without.verdict.geometry->search);
  EXPECT_EQ(without.target_from_source()->ToMatrix(),
            guided.target_from_source()->ToMatrix());
  // The covariance is that of the surfaces, which are the same.
  ASSERT_TRUE(guided.solution.covariance->covariance);
  ASSERT_TRUE(without.solution.covariance->covariance);
  ASSERT_TRUE(guided.error_radius);
  EXPECT_EQ(guided.solution.covariance->center,
            without.solution.covariance->center);
  // The estimator's own pose is not searched for.
  RegistrationOptions single;
  single.method = "quatro_single";
  const RegistrationSummary own = RegisterFar(single);
  ASSERT_TRUE(own.verdict.geometry);
  EXPECT_FALSE(own.verdict.geometry->search);
}

// Each source of proposals finds the pose alone, and nothing is proposed
// without them.
TEST(Ladder, EachSourceOfProposalsCanBeUsedAlone) {
  RegistrationOptions none;
  none.search.consensus = false;
  none.search.cliques = false;
  none.search.segments = false;
  EXPECT_THAT(RegisterFar(none).candidates, IsEmpty());
  RegistrationOptions segments = none;
  segments.search.segments = true;
  RegistrationOptions consensus = none;
  consensus.search.consensus = true;
  for (const auto& [options, name] : {std::pair{segments, "rung 1, segments"},
                                      std::pair{consensus, "rung 1"}}) {
    const RegistrationSummary summary = RegisterFar(options);
    ASSERT_THAT(summary.candidates, Not(IsEmpty())) << name;
    EXPECT_THAT(summary.candidates[0].origin, HasSubstr(name));
    ASSERT_TRUE(summary.target_from_source()) << name;
    EXPECT_LT((summary.target_from_source()->translation -
               FarPair().true_target_from_source->translation)
                  .norm(),
              0.5)
        << name;
  }
}

// The estimator's pose of a few inliers is polished by the surfaces.
TEST(Ladder, ASearchedPoseIsAsAccurateAsTheSurfaces) {
  const RegistrationSummary summary = RegisterFar({});
  ASSERT_TRUE(summary.target_from_source());
  const Rigid3& truth = *FarPair().true_target_from_source;
  EXPECT_LT(
      (summary.target_from_source()->translation - truth.translation).norm(),
      0.1);
  EXPECT_LT(
      AngleBetween(summary.target_from_source()->rotation, truth.rotation),
      0.005);
}

TEST(Ladder, ThreadsChangeNoBit) {
  const RegistrationSummary one = RegisterFar({});
  RegistrationOptions options;
  options.num_threads = 3;
  const RegistrationSummary three = RegisterFar(options);
  ASSERT_TRUE(one.target_from_source() && three.target_from_source());
  EXPECT_EQ(three.target_from_source()->ToMatrix(),
            one.target_from_source()->ToMatrix());
  EXPECT_EQ(three.verdict.reason, one.verdict.reason);
  ASSERT_EQ(three.candidates.size(), one.candidates.size());
  for (std::size_t k = 0; k < one.candidates.size(); ++k) {
    EXPECT_EQ(three.candidates[k].Score(), one.candidates[k].Score());
  }
}

// In level frames the search works on leveled copies of the clouds.
TEST(Ladder, WorksBehindTheDoor) {
  RegistrationOptions options;
  options.ins.mode = InsMode::kLeveled;
  options.ins.source_attitude = FarPair().source_ins;
  options.ins.target_attitude = FarPair().target_ins;
  options.verdict.min_probability = 1.0;  // All rungs are climbed.
  const RegistrationSummary summary = RegisterFar(options);
  ExpectTrue(summary.target_from_source());
  ASSERT_FALSE(summary.candidates.empty());
  // The candidates and the matches are in the frames of the clouds.
  ExpectTrue(summary.candidates.front().target_from_source);
  double nearest = 1e9;
  for (Eigen::Index i = 0; i < summary.matched_source.cols(); ++i) {
    nearest = std::min(nearest,
                       (summary.candidates.front().target_from_source *
                            Eigen::Vector3d(summary.matched_source.col(i)) -
                        summary.matched_target.col(i))
                           .norm());
  }
  EXPECT_LT(nearest, 0.5);
}

TEST(Ladder, IsNotClimbedWithoutNeed) {
  PairSetOptions near;
  near.world = WorldKind::kCrossing;
  near.max_distance = 3.0;
  std::string error;
  const auto pair = SimulateSetPair(near, 0, &error);
  ASSERT_TRUE(pair) << error;
  RegistrationSummary summary = Register(pair->source, pair->target, {});
  EXPECT_TRUE(summary.verdict.IsRegistered());
  EXPECT_EQ(summary.rung, 0);
  EXPECT_THAT(summary.candidates, IsEmpty());
  // The estimator's answer is all that is wanted.
  RegistrationOptions options;
  options.search.max_rung = 0;
  summary = RegisterFar(options);
  EXPECT_FALSE(summary.verdict.IsRegistered());
  EXPECT_THAT(summary.candidates, IsEmpty());
  // Other methods have no search.
  options = {};
  options.method = "teaser";
  EXPECT_THAT(RegisterFar(options).candidates, IsEmpty());
  for (const char* preset : {"paper", "reference"}) {
    EXPECT_EQ(MakePreset(preset)->search.max_rung, 0) << preset;
  }
}

// Scans tilted against each other, whose pose by yaw alone is registered.
class TiltedPair : public ::testing::Test {
 protected:
  TiltedPair() {
    PairSetOptions pairs;
    pairs.world = WorldKind::kHill;
    pairs.max_distance = 12.0;
    pairs.min_tilt = 0.1;
    yaw_only_.quatro.polish = false;
    std::string error;
    for (int index = 0; index < 12 && !pair_; ++index) {
      auto drawn = SimulateSetPair(pairs, index, &error);
      EXPECT_TRUE(drawn) << error;
      RegistrationOptions single = yaw_only_;
      single.method = "quatro_single";
      RegistrationSummary summary =
          Register(drawn->source, drawn->target, single);
      if (!summary.verdict.IsRegistered()) continue;
      pair_ = std::move(drawn);
      single_ = std::move(summary);
    }
  }

  double RotationError(const RegistrationSummary& summary) const {
    return AngleBetween(summary.target_from_source()->rotation,
                        pair_->true_target_from_source->rotation);
  }

  RegistrationOptions yaw_only_;
  std::optional<SetPair> pair_;
  RegistrationSummary single_;
};

TEST_F(TiltedPair, IsAlignedBeforeItsPoseCounts) {
  ASSERT_TRUE(pair_) << "no pose by yaw alone is registered";
  EXPECT_GT(RotationError(single_), 0.08);
  const RegistrationSummary summary =
      Register(pair_->source, pair_->target, yaw_only_);
  ASSERT_TRUE(summary.target_from_source());
  EXPECT_LT(RotationError(summary), 0.03);
  EXPECT_TRUE(summary.verdict.IsRegistered()) << summary.verdict.reason;
  EXPECT_EQ(summary.rung, 0);
  EXPECT_EQ(summary.matched_source, single_.matched_source);
}

// A few inliers give a tilt, but not a good one.
TEST(Ladder, APoseOfFewInliersIsAlignedWithTheClouds) {
  PairSetOptions pairs;
  pairs.max_distance = 15.0;
  std::string error;
  const auto pair = SimulateSetPair(pairs, 6, &error);
  ASSERT_TRUE(pair) << error;
  RegistrationOptions options;
  options.front_end.tuple.num_triples_per_match = 3;  // Few pass.
  const RegistrationSummary summary =
      Register(pair->source, pair->target, options);
  options.method = "quatro_single";
  const RegistrationSummary single =
      Register(pair->source, pair->target, options);
  ASSERT_TRUE(single.verdict.IsRegistered());
  EXPECT_EQ(single.solution.model, PoseModel::kRigid);
  EXPECT_LT(single.solution.num_translation_inliers, 25);
  const auto error_of = [&](const RegistrationSummary& of) {
    return AngleBetween(of.target_from_source()->rotation,
                        pair->true_target_from_source->rotation);
  };
  EXPECT_GT(error_of(single), 0.005);
  EXPECT_LT(error_of(summary), 0.002);
  EXPECT_EQ(summary.rung, 0);
}

// Each try after the first needs the evidence of a searched pose.
TEST(Register, OnlyTheFirstTryHasTheVerdictOfASinglePose) {
  PairSetOptions set;
  set.no_overlap = true;
  set.sensor = "vlp16";
  std::set<std::string> tries;
  for (int index = 0; index < 2; ++index) {
    std::string error;
    const auto pair = SimulateSetPair(set, index, &error);
    ASSERT_TRUE(pair) << error;
    const RegistrationSummary summary =
        Register(pair->source,
                 pair->target,
                 MakeAutoOptions(pair->source, pair->target));
    ASSERT_TRUE(summary.target_from_source());
    const bool is_first = summary.rung == 0 && summary.leveled_by == "given" &&
                          summary.scale_factor == 1.0;
    const bool is_searched = std::any_of(
        summary.verdict.features.begin(),
        summary.verdict.features.end(),
        [](const Feature& feature) { return feature.name == "guided"; });
    EXPECT_NE(is_searched, is_first) << summary.verdict.reason;
    tries.insert(is_first ? "first" : "other");
  }
  EXPECT_TRUE(tries.count("other"));
}

// The tilt of an INS is not estimated again.
TEST_F(TiltedPair, KeepsTheTiltOfAnIns) {
  ASSERT_TRUE(pair_);
  RegistrationOptions options = yaw_only_;
  options.ins.mode = InsMode::kLeveled;
  options.ins.source_attitude = pair_->source_ins;
  options.ins.target_attitude = pair_->target_ins;
  const RegistrationSummary summary =
      Register(pair_->source, pair_->target, options);
  options.method = "quatro_single";
  const RegistrationSummary single =
      Register(pair_->source, pair_->target, options);
  ASSERT_TRUE(single.verdict.IsRegistered()) << single.verdict.reason;
  EXPECT_EQ(summary.target_from_source()->ToMatrix(),
            single.target_from_source()->ToMatrix());
}

TEST(Ladder, StopsAtTheTimeLimit) {
  RegistrationOptions options;
  options.search.time_limit_seconds = 0.0;
  const RegistrationSummary summary = RegisterFar(options);
  EXPECT_FALSE(summary.verdict.IsRegistered());
  EXPECT_THAT(summary.candidates, IsEmpty());
  EXPECT_FALSE(summary.verdict.reason.empty());
}

TEST(Ladder, TriesScalesUntilOneIsRegistered) {
  RegistrationOptions options;
  options.method = "quatro";
  // Half the usual lengths, times two.
  for (double* length : {&options.front_end.voxel_size,
                         &options.front_end.normal_radius,
                         &options.front_end.fpfh_radius,
                         &options.noise_bound}) {
    *length /= 2.0;
  }
  options.search.scale_factors = {2.0, 1.0};
  const RegistrationSummary summary = RegisterFar(options);
  EXPECT_TRUE(summary.verdict.IsRegistered());
  EXPECT_EQ(summary.scale_factor, 2.0);
  // The tolerance is that of the clouds.
  EXPECT_EQ(summary.verdict.tolerance.translation,
            ToleranceOf(options.noise_bound).translation);
  ExpectTrue(summary.target_from_source());
  const RegistrationSummary usual = RegisterFar({});
  EXPECT_EQ(summary.target_from_source()->ToMatrix(),
            usual.target_from_source()->ToMatrix());
  EXPECT_EQ(usual.scale_factor, 1.0);
  // The best of several that are not registered is the most probable.
  options.search.scale_factors = {2.0, 4.0};
  options.verdict.min_probability = 1.0;
  const RegistrationSummary best = RegisterFar(options);
  options.search.scale_factors = {4.0};
  const RegistrationSummary other = RegisterFar(options);
  EXPECT_GE(best.verdict.probability, other.verdict.probability);
}

TEST(Ladder, CandidatesAreWithinTheBounds) {
  RegistrationOptions options;
  options.bounds.guess = *FarPair().true_target_from_source;
  options.bounds.max_translation = 5.0;
  options.verdict.min_probability = 1.0;  // Search in any case.
  const RegistrationSummary near = RegisterFar(options);
  ExpectTrue(near.target_from_source());
  EXPECT_FALSE(near.candidates.empty());
  for (const PoseCandidate& candidate : near.candidates) {
    EXPECT_TRUE(options.bounds.Contain(candidate.target_from_source,
                                       options.noise_bound));
  }
  // If the true pose is excluded, nothing is registered.
  options.verdict = VerdictOptions();
  options.bounds.guess.translation.x() += 40.0;
  const RegistrationSummary far = RegisterFar(options);
  EXPECT_FALSE(far.verdict.IsRegistered());
  for (const PoseCandidate& candidate : far.candidates) {
    EXPECT_TRUE(options.bounds.Contain(candidate.target_from_source,
                                       options.noise_bound));
  }
}

TEST(Ladder, ScansOfDifferentPlacesAreNotRegistered) {
  PairSetOptions set;
  set.no_overlap = true;
  for (int index = 0; index < 3; ++index) {
    std::string error;
    const auto pair = SimulateSetPair(set, index, &error);
    ASSERT_TRUE(pair) << error;
    const RegistrationSummary summary =
        Register(pair->source, pair->target, {});
    EXPECT_FALSE(summary.verdict.IsRegistered()) << summary.verdict.reason;
    EXPECT_FALSE(summary.candidates.empty());
  }
}

// Flat ground fits itself after any shift; no surface could show which.
TEST(Register, FlatGroundIsNotRegistered) {
  PointCloud source;
  source.points.resize(3, 40 * 40);
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) {
      source.points.col(40 * i + j) << 0.5 * i, 0.5 * j, 0.0;
    }
  }
  PointCloud target = source;
  target.points.row(0).array() += 3.0;
  const RegistrationSummary summary = Register(source, target, {});
  EXPECT_FALSE(summary.verdict.IsRegistered()) << summary.verdict.reason;
  EXPECT_LT(summary.verdict.probability, 0.8);
  EXPECT_FALSE(summary.verdict.reason.empty());
}

TEST(PoseSearchOptions, ErrorsNameTheField) {
  const auto error_of = [](const auto& change) {
    RegistrationOptions options;
    change(&options.search);
    std::string error;
    EXPECT_FALSE(options.IsValid(&error));
    return error;
  };
  EXPECT_THAT(error_of([](auto* o) { o->max_rung = 4; }),
              HasSubstr("search.max_rung = 4, must be in [0, 3]"));
  EXPECT_THAT(error_of([](auto* o) { o->scale_factors = {}; }),
              HasSubstr("search.scale_factors"));
  EXPECT_THAT(error_of([](auto* o) {
                o->scale_factors = {1.0, 0.0};
              }),
              HasSubstr("search.scale_factors"));
  EXPECT_THAT(error_of([](auto* o) { o->time_limit_seconds = -1.0; }),
              HasSubstr("search.time_limit_seconds = -1"));
  EXPECT_THAT(error_of([](auto* o) { o->max_num_proposals = 0; }),
              HasSubstr("search.max_num_proposals = 0"));
  EXPECT_THAT(error_of([](auto* o) { o->num_aligned = 0; }),
              HasSubstr("search.num_aligned = 0"));
  EXPECT_THAT(error_of([](auto* o) { o->max_tilt = -0.1; }),
              HasSubstr("search.max_tilt = -0.1"));
  EXPECT_THAT(error_of([](auto* o) { o->bound_factor = 0.0; }),
              HasSubstr("search.bound_factor = 0"));
}

}  // namespace
}  // namespace quatro::ladder_test
