// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/report/pair_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "experiments/report/base64.h"
#include "experiments/report/match_stages.h"
#include "experiments/report/quantized_points.h"
#include "experiments/report/thinning.h"
#include "tests/support/matched_problems.h"
#include "tests/support/room_scans.h"

namespace quatro::pair_view_test {
namespace {

// The points that the page reads from the bytes.
Points UnquantizePoints(const std::string& bytes, const PointGrid& grid) {
  Points points(3, static_cast<Eigen::Index>(bytes.size() / 6));
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    const auto at = static_cast<std::size_t>(2 * i);
    const auto low = static_cast<unsigned char>(bytes[at]);
    const auto high = static_cast<unsigned char>(bytes[at + 1]);
    const auto whole =
        static_cast<std::int16_t>(static_cast<std::uint16_t>(low | high << 8));
    points(i % 3, i / 3) = grid.origin(i % 3) + grid.step * whole;
  }
  return points;
}

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// The inverse of EncodeBase64().
std::string DecodeBase64(const std::string& text) {
  const std::string digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int num_bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    num_bits += 6;
    if (num_bits < 8) continue;
    num_bits -= 8;
    bytes += static_cast<char>(bits >> num_bits & 0xffu);
  }
  return bytes;
}

TEST(Base64, IsThatOfTheRfc) {
  EXPECT_EQ(EncodeBase64(""), "");
  EXPECT_EQ(EncodeBase64("f"), "Zg==");
  EXPECT_EQ(EncodeBase64("fo"), "Zm8=");
  EXPECT_EQ(EncodeBase64("foo"), "Zm9v");
  EXPECT_EQ(EncodeBase64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(EncodeBase64("\xff\xfe\xfd"), "//79");
}

TEST(QuantizedPoints, AreOffByHalfAStepAtMost) {
  Random random(1);
  for (const double offset : {0.0, -300.0, 5e5}) {
    const Points points =
        RandomPointsInBox(500, {90.0, 40.0, 5.0}, &random).array() + offset;
    const PointGrid grid = FindGrid(points);
    EXPECT_LT(grid.step, 180.0 / 65534.0);
    const std::string bytes = QuantizePoints(points, grid);
    EXPECT_EQ(bytes.size(), 3000u);
    const double error =
        (UnquantizePoints(bytes, grid) - points).cwiseAbs().maxCoeff();
    EXPECT_LE(error, 0.5 * grid.step + 1e-9);
    EXPECT_GT(error, 0.4 * grid.step);
  }
}

TEST(QuantizedPoints, APointAloneIsExact) {
  const Points point = Eigen::Vector3d(1.0, -2.0, 1e7);
  const PointGrid grid = FindGrid(point);
  EXPECT_GT(grid.step, 0.0);
  EXPECT_EQ(UnquantizePoints(QuantizePoints(point, grid), grid), point);
  EXPECT_EQ(QuantizePoints(Points(3, 0), FindGrid(Points(3, 0))), "");
}

TEST(Thin, DrawsAsManyAsAskedForBySeed) {
  const auto drawn = ThinRange(1000, 100, 1);
  EXPECT_EQ(drawn.size(), 100u);
  EXPECT_TRUE(std::ranges::is_sorted(drawn));
  EXPECT_EQ(std::set(drawn.begin(), drawn.end()).size(), 100u);
  EXPECT_EQ(ThinRange(1000, 100, 1), drawn);
  EXPECT_NE(ThinRange(1000, 100, 2), drawn);
  EXPECT_THAT(ThinRange(3, 100, 1), ElementsAre(0, 1, 2));
}

TEST(Thin, DrawsEvenly) {
  std::vector<int> counts(10);
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    for (const Eigen::Index i : ThinRange(10, 3, seed)) {
      ++counts[static_cast<std::size_t>(i)];
    }
  }
  // 600 expected, with a standard deviation of 20.
  for (const int count : counts) EXPECT_NEAR(count, 600, 100);
}

class PairViewTest : public ::testing::Test {
 protected:
  PairViewTest() {
    pair_.name = "a </script> pair";
    pair_.source = RoomSource().points;
    pair_.target = RoomTarget().points;
    pair_.true_target_from_source = TrueRoomPose();
    pair_.noise_bound = options_.noise_bound;
    answer_.method = "quatro";
    answer_.summary = Register(RoomSource(), RoomTarget(), options_);
  }

