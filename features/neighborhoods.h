// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The neighbors of each point p_i of a cloud,
//
//   N_i = { j : |p_j - p_i| <= radius },   or the k points nearest to p_i.
//
// They are millions of numbers, so each is written once, in place, into memory
// of huge pages.

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

// A row of neighbors for each point. The point itself is one of them.
class Neighborhoods {
 public:
  // The neighbors of one point. Both spans have the same size.
  struct Row {
    std::span<const std::int32_t> index;
    std::span<const float> squared_distance;  // [m^2]

    // The number of neighbors.
    std::size_t size() const { return index.size(); }
  };

  // Has no rows.
  Neighborhoods() = default;

  // The number of rows, one per point.
  Eigen::Index size() const { return static_cast<Eigen::Index>(rows_.size()); }

  // The neighbors of point i.
  const Row& row(Eigen::Index i) const {
    return rows_[static_cast<std::size_t>(i)];
  }

  // The number of neighbors of all points together.
  std::size_t num_neighbors() const;

 private:
  friend class NeighborhoodsBuilder;

  // Its arrays never grow, so that rows keep their addresses.
  struct Block {
    explicit Block(std::size_t capacity)
        : index(capacity), squared_distance(capacity) {}

    std::size_t Room() const { return index.size() - used; }

    ZeroedVector<std::int32_t> index;
    ZeroedVector<float> squared_distance;
    std::size_t used = 0;
    bool is_taken = false;  // A writer is using it.
  };

  std::vector<Row> rows_;
  std::vector<std::unique_ptr<Block>> blocks_;
};

// Builds Neighborhoods. Several threads may write rows, in any order.
class NeighborhoodsBuilder {
 public:
  // All rows are empty until they are written.
  explicit NeighborhoodsBuilder(Eigen::Index num_points);

  // Writes any number of rows. Each thread has a writer of its own.
  class Writer {
   public:
    // `builder` must outlive the writer.
    explicit Writer(NeighborhoodsBuilder* builder) : builder_(builder) {}
    ~Writer();
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    // Memory for the next row: `max_size` elements in each array.
    struct Room {
      std::int32_t* index;
      float* squared_distance;
    };
    Room MakeRoom(std::size_t max_size);

    // Stores the first `size` elements of the room from MakeRoom() as row i.
    void Add(Eigen::Index i, std::size_t size);

   private:
    NeighborhoodsBuilder* builder_;
    Neighborhoods::Block* block_ = nullptr;
  };

  // Returns the neighborhoods. All writers must be destroyed before the call.
  Neighborhoods Finish() &&;

 private:
  // Returns a block with room for `max_size` neighbors that no writer is using.
  // Allocates a new block if there is none.
  Neighborhoods::Block* Take(std::size_t max_size);
  void GiveBack(Neighborhoods::Block* block);

  Neighborhoods result_;
  std::size_t block_size_;
  std::mutex mutex_;  // Guards result_.blocks_ and their is_taken.
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_NEIGHBORHOODS_H_
