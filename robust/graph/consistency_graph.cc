// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/graph/consistency_graph.h"

#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "features/base/parallel.h"
#include "features/base/simd.h"
#include "robust/graph/far_matches.h"
#include "robust/graph/pair_tests.h"

namespace quatro {
namespace {

// A thread tests squares of this many by this many blocks, so that the words it
// writes for one row are contiguous.
constexpr std::size_t kBlocksAtOnce = 8;

QUATRO_SIMD_CLONES int CountBits(const Graph::Word* words, std::size_t num) {
  int count = 0;
  for (std::size_t k = 0; k < num; ++k) count += std::popcount(words[k]);
  return count;
}

// Points farther from the median than this many bounds are tested in double
// precision, because a float would round their distances by a sixteenth of the
// bound or more.
constexpr float kMaxFloat = 1 << 20;

// The tests of robust/graph/consistency_test.h. Lengths that not even a double
// resolves to the bound are not consistent with any other.
bool AreConsistent(const Eigen::Vector3d& a,
                   const Eigen::Vector3d& b,
                   const ConsistencyOptions& options) {
  const bool is_planar = options.test != ConsistencyTest::kLength;
  const double a_length = is_planar ? a.head<2>().norm() : a.norm();
  const double b_length = is_planar ? b.head<2>().norm() : b.norm();
  const double longer = std::max(a_length, b_length);
  if (!(longer <= MaxResolved(options.bound)) ||
      !(std::abs(a_length - b_length) <= options.bound)) {
    return false;
  }
  return options.test != ConsistencyTest::kPlanarAndHeight ||
         std::abs(a.z() - b.z()) <=
             options.bound + longer * std::sin(options.max_tilt);
}

// Sets the edges of the vertices with a point beyond kMaxFloat. `p` and `q` are
// relative to the medians, in units of the bound.
void TestFarPoints(const PointsRef& source,
                   const PointsRef& target,
                   const Eigen::Matrix3Xf& p,
                   const Eigen::Matrix3Xf& q,
                   const ConsistencyOptions& options,
                   Graph* graph) {
  for (Eigen::Index i = 0; i < p.cols(); ++i) {
    if (p.col(i).lpNorm<Eigen::Infinity>() <= kMaxFloat &&
        q.col(i).lpNorm<Eigen::Infinity>() <= kMaxFloat) {
      continue;
    }
    for (Eigen::Index j = 0; j < p.cols(); ++j) {
      if (j == i) continue;
      graph->SetEdge(static_cast<int>(i),
                     static_cast<int>(j),
                     AreConsistent(source.col(i) - source.col(j),
                                   target.col(i) - target.col(j),
                                   options));
    }
  }
}

}  // namespace

int Graph::Degree(int i) const {
  const auto row = Row(i);
  return CountBits(row.data(), row.size());
}

Graph BuildConsistencyGraph(const PointsRef& source,
                            const PointsRef& target,
                            const ConsistencyOptions& options,
                            int num_threads) {
  CHECK_EQ(source.cols(), target.cols());
  const Eigen::Index n = source.cols();
  Graph graph(static_cast<int>(n));
  if (n == 0) return graph;

  const double scale = 1.0 / options.bound;
  const Eigen::Matrix3Xf p =
      ((source.colwise() - Median(source)) * scale).cast<float>();
  const Eigen::Matrix3Xf q =
      ((target.colwise() - Median(target)) * scale).cast<float>();
  const std::vector<PairBlock> blocks = MakePairBlocks(p, q);
  const auto sin_tilt = static_cast<float>(std::sin(options.max_tilt));
  const SimdLevel level = BestSimdLevel();

  const auto set_words =
      [&](std::size_t i, std::size_t k, const PairBits& bits) {
        const std::size_t begin = i * kPairBlockSize;
        const std::size_t end =
            std::min(begin + kPairBlockSize, static_cast<std::size_t>(n));
        for (std::size_t row = begin; row < end; ++row) {
          graph.MutableRow(static_cast<int>(row))[k] = bits.row[row - begin];
        }
      };
  const auto test = [&](std::size_t i, std::size_t k) {
    PairBits bits =
        TestPairBlocks(options.test, blocks[i], blocks[k], sin_tilt, level);
    if (i == k) {
      for (std::size_t row = 0; row < kPairBlockSize; ++row) {
        bits.row[row] &= ~(Graph::Word{1} << row);
      }
    } else {
      set_words(k, i, Transposed(bits));
    }
    set_words(i, k, bits);
  };

  // Squares of blocks on and to the right of the diagonal.
  const std::size_t num_squares =
      (blocks.size() + kBlocksAtOnce - 1) / kBlocksAtOnce;
  std::vector<std::array<std::size_t, 2>> squares;
  for (std::size_t i = 0; i < num_squares; ++i) {
    for (std::size_t k = i; k < num_squares; ++k) squares.push_back({i, k});
  }
  const auto test_square = [&](const std::array<std::size_t, 2>& square) {
    const auto [first_i, first_k] = square;
    const auto end_of = [&](std::size_t first) {
      return std::min((first + 1) * kBlocksAtOnce, blocks.size());
    };
    for (std::size_t i = first_i * kBlocksAtOnce; i < end_of(first_i); ++i) {
      for (std::size_t k = std::max(i, first_k * kBlocksAtOnce);
           k < end_of(first_k);
           ++k) {
        test(i, k);
      }
    }
  };
  ParallelFor(num_threads,
              static_cast<Eigen::Index>(squares.size()),
              1,
              [&](Eigen::Index begin, Eigen::Index end) {
                for (Eigen::Index s = begin; s < end; ++s) {
                  test_square(squares[static_cast<std::size_t>(s)]);
                }
              });
  TestFarPoints(source, target, p, q, options, &graph);
  return graph;
}

}  // namespace quatro