  nlohmann::json View(const ViewOptions& options) const {
    return nlohmann::json::parse(FormatPairView(pair_, {answer_}, options));
  }

  static std::string Bytes(const nlohmann::json& text) {
    return DecodeBase64(text.get<std::string>());
  }

  static Points PointsOf(const nlohmann::json& cloud,
                         const nlohmann::json& xyz) {
    PointGrid grid;
    for (int axis = 0; axis < 3; ++axis)
      grid.origin(axis) = cloud["origin"][axis];
    grid.step = cloud["step"];
    return UnquantizePoints(Bytes(xyz), grid);
  }

  const RegistrationOptions options_ = RoomOptions();
  ViewedPair pair_;
  MethodAnswer answer_;
};

TEST_F(PairViewTest, HoldsAllOfASmallPair) {
  const auto view = View({.max_points = 10'000, .max_matches = 10'000});
  EXPECT_EQ(view["pair"], pair_.name);
  const Points source = PointsOf(view["source"], view["source"]["xyz"]);
  ASSERT_EQ(source.cols(), pair_.source.cols());
  EXPECT_LT((source - pair_.source).cwiseAbs().maxCoeff(), 1e-3);
  const Points matched = PointsOf(view["target"], view["matches"]["target"]);
  ASSERT_EQ(matched.cols(), answer_.summary.matched_target.cols());
  EXPECT_LT((matched - answer_.summary.matched_target).cwiseAbs().maxCoeff(),
            1e-3);
  EXPECT_EQ(view["methods"][0]["pose"][0][3].get<double>(),
            answer_.summary.target_from_source()->translation.x());
  EXPECT_EQ(view["truth"][1][3], -0.5);
}

