// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Which matches can hold together: an edge (i, j) iff the offset between the
// two source points could become that between the two target points by the
// motion that is looked for. With a = p_i - p_j, b = q_i - q_j:
//
//   kLength           | |a| - |b| | <= bound                       any rotation
//   kPlanar           | |a_xy| - |b_xy| | <= bound                 yaw
//   kPlanarAndHeight  the same, and
//                     |a_z - b_z| <= bound + max(|a_xy|, |b_xy|) sin(tilt)
//
// The first is the paper's (and TEASER++'s). Under a pure yaw both the planar
// length and the height difference stay, which is a sharper test; a match that
// is right in xy and wrong in z ("quasi-inlier") passes kPlanar alone.
//
// Kept as one row of bits per match: N^2 / 8 bytes.

#ifndef QUATRO_ROBUST_CONSISTENCY_GRAPH_H_
#define QUATRO_ROBUST_CONSISTENCY_GRAPH_H_

#include <Eigen/Core>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "features/types.h"
#include "features/zeroed_allocator.h"

namespace quatro {

// An undirected graph without loops.
class Graph {
 public:
  // Sixty-four edges.
  using Word = std::uint64_t;
  static constexpr int kWordBits = 64;

  // Without edges.
  explicit Graph(int num_vertices)
      : num_vertices_(num_vertices),
        words_per_row_((num_vertices + kWordBits - 1) / kWordBits),
        rows_(static_cast<std::size_t>(num_vertices) *
              static_cast<std::size_t>(words_per_row_)) {}

  // Of which vertices are numbered from 0.
  int num_vertices() const { return num_vertices_; }

  // The edges of vertex i, a bit each.
  std::span<const Word> Row(int i) const {
    return {rows_.data() + RowBegin(i),
            static_cast<std::size_t>(words_per_row_)};
  }

  // The same to be written; who writes keeps it symmetric.
  std::span<Word> MutableRow(int i) {
    return {rows_.data() + RowBegin(i),
            static_cast<std::size_t>(words_per_row_)};
  }

  // Whether i and j are consistent.
  bool HasEdge(int i, int j) const {
    return (Row(i)[static_cast<std::size_t>(j / kWordBits)] >>
            (j % kWordBits)) &
           1u;
  }

  // In both rows.
  void AddEdge(int i, int j) {
    SetBit(i, j);
    SetBit(j, i);
  }

  // How many edges vertex i has.
  int Degree(int i) const;

  // Calls visit(j) for each neighbour j of i, in ascending order.
  template <typename Visit>
  void ForEachNeighbor(int i, const Visit& visit) const {
    int base = 0;
    for (Word word : Row(i)) {
      for (; word != 0; word &= word - 1) visit(base + std::countr_zero(word));
      base += kWordBits;
    }
  }

  // The same for those whose bit is set in `among`, as long as a row.
  template <typename Visit>
  void ForEachNeighborAmong(int i,
                            std::span<const Word> among,
                            const Visit& visit) const {
    const auto row = Row(i);
    for (std::size_t k = 0; k < row.size(); ++k) {
      const int base = static_cast<int>(k) * kWordBits;
      for (Word word = row[k] & among[k]; word != 0; word &= word - 1) {
        visit(base + std::countr_zero(word));
      }
    }
  }

 private:
  std::size_t RowBegin(int i) const {
    return static_cast<std::size_t>(i) *
           static_cast<std::size_t>(words_per_row_);
  }
  void SetBit(int i, int j) {
    MutableRow(i)[static_cast<std::size_t>(j / kWordBits)] |=
        Word{1} << (j % kWordBits);
  }

  int num_vertices_;
  int words_per_row_;
  ZeroedVector<Word> rows_;
};

// What two matches must agree in.
enum class ConsistencyTest { kLength, kPlanar, kPlanarAndHeight };

// The test, and how far a pair may miss it.
struct ConsistencyOptions {
  ConsistencyTest test = ConsistencyTest::kLength;
  double bound = 0.6;       // [m], both points of a pair may be off.
  double max_tilt = 0.035;  // [rad], for kPlanarAndHeight.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// `source` and `target` hold the matches column by column. Distances are in
// single precision about the clouds' medians: exact to about 1e-7 of how far
// from there the points are, and a far outlier spoils no edge but its own.
Graph BuildConsistencyGraph(const PointsRef& source,
                            const PointsRef& target,
                            const ConsistencyOptions& options,
                            int num_threads);

}  // namespace quatro

#endif  // QUATRO_ROBUST_CONSISTENCY_GRAPH_H_
