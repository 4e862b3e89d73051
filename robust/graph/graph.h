// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// An undirected graph with one row of bits per vertex: N^2 / 8 bytes for N
// vertices.

#ifndef QUATRO_ROBUST_GRAPH_GRAPH_H_
#define QUATRO_ROBUST_GRAPH_GRAPH_H_

#include <bit>
#include <cstdint>
#include <span>

#include "features/base/zeroed_allocator.h"

namespace quatro {

// An undirected graph without loops.
class Graph {
 public:
  // Bits for 64 possible edges.
  using Word = std::uint64_t;
  static constexpr int kWordBits = 64;

  // Makes a graph without edges.
  explicit Graph(int num_vertices)
      : num_vertices_(num_vertices),
        words_per_row_((num_vertices + kWordBits - 1) / kWordBits),
        rows_(static_cast<std::size_t>(num_vertices) *
              static_cast<std::size_t>(words_per_row_)) {}

  // Vertices are numbered from 0.
  int num_vertices() const { return num_vertices_; }

  // Row i: bit j is set iff i and j are adjacent.
  std::span<const Word> Row(int i) const {
    return {rows_.data() + RowBegin(i),
            static_cast<std::size_t>(words_per_row_)};
  }

  // Row i for writing. The caller must keep the matrix symmetric.
  std::span<Word> MutableRow(int i) {
    return {rows_.data() + RowBegin(i),
            static_cast<std::size_t>(words_per_row_)};
  }

  // Whether i and j are adjacent.
  bool HasEdge(int i, int j) const {
    return (Row(i)[static_cast<std::size_t>(j / kWordBits)] >>
            (j % kWordBits)) &
           1u;
  }

  // Sets the bits in both rows.
  void AddEdge(int i, int j) { SetEdge(i, j, true); }

  // Adds or removes the edge.
  void SetEdge(int i, int j, bool has_edge) {
    SetBit(i, j, has_edge);
    SetBit(j, i, has_edge);
  }

  // The number of neighbors of vertex i.
  int Degree(int i) const;

  // Calls visit(j) for each neighbor j of i, in ascending order.
  template <typename Visit>
  void ForEachNeighbor(int i, const Visit& visit) const {
    int base = 0;
    for (Word word : Row(i)) {
      for (; word != 0; word &= word - 1) visit(base + std::countr_zero(word));
      base += kWordBits;
    }
  }

  // Calls visit(j) for each neighbor j of i whose bit is set in `among`, which
  // has the length of a row.
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
  void SetBit(int i, int j, bool value) {
    Word& word = MutableRow(i)[static_cast<std::size_t>(j / kWordBits)];
    const Word bit = Word{1} << (j % kWordBits);
    word = value ? word | bit : word & ~bit;
  }

  int num_vertices_;
  int words_per_row_;
  ZeroedVector<Word> rows_;
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_GRAPH_GRAPH_H_
