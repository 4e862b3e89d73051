// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/protocols/gnc_film.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "experiments/simulator/synthetic.h"
#include "robust/gnc/gnc.h"
#include "robust/gnc/quasi_so3.h"

namespace quatro::gnc_film_test {
namespace {

using ::testing::HasSubstr;

FilmOptions SmallFilm(std::uint64_t seed) {
  FilmOptions options;
  options.num_tims = 60;
  options.outlier_ratio = 0.5;
  options.num_yaws = 181;
  options.seed = seed;
  return options;
}

// The film shows the same loop that the estimator runs.
TEST(GncFilm, EndsWhereTheLoopDoes) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const FilmOptions options = SmallFilm(seed);
    const GncFilm film = FilmGnc(options);
    const MatchedProblem problem = MakeTimProblem(options.num_tims,
                                                  options.outlier_ratio,
                                                  options.noise_bound / 3.0,
                                                  options.seed);
    const auto gnc = SolveGnc<TruncatedLeastSquares>(
        QuasiSo3{problem.source, problem.target, options.noise_bound},
        GncOptions{});
    ASSERT_TRUE(gnc.IsUsable());
    EXPECT_EQ(film.gnc_yaw, gnc.estimate->target_from_source);
    ASSERT_EQ(film.frames.size(), gnc.iterations.size() + 1);
    EXPECT_EQ(film.frames.back().weights, gnc.weights);
    for (std::size_t i = 0; i < gnc.iterations.size(); ++i) {
      EXPECT_EQ(film.frames[i + 1].mu, gnc.iterations[i].mu);
      EXPECT_NEAR(film.frames[i + 1].weights.sum(),
                  gnc.iterations[i].sum_of_weights,
                  1e-9);
    }
  }
}

TEST(GncFilm, SurrogatesRiseToTheTruncatedCostTheyStandFor) {
  const GncFilm film = FilmGnc(SmallFilm(3));
  ASSERT_GE(film.frames.size(), 4u);
  for (std::size_t i = 2; i < film.frames.size(); ++i) {
    const auto& before = film.frames[i - 1].curve;
    const auto& after = film.frames[i].curve;
    EXPECT_LE((after - film.truncated_curve).maxCoeff(), 1e-9) << i;
    EXPECT_LE((before - after).maxCoeff(), 1e-9) << i;
  }
}

TEST(GncFilm, NothingIsBelowTheExactOptimum) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const GncFilm film = FilmGnc(SmallFilm(seed));
    EXPECT_GE(film.truncated_curve.minCoeff(), film.exact_cost - 1e-9);
    EXPECT_GE(film.gnc_cost, film.exact_cost - 1e-9);
  }
}

TEST(GncFilm, TableHasAllOfIt) {
  const FilmOptions options = SmallFilm(1);
  const GncFilm film = FilmGnc(options);
  const Table table = TabulateFilm(film);
  const std::size_t a_frame =
      static_cast<std::size_t>(options.num_tims + options.num_yaws) + 1;
  EXPECT_EQ(table.rows.size(),
            film.frames.size() * a_frame +
                static_cast<std::size_t>(options.num_yaws + options.num_tims) +
                3);
}

TEST(FilmOptionsTest, ErrorNamesTheField) {
  FilmOptions options;
  std::string error;
  EXPECT_TRUE(options.IsValid(&error)) << error;
  options.outlier_ratio = 1.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("outlier_ratio = 1"));
}

}  // namespace
}  // namespace quatro::gnc_film_test
