// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/consistency_graph.h"

#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "features/parallel.h"
#include "features/simd.h"

namespace quatro {
namespace {

constexpr std::size_t kLanes = Graph::kWordBits;

// Coordinates of one word's worth of matches.
struct Block {
  float px[kLanes], py[kLanes], pz[kLanes];
  float qx[kLanes], qy[kLanes], qz[kLanes];
};

struct Limits {
  float bound = 0.0f;
  float sin_tilt = 0.0f;
};

// Which of the lanes of `block` are consistent with lane `i` of `own`.
template <ConsistencyTest kTest>
QUATRO_SIMD_INLINE Graph::Word TestBlock(const Block& own,
                                         std::size_t i,
                                         const Block& block,
                                         const Limits& limits) {
  unsigned char passes[kLanes];
  for (std::size_t j = 0; j < kLanes; ++j) {
    const float ax = block.px[j] - own.px[i];
    const float ay = block.py[j] - own.py[i];
    const float az = block.pz[j] - own.pz[i];
    const float bx = block.qx[j] - own.qx[i];
    const float by = block.qy[j] - own.qy[i];
    const float bz = block.qz[j] - own.qz[i];
    float a2 = ax * ax + ay * ay;
    float b2 = bx * bx + by * by;
    if constexpr (kTest == ConsistencyTest::kLength) {
      a2 += az * az;
      b2 += bz * bz;
    }
    const float a = std::sqrt(a2);
    const float b = std::sqrt(b2);
    bool is_consistent = std::abs(a - b) <= limits.bound;
    if constexpr (kTest == ConsistencyTest::kPlanarAndHeight) {
      const float longer = a > b ? a : b;
      is_consistent &=
          std::abs(az - bz) <= limits.bound + longer * limits.sin_tilt;
    }
    passes[j] = is_consistent;
  }
  Graph::Word word = 0;
  for (std::size_t j = 0; j < kLanes; ++j) {
    word |= static_cast<Graph::Word>(passes[j]) << j;
  }
  return word;
}

QUATRO_SIMD_CLONES void TestRow(ConsistencyTest test,
                                const Block* blocks,
                                std::size_t num_blocks,
                                std::size_t i,
                                const Limits& limits,
                                Graph::Word* row) {
  const Block& own = blocks[i / kLanes];
  const std::size_t lane = i % kLanes;
  switch (test) {
    case ConsistencyTest::kLength:
      for (std::size_t k = 0; k < num_blocks; ++k) {
        row[k] =
            TestBlock<ConsistencyTest::kLength>(own, lane, blocks[k], limits);
      }
      break;
    case ConsistencyTest::kPlanar:
      for (std::size_t k = 0; k < num_blocks; ++k) {
        row[k] =
            TestBlock<ConsistencyTest::kPlanar>(own, lane, blocks[k], limits);
      }
      break;
    case ConsistencyTest::kPlanarAndHeight:
      for (std::size_t k = 0; k < num_blocks; ++k) {
        row[k] = TestBlock<ConsistencyTest::kPlanarAndHeight>(
            own, lane, blocks[k], limits);
      }
      break;
  }
}

// Of each axis: where most points are, wherever a few outliers may be.
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

bool ConsistencyOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(bound > 0.0)) {
    problem << "consistency.bound = " << bound << ", must be > 0";
  } else if (!(max_tilt >= 0.0 && max_tilt <= M_PI / 2)) {
    problem << "consistency.max_tilt = " << max_tilt
            << ", must be in [0, pi/2]";
  }
  *error = problem.str();
  return error->empty();
}

Graph BuildConsistencyGraph(const PointsRef& source,
                            const PointsRef& target,
                            const ConsistencyOptions& options,
                            int num_threads) {
  CHECK_EQ(source.cols(), target.cols());
  const Eigen::Index n = source.cols();
  Graph graph(static_cast<int>(n));
  if (n == 0) return graph;

  const Eigen::Matrix3Xf p = (source.colwise() - Median(source)).cast<float>();
  const Eigen::Matrix3Xf q = (target.colwise() - Median(target)).cast<float>();
  const auto num_blocks =
      static_cast<std::size_t>((n + Graph::kWordBits - 1) / Graph::kWordBits);
  std::vector<Block> blocks(num_blocks);
  for (Eigen::Index i = 0; i < n; ++i) {
    Block& block = blocks[static_cast<std::size_t>(i) / kLanes];
    const std::size_t lane = static_cast<std::size_t>(i) % kLanes;
    block.px[lane] = p(0, i);
    block.py[lane] = p(1, i);
    block.pz[lane] = p(2, i);
    block.qx[lane] = q(0, i);
    block.qy[lane] = q(1, i);
    block.qz[lane] = q(2, i);
  }
  const Limits limits{static_cast<float>(options.bound),
                      static_cast<float>(std::sin(options.max_tilt))};
  // The lanes of the last block that hold no match.
  const Graph::Word tail = n % Graph::kWordBits == 0
                               ? ~Graph::Word{0}
                               : (Graph::Word{1} << (n % Graph::kWordBits)) - 1;

  ParallelFor(num_threads, n, 64, [&](Eigen::Index begin, Eigen::Index end) {
    for (Eigen::Index i = begin; i < end; ++i) {
      const auto row = graph.MutableRow(static_cast<int>(i));
      TestRow(options.test,
              blocks.data(),
              num_blocks,
              static_cast<std::size_t>(i),
              limits,
              row.data());
      row.back() &= tail;
      row[static_cast<std::size_t>(i) / kLanes] &=
          ~(Graph::Word{1} << (i % Graph::kWordBits));
    }
  });
  return graph;
}

}  // namespace quatro