TEST_F(PairViewTest, StagesAreThoseOfTheSummary) {
  const auto view = View({.max_points = 10, .max_matches = 10'000});
  const auto& stages = view["methods"][0]["stages"];
  const std::string fate = Bytes(stages["fate"]);
  const std::string weight = Bytes(stages["weight"]);
  const PoseSummary& solution = answer_.summary.solution;
  ASSERT_EQ(fate.size(),
            static_cast<std::size_t>(answer_.summary.matched_source.cols()));
  ASSERT_EQ(weight.size(), fate.size());
  std::vector<Eigen::Index> consistent, inliers;
  for (std::size_t i = 0; i < fate.size(); ++i) {
    if (fate[i] & kIsConsistent) consistent.push_back(static_cast<long>(i));
    if (fate[i] & kIsInlier) inliers.push_back(static_cast<long>(i));
    if (weight[i] != 0) {
      EXPECT_TRUE(fate[i] & kIsConsistent) << i;
    }
  }
  EXPECT_EQ(consistent, solution.consistent);
  EXPECT_EQ(inliers, solution.translation_inliers);
}

TEST_F(PairViewTest, CountsAreOfAllMatchesAndFallFromStageToStage) {
  const auto view = View({.max_points = 10, .max_matches = 8});
  const auto& counts = view["methods"][0]["stages"]["counts"];
  const auto& right = view["methods"][0]["stages"]["right"];
  EXPECT_EQ(counts["matches"], answer_.summary.matched_source.cols());
  EXPECT_EQ(counts["consistent"], answer_.summary.solution.consistent.size());
  EXPECT_GT(counts["matches"], counts["consistent"]);
  EXPECT_GE(counts["consistent"], counts["weighted"]);
  EXPECT_GT(counts["weighted"], 0);
  for (const auto& [name, count] : right.items()) {
    EXPECT_LE(count, counts[name]) << name;
    EXPECT_GT(count, 0) << name;
  }
  // The purpose of the stages.
  EXPECT_GT(
      right["consistent"].get<double>() / counts["consistent"].get<double>(),
      right["matches"].get<double>() / counts["matches"].get<double>());
}

TEST_F(PairViewTest, ThinsToWhatIsAllowedAndKeepsSurvivors) {
  const ViewOptions options{.max_points = 50, .max_matches = 40};
  const auto view = View(options);
  EXPECT_EQ(Bytes(view["source"]["xyz"]).size(), 300u);
  EXPECT_EQ(view["source"]["points"], pair_.source.cols());
  const std::string fate = Bytes(view["methods"][0]["stages"]["fate"]);
  EXPECT_EQ(fate.size(), 40u);
  const auto num_kept =
      std::count_if(fate.begin(), fate.end(), [](char f) { return f != 0; });
  const auto num_survivors =
      std::max(answer_.summary.solution.consistent.size(),
               answer_.summary.solution.translation_inliers.size());
  EXPECT_GE(num_kept, std::min<long>(30, static_cast<long>(num_survivors)));
  EXPECT_EQ(View(options), view);
  ViewOptions other = options;
  other.seed = 1;
  EXPECT_NE(View(other)["source"]["xyz"], view["source"]["xyz"]);
}

TEST_F(PairViewTest, MethodsShareMatchesOrHaveNoStages) {
  MethodAnswer other = answer_;
  other.method = "other";
  other.summary.solution.match_weights.clear();
  MethodAnswer clouds;
  clouds.method = "clouds";
  const auto view = nlohmann::json::parse(
      FormatPairView(pair_, {clouds, answer_, other}, ViewOptions()));
  EXPECT_TRUE(view["methods"][0]["stages"].is_null());
  EXPECT_TRUE(view["methods"][0]["pose"].is_null());
  EXPECT_EQ(view["methods"][1]["stages"]["fate"],
            view["methods"][2]["stages"]["fate"]);
  EXPECT_TRUE(view["methods"][2]["stages"]["weight"].is_null());
}

TEST_F(PairViewTest, CandidatesAreTheBestAndComparedWithTheAnswer) {
  answer_.summary.candidates.clear();
  EXPECT_TRUE(View({})["methods"][0]["candidates"].empty());
  const Rigid3 pose = *answer_.summary.target_from_source();
  for (int k = 0; k < 7; ++k) {
    PoseCandidate candidate;
    candidate.target_from_source = pose;
    candidate.target_from_source.translation.x() += k;
    candidate.origin = "rung 1";
    candidate.log_likelihood_ratio = 100.0;
    candidate.geometry.overlap = 0.1 * (k + 1);
    answer_.summary.candidates.push_back(candidate);
  }
  answer_.summary.rung = 1;
  const auto method = View({})["methods"][0];
  EXPECT_EQ(method["rung"], 1);
  ASSERT_EQ(method["candidates"].size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    const auto& candidate = method["candidates"][k];
    EXPECT_NEAR(candidate["overlap"].get<double>(),
                0.1 * (7.0 - static_cast<double>(k)),
                1e-9);
    EXPECT_NEAR(
        candidate["shift_m"].get<double>(), 6.0 - static_cast<double>(k), 1e-3);
    EXPECT_EQ(candidate["turn_deg"], 0.0);
  }
  EXPECT_NEAR(method["candidates"][0]["score"].get<double>(), 7.0, 1e-9);
}

TEST_F(PairViewTest, WithoutTruthNothingIsCalledRight) {
  pair_.true_target_from_source.reset();
  const auto view = View({});
  EXPECT_TRUE(view["truth"].is_null());
  EXPECT_TRUE(view["methods"][0]["stages"]["right"].is_null());
}

TEST(ViewOptions, ManyPairsFitOnAPage) {
  for (const std::size_t n : {0u, 1u, 47u, 200u, 500u}) {
    for (const std::size_t m : {1u, 2u, 11u}) {
      const ViewOptions options = MakeViewOptions(n, m);
      std::string error;
      EXPECT_TRUE(options.IsValid(&error)) << error;
      const auto bytes = static_cast<std::size_t>(16 * options.max_points +
                                                  16 * options.max_matches);
      const auto method_bytes =
          static_cast<std::size_t>(3 * options.max_matches + 1500);
      EXPECT_LE(n * (bytes + m * method_bytes), 25'000'000u);
    }
  }
  EXPECT_GT(MakeViewOptions(47, 1).max_points,
            MakeViewOptions(500, 1).max_points);
  EXPECT_GT(MakeViewOptions(500, 1).max_points,
            MakeViewOptions(500, 11).max_points);
}

TEST(ViewOptions, ErrorNamesTheField) {
  std::string error;
  EXPECT_TRUE(ViewOptions().IsValid(&error));
  EXPECT_FALSE(ViewOptions{.max_points = 0}.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("max_points"));
  EXPECT_FALSE(ViewOptions{.max_matches = 3}.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("max_matches"));
}

}  // namespace
}  // namespace quatro::pair_view_test
