// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/graph/pair_tests.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "features/base/random.h"

namespace quatro::pair_tests_test {
namespace {

constexpr auto kSize = static_cast<Eigen::Index>(kPairBlockSize);
constexpr float kSinTilt = 0.1f;
constexpr ConsistencyTest kAllTests[] = {ConsistencyTest::kLength,
                                         ConsistencyTest::kPlanar,
                                         ConsistencyTest::kPlanarAndHeight};

bool Has(const PairBits& bits, Eigen::Index i, Eigen::Index k) {
  return (bits.row[i] >> k) & 1u;
}

bool AreEqual(const PairBits& a, const PairBits& b) {
  return std::equal(a.row, a.row + kPairBlockSize, b.row);
}

PairBits BitsOf(ConsistencyTest test,
                const PairBlock& rows,
                const PairBlock& columns,
                SimdLevel level = BestSimdLevel()) {
  return TestPairBlocks(test, rows, columns, kSinTilt, level);
}

// Two blocks. The targets are rotated sources with errors of up to one or two
// bounds.
struct Problem {
  explicit Problem(double scale) : source(3, 2 * kSize), target(3, 2 * kSize) {
    Random random(1);
    for (Eigen::Index i = 0; i < 2 * kSize; ++i) {
      const auto draw = [&] { return 2.0 * random.Uniform() - 1.0; };
      const Eigen::Vector3d p(scale * draw(), scale * draw(), scale * draw());
      source.col(i) = p.cast<float>();
      const Eigen::Vector3d q(-p.y() + draw(), p.x() + draw(), p.z() + draw());
      target.col(i) = q.cast<float>();
    }
    blocks = MakePairBlocks(source, target);
  }

  // By definition, in double precision: how far inside the bound, negative if
  // outside.
  double Margin(ConsistencyTest test, Eigen::Index i, Eigen::Index k) const {
    const Eigen::Vector3d a = (source.col(i) - source.col(k)).cast<double>();
    const Eigen::Vector3d b = (target.col(i) - target.col(k)).cast<double>();
    if (test == ConsistencyTest::kLength) {
      return 1.0 - std::abs(a.norm() - b.norm());
    }
    const double a_xy = a.head<2>().norm();
    const double b_xy = b.head<2>().norm();
    const double planar = 1.0 - std::abs(a_xy - b_xy);
    if (test == ConsistencyTest::kPlanar) return planar;
    const double height =
        1.0 + std::max(a_xy, b_xy) * kSinTilt - std::abs(a.z() - b.z());
    return std::min(planar, height);
  }

  Eigen::Matrix3Xf source, target;
  std::vector<PairBlock> blocks;
};

TEST(PairTests, BitsAreThoseOfTheDefinition) {
  // Offsets from below one bound to a thousand bounds.
  for (const double scale : {0.3, 3.0, 30.0, 1000.0}) {
    const Problem problem(scale);
    for (const ConsistencyTest test : kAllTests) {
      SCOPED_TRACE("scale " + std::to_string(scale) + ", test " +
                   std::to_string(static_cast<int>(test)));
      const PairBits bits = BitsOf(test, problem.blocks[0], problem.blocks[1]);
      int num_passing = 0;
      int num_clear = 0;
      for (Eigen::Index i = 0; i < kSize; ++i) {
        for (Eigen::Index k = 0; k < kSize; ++k) {
          const double margin = problem.Margin(test, i, kSize + k);
          num_passing += margin > 0.0;
          if (std::abs(margin) < 1e-6 * (1.0 + scale)) continue;
          ++num_clear;
          EXPECT_EQ(Has(bits, i, k), margin > 0.0)
              << i << " and " << k << ", margin " << margin;
        }
      }
      EXPECT_GT(num_clear, kSize * kSize * 99 / 100);
      EXPECT_GT(num_passing, kSize * kSize / 2);
      EXPECT_LT(num_passing, kSize * kSize);
    }
  }
}

TEST(PairTests, EveryLevelGivesTheSameBits) {
  const Problem problem(10.0);
  for (const ConsistencyTest test : kAllTests) {
    const PairBits expected = BitsOf(
        test, problem.blocks[0], problem.blocks[1], SimdLevel::kBaseline);
    for (int level = 1; level <= static_cast<int>(BestSimdLevel()); ++level) {
      EXPECT_TRUE(AreEqual(BitsOf(test,
                                  problem.blocks[0],
                                  problem.blocks[1],
                                  static_cast<SimdLevel>(level)),
                           expected))
          << "level " << level;
    }
  }
}

TEST(PairTests, WithRowsAndColumnsChangedTheBitsAreTransposed) {
  const Problem problem(10.0);
  for (const ConsistencyTest test : kAllTests) {
    EXPECT_TRUE(AreEqual(
        BitsOf(test, problem.blocks[1], problem.blocks[0]),
        Transposed(BitsOf(test, problem.blocks[0], problem.blocks[1]))));
  }
}

TEST(PairTests, WhatFillsTheLastBlockPassesNoTest) {
  const Eigen::Matrix3Xf points = Eigen::Matrix3Xf::Zero(3, kSize + 5);
  const auto blocks = MakePairBlocks(points, points);
  ASSERT_EQ(blocks.size(), 2u);
  for (const ConsistencyTest test : kAllTests) {
    const PairBits bits = BitsOf(test, blocks[0], blocks[1]);
    const PairBits own = BitsOf(test, blocks[1], blocks[1]);
    for (std::size_t i = 0; i < kPairBlockSize; ++i) {
      EXPECT_EQ(bits.row[i], 31u) << "row " << i;
      EXPECT_EQ(own.row[i], i < 5 ? 31u : 0u) << "row " << i;
    }
  }
}

TEST(PairTests, FarOffOnlyEqualLengthsPass) {
  // The powers of both lengths overflow for the last three values.
  for (const float far : {1e3f, 1e8f, 1e12f, 1e16f}) {
    Eigen::Matrix3Xf source = Eigen::Matrix3Xf::Zero(3, 3);
    Eigen::Matrix3Xf target = source;
    source(0, 1) = source(0, 2) = far;
    target(1, 1) = -far;
    target(1, 2) = 1.5f * far;
    const auto blocks = MakePairBlocks(source, target);
    for (const ConsistencyTest test : kAllTests) {
      const PairBits bits = BitsOf(test, blocks[0], blocks[0]);
      EXPECT_TRUE(Has(bits, 0, 1)) << far;
      EXPECT_FALSE(Has(bits, 0, 2)) << far;
      EXPECT_FALSE(Has(bits, 1, 2)) << far;
    }
  }
}

TEST(Transposed, ExchangesRowsAndColumns) {
  Random random(2);
  PairBits bits;
  for (auto& row : bits.row) row = random.Next();
  const PairBits transposed = Transposed(bits);
  for (Eigen::Index i = 0; i < kSize; ++i) {
    for (Eigen::Index k = 0; k < kSize; ++k) {
      EXPECT_EQ(Has(transposed, k, i), Has(bits, i, k)) << i << ", " << k;
    }
  }
}

}  // namespace
}  // namespace quatro::pair_tests_test
