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

// The median on each axis, which a few outliers do not move.
Eigen::Vector3d Median(const PointsRef& points) {
  Eigen::Vector3d median;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd x = points.row(axis).transpose();
    const auto middle = x.begin() + x.size() / 2;
    std::nth_element(x.begin(), middle, x.end());
    median[axis] = *middle;
  }
  return median;
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
  return graph;
}

}  // namespace quatro
