// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The points around each point of a cloud: millions of numbers, so that each is
// written once, where it stays, into memory of huge pages.

#ifndef QUATRO_FEATURES_NEIGHBORHOODS_H_
#define QUATRO_FEATURES_NEIGHBORHOODS_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "features/base/zeroed_allocator.h"

namespace quatro {

// A row of neighbours for each point, itself among them.
class Neighborhoods {
 public:
  // Of one point; both are of one size.
  struct Row {
    std::span<const std::int32_t> index;
    std::span<const float> squared_distance;  // [m^2]

    // How many neighbours.
    std::size_t size() const { return index.size(); }
  };

  // Of no points.
  Neighborhoods() = default;

  // How many points have a row.
  Eigen::Index size() const { return static_cast<Eigen::Index>(rows_.size()); }

  // Of point i.
  const Row& row(Eigen::Index i) const {
    return rows_[static_cast<std::size_t>(i)];
  }

  // Of all points together.
  std::size_t num_neighbors() const;

 private:
  friend class NeighborhoodsBuilder;

  // Never made larger, so that rows stay where they are.
  struct Block {
    explicit Block(std::size_t capacity)
        : index(capacity), squared_distance(capacity) {}

    std::size_t Room() const { return index.size() - used; }

    ZeroedVector<std::int32_t> index;
    ZeroedVector<float> squared_distance;
    std::size_t used = 0;
    bool is_taken = false;  // By a writer.
  };

  std::vector<Row> rows_;
  std::vector<std::unique_ptr<Block>> blocks_;
};

// Rows are written in any order, by several threads.
class NeighborhoodsBuilder {
 public:
  // All rows are empty at first.
  explicit NeighborhoodsBuilder(Eigen::Index num_points);

  // Of one thread at a time, for as many rows as it likes.
  class Writer {
   public:
    // Of a builder that outlives it.
    explicit Writer(NeighborhoodsBuilder* builder) : builder_(builder) {}
    ~Writer();
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    // Where the next row may be written to, up to so many numbers.
    struct Room {
      std::int32_t* index;
      float* squared_distance;
    };
    Room MakeRoom(std::size_t max_size);

    // The first `size` of the room are row i.
    void Add(Eigen::Index i, std::size_t size);

   private:
    NeighborhoodsBuilder* builder_;
    Neighborhoods::Block* block_ = nullptr;
  };

  // What was written. There must be no writer left.
  Neighborhoods Finish() &&;

 private:
  // One with so much room: that nobody writes into, or a new one.
  Neighborhoods::Block* Take(std::size_t max_size);
  void GiveBack(Neighborhoods::Block* block);

  Neighborhoods result_;
  std::size_t block_size_;
  std::mutex mutex_;  // Of the list of blocks, and of whose they are.
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_NEIGHBORHOODS_H_
